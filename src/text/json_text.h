#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "cbc/units.h"

namespace cbc {

/// JSON on one line. Names may hold bytes that no JSON text can; they are replaced.
[[nodiscard]] std::string to_text(const nlohmann::ordered_json& json);

/// Appends an item of an array that has one item on a line, begun by `[`.
void append_item(std::string& array, const std::string& item);

// These append what to_text gives for the value, without making a tree of it.

void append_text(std::string& json, std::string_view text);
void append_number(std::string& json, double number);
template <std::integral Integer>
void append_integer(std::string& json, Integer number) {
  char digits[24];
  json.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// Appends a time, which is not negative, in seconds: exact, as what reads it counts microseconds.
/// The nearest double would not do: some of them become text with more digits.
void append_seconds(std::string& json, Microseconds time);

}  // namespace cbc
