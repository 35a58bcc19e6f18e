#include "report/json_text.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace cbc {
namespace {

/// Whether a character stands for itself in a text of JSON.
bool is_plain(char character) {
  return character >= ' ' && character <= '~' && character != '"' && character != '\\';
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
  if (!std::all_of(text.begin(), text.end(), is_plain)) {
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

}  // namespace cbc
