#include "support/json.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <system_error>

#include <nlohmann/json.hpp>

namespace cbc {
namespace {

/// A word of eight times the same character.
constexpr std::uint64_t eight(char character) {
  return static_cast<std::uint64_t>(character) * 0x0101010101010101;
}

/// Whether eight characters stand for themselves in a text of JSON: they are ASCII, not below the
/// space, and neither a quote nor a backslash. Each of the others sets the highest bit of its byte.
bool is_plain(std::uint64_t word) {
  return ((word | (word - eight(' ')) | ((word ^ eight('"')) - eight(1)) |
           ((word ^ eight('\\')) - eight(1))) &
          0x8080808080808080) == 0;
}

bool is_plain(std::string_view text) {
  std::uint64_t word = eight(' ');
  if (text.size() < sizeof word) {
    std::memcpy(&word, text.data(), text.size());
    return is_plain(word);
  }
  const char* const last = text.data() + text.size() - sizeof word;
  for (const char* place = text.data(); place < last; place += sizeof word) {
    std::memcpy(&word, place, sizeof word);
    if (!is_plain(word)) return false;
  }
  std::memcpy(&word, last, sizeof word);
  return is_plain(word);
}

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// Whether a text is a number of JSON. One that no double can hold is none here, as many readers of
/// JSON refuse it.
bool is_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  // These are not numbers in JSON: .5, 05, 5., inf
  if (text.starts_with('-')) text.remove_prefix(1);
  if (!is_digit(text.front())) return false;
  if (text.size() > 1 && text.front() == '0' && is_digit(text[1])) return false;
  const std::size_t point = text.find('.');
  return point == std::string_view::npos || (point + 1 < text.size() && is_digit(text[point + 1]));
}

std::string dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void append_text(std::string& json, std::string_view text) {
  if (!is_plain(text)) {
    json += dump(text);
    return;
  }
  json += '"';
  json += text;
  json += '"';
}

void append_number(std::string& json, double number) {
  // Whole numbers, which are many, need no search for the fewest digits.
  constexpr double few_digits = 1e9;
  if (std::abs(number) < few_digits && std::trunc(number) == number && !std::signbit(number)) {
    append_integer(json, static_cast<std::int64_t>(number));
    json += ".0";
    return;
  }
  json += dump(number);
}

void append_as_written(std::string& json, std::string_view text) {
  if (is_number(text)) {
    json += text;
  } else {
    append_text(json, text);
  }
}

void append_shortest(std::string& json, std::string_view text) {
  const auto number = nlohmann::json::parse(text, nullptr, false);
  json += dump(number.is_number() ? number : nlohmann::json(text));
}

void append_seconds(std::string& json, Microseconds time) {
  append_integer(json, time / second);
  std::string fraction = std::to_string(second + time % second);
  fraction.front() = '.';
  while (fraction.size() > 2 && fraction.back() == '0') fraction.pop_back();
  json += fraction;
}

void JsonWriter::write_percent(std::string_view name, std::optional<Millionths> degree) {
  constexpr Millionths percent = one_million / 100;
  if (!degree) {
    write(name, nullptr);
  } else if (*degree % percent == 0) {
    write(name, *degree / percent);
  } else {
    write(name, static_cast<double>(*degree) / percent);
  }
}

}  // namespace cbc
