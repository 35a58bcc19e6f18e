#include "core/command_line/values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "core/files/read.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

Decimal parse_percent(const std::string& text) { return parse_decimal(text, 1, 0, 1000); }

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size(); begin += parts.back().size() + 1) {
    parts.push_back(text.substr(begin, text.find(separator, begin) - begin));
  }
  return parts;
}

std::string suggest(std::string_view name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  return did_you_mean(nearest(name, names));
}

std::string quote_if_split(const std::string& text) {
  return text.find(' ') == std::string::npos ? text : quote(text);
}

std::string join_with_or(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  quoted.reserve(words.size());
  for (const std::string& word : words) quoted.push_back(quote_if_split(word));
  return list_with_or(quoted);
}

Values pair_of_words(const std::string& placeholder, std::string expected,
                     const std::string& example) {
  return {placeholder, std::move(expected),
          [placeholder, example](const std::string& text) -> std::string {
            const std::size_t equals = text.find('=');
            if (equals != 0 && equals != std::string::npos && equals + 1 < text.size()) return {};
            return fmt::format("expected {}, such as {}, found {}", placeholder, example,
                               quote(text));
          }};
}

Values old_and_new_name() {
  return pair_of_words("OLD=NEW", "the names of a task, behavior or variable in both catalogs",
                       "LAND=DESCEND");
}

Values name_of(std::string placeholder, ValueKind kind) {
  // In the order of the enumerators.
  static constexpr std::array<const char*, 7> expected = {
      "a value", "a catalog",           "a script", "a catalog or a script", "a file",
      "a task",  "a task or a behavior"};
  Values values{std::move(placeholder), expected.at(static_cast<std::size_t>(kind))};
  values.kind = kind;
  return values;
}

Values input(std::string placeholder, ValueKind kind) {
  Values values = name_of(std::move(placeholder), kind);
  values.is_input = true;
  return values;
}

Values output(std::string placeholder) {
  Values values = name_of(std::move(placeholder), ValueKind::file);
  values.is_output = true;
  values.check = [](const std::string& text) {
    return std::string(text.empty() ? "expected the name of a file" : "");
  };
  return values;
}

Values further_output(std::string placeholder) {
  Values values = output(std::move(placeholder));
  values.check = [is_name = values.check](const std::string& text) {
    return text == "-" ? "expected a file, as standard output has the report" : is_name(text);
  };
  return values;
}

Values folder(std::string placeholder) {
  Values values = name_of(std::move(placeholder), ValueKind::file);
  values.expected = "a folder";
  values.check = [](const std::string& text) {
    return std::string(text.empty() || text == "-" ? "expected the name of a folder" : "");
  };
  return values;
}

Values existing_folder() {
  Values values = folder();
  values.check = [](const std::string& path) -> std::string {
    return is_folder(path) ? "" : fmt::format("there is no folder {}", quote(path));
  };
  return values;
}

Values one_of(std::string placeholder, std::vector<std::string> choices) {
  Values values{std::move(placeholder), "a value: " + join_with_or(choices),
                [choices](const std::string& text) -> std::string {
                  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return {};
                  return fmt::format("expected {}, found {}{}", join_with_or(choices), quote(text),
                                     suggest(text, choices));
                }};
  values.choices = std::move(choices);
  return values;
}

Values whole_number(std::string placeholder, std::int64_t least, std::int64_t most) {
  return {std::move(placeholder), "a number",
          [least, most](const std::string& text) -> std::string {
            std::int64_t number = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, number);
            if (error == std::errc() && stop == end && number >= least && number <= most) {
              return {};
            }
            if (stop != end || error == std::errc::invalid_argument) {
              return fmt::format("expected a whole number, found {}", quote(text));
            }
            if (error == std::errc() && most == std::numeric_limits<std::int64_t>::max()) {
              return fmt::format("expected a whole number of at least {}, found {}", least,
                                 quote(text));
            }
            return fmt::format("expected a whole number from {} to {}, found {}", least, most,
                               quote(text));
          }};
}

Values seconds(Microseconds least) {
  return {"SECONDS", "a time in seconds", [least](const std::string& text) -> std::string {
            const Decimal time = parse_seconds(text);
            if (time.error == DecimalError::no_error && time.value >= least) return {};
            return fmt::format("expected seconds, from {} to 1000000000, found {}",
                               format_decimal(least, 6), quote(text));
          }};
}

Values percent() {
  return {"PERCENT", "a number from 0 to 100", [](const std::string& text) -> std::string {
            if (parse_percent(text).error == DecimalError::no_error) return {};
            return fmt::format(
                "expected a number from 0 to 100, with at most one decimal, found {}", quote(text));
          }};
}

std::uint64_t tenths_in(const std::string& percent) {
  return static_cast<std::uint64_t>(parse_percent(percent).value);
}

std::string describe_percent(const std::string& percent) {
  return format_decimal(parse_percent(percent).value, 1) + " %";
}

}  // namespace cbc::cli
