#include "support/json.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

}  // namespace

std::string to_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void append_item(std::string& array, const std::string& item) {
  array += array.back() == '[' ? "\n" : ",\n";
  array += item;
}

void append_text(std::string& json, std::string_view text) {
  if (!is_plain(text)) {
    json += to_text(text);
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
  json += to_text(number);
}

void append_seconds(std::string& json, Microseconds time) {
  append_integer(json, time / second);
  std::string fraction = std::to_string(second + time % second);
  fraction.front() = '.';
  while (fraction.size() > 2 && fraction.back() == '0') fraction.pop_back();
  json += fraction;
}

std::size_t nesting_of(std::string_view json) {
  std::size_t open = 0;
  std::size_t deepest = 0;
  bool is_string = false;
  for (std::size_t place = 0; place < json.size(); ++place) {
    const char c = json[place];
    if (c == '"') {
      is_string = !is_string;
    } else if (is_string) {
      if (c == '\\') ++place;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++open);
    } else if ((c == ']' || c == '}') && open > 0) {
      --open;
    }
  }
  return deepest;
}

}  // namespace cbc
