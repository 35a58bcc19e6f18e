#include "yaml/values.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "text/decimal.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace cbc::yaml {
namespace {

std::string must_be(std::string_view what, std::string_view expected) {
  return quote(what) + " must be " + std::string(expected);
}

// Reports why a number could not be read. Texts that are no plain scalars were dealt with.
void report_number(const Node& node, std::string_view what, std::string_view expected,
                   std::string_view precision, DecimalError error, Reporter& reporter) {
  switch (error) {
    case DecimalError::no_error:
      break;
    case DecimalError::not_a_number:
      report_wrong_type(node, what, expected, reporter);
      break;
    case DecimalError::out_of_range:
      reporter.report(rule::invalid_value, node.range,
                      must_be(what, expected) + ", found " + describe(node));
      break;
    case DecimalError::too_precise:
      reporter.report(rule::invalid_value, node.range,
                      quote(what) + " has " + std::string(precision) + ", found " + describe(node));
      break;
  }
}

// The two booleans in one spelling.
struct Boolean {
  std::string_view yes;
  std::string_view no;
};
constexpr Boolean booleans[] = {
    {"true", "false"}, {"True", "False"}, {"TRUE", "FALSE"}, {"yes", "no"},
    {"Yes", "No"},     {"YES", "NO"},     {"on", "off"},     {"On", "Off"},
    {"ON", "OFF"},     {"y", "n"},        {"Y", "N"},
};

// The spelling of a node that is a boolean, or nullptr.
const Boolean* find_boolean(const Node& node) {
  if (node.kind != Kind::scalar || !node.plain) return nullptr;
  const auto* const found =
      std::find_if(std::begin(booleans), std::end(booleans), [&node](const Boolean& boolean) {
        return node.text == boolean.yes || node.text == boolean.no;
      });
  return found == std::end(booleans) ? nullptr : found;
}

}  // namespace

std::string describe(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      return "nothing";
    case Kind::sequence:
      return node.items.empty() ? "an empty list" : "a list";
    case Kind::mapping:
      return node.entries.empty() ? "an empty mapping" : "a mapping";
    case Kind::scalar:
      break;
  }
  if (node.text.empty()) return "an empty text";
  return node.plain ? quote(node.text) : quote(node.text) + " in quotes";
}

std::optional<bool> to_boolean(const Node& node) {
  const Boolean* boolean = find_boolean(node);
  if (boolean == nullptr) return std::nullopt;
  return node.text == boolean->yes;
}

std::optional<std::string_view> opposite(const Node& node) {
  const Boolean* boolean = find_boolean(node);
  if (boolean == nullptr) return std::nullopt;
  return node.text == boolean->yes ? boolean->no : boolean->yes;
}

void report_wrong_type(const Node& node, std::string_view what, std::string_view expected,
                       Reporter& reporter) {
  reporter.report(rule::wrong_type, node.range,
                  must_be(what, expected) + ", found " + describe(node));
}

const Node* read_list(const Node& node, std::string_view what, std::string_view expected,
                      Reporter& reporter) {
  if (node.kind == Kind::sequence) return &node;
  report_wrong_type(node, what, expected, reporter);
  return nullptr;
}

const Node* read_mapping(const Node& node, std::string_view what, std::string_view expected,
                         Reporter& reporter) {
  if (node.kind == Kind::mapping) return &node;
  report_wrong_type(node, what, expected, reporter);
  return nullptr;
}

std::optional<std::string_view> read_text(const Node& node, std::string_view what,
                                          std::string_view expected, Reporter& reporter) {
  if (node.kind == Kind::scalar) return node.text;
  report_wrong_type(node, what, expected, reporter);
  return std::nullopt;
}

std::optional<std::string_view> read_name(const Node& node, std::string_view what,
                                          std::string_view expected, Reporter& reporter) {
  const std::optional<std::string_view> text = read_text(node, what, expected, reporter);
  if (text && text->empty()) {
    reporter.report(rule::invalid_value, node.range,
                    must_be(what, expected) + ", found " + describe(node));
    return std::nullopt;
  }
  return text;
}

std::optional<bool> read_boolean(const Node& node, std::string_view what, Reporter& reporter) {
  const std::optional<bool> value = to_boolean(node);
  if (!value) report_wrong_type(node, what, "true or false", reporter);
  return value;
}

std::optional<Millionths> read_percent(const Node& node, std::string_view what,
                                       Reporter& reporter) {
  constexpr std::string_view expected = "a number from 0 to 100 (percent)";
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected, reporter);
    return std::nullopt;
  }
  const Decimal decimal = parse_percent(node.text);
  report_number(node, what, expected, "at most 4 decimals", decimal.error, reporter);
  if (decimal.error != DecimalError::no_error) return std::nullopt;
  return static_cast<Millionths>(decimal.value);
}

std::optional<Microseconds> read_seconds(const Node& node, std::string_view what, bool positive,
                                         Reporter& reporter) {
  const std::string expected = "a number of seconds " +
                               std::string(positive ? "over 0" : "from 0") + " to " +
                               std::to_string(longest_time / second);
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected, reporter);
    return std::nullopt;
  }
  Decimal decimal = parse_seconds(node.text);
  if (positive && decimal.error == DecimalError::no_error && decimal.value == 0) {
    decimal.error = DecimalError::out_of_range;
  }
  report_number(node, what, expected, "at most 6 decimals", decimal.error, reporter);
  if (decimal.error != DecimalError::no_error) return std::nullopt;
  return decimal.value;
}

std::optional<std::int32_t> read_integer(const Node& node, std::string_view what,
                                         std::int32_t lowest, Reporter& reporter) {
  constexpr std::int32_t highest = std::numeric_limits<std::int32_t>::max();
  const std::string expected =
      "an integer from " + std::to_string(lowest) + " to " + std::to_string(highest);
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected, reporter);
    return std::nullopt;
  }
  const Decimal decimal = parse_integer(node.text, lowest, highest);
  report_number(node, what, expected, {}, decimal.error, reporter);
  if (decimal.error != DecimalError::no_error) return std::nullopt;
  return static_cast<std::int32_t>(decimal.value);
}

std::optional<std::size_t> read_choice(const Node& node, std::string_view what,
                                       std::initializer_list<std::string_view> choices,
                                       Reporter& reporter) {
  std::string expected;
  std::size_t place = 0;
  for (const std::string_view choice : choices) {
    if (place > 0) expected += place + 1 == choices.size() ? " or " : ", ";
    expected += choice;
    ++place;
  }
  const std::optional<std::string_view> text = read_text(node, what, expected, reporter);
  if (!text) return std::nullopt;
  const auto* const found = std::find(choices.begin(), choices.end(), *text);
  if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());

  std::string message = must_be(what, expected) + ", found " + describe(node);
  const std::vector<std::string_view> names(choices);
  message += did_you_mean(nearest(*text, names));
  reporter.report(rule::invalid_value, node.range, std::move(message));
  return std::nullopt;
}

}  // namespace cbc::yaml
