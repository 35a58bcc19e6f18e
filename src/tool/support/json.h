#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
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

/// Writes JSON member by member, straight to the end of a text, on one line. Whoever calls it opens
/// and closes brackets in pairs.
class JsonWriter {
 public:
  /// The text must outlive this object.
  explicit JsonWriter(std::string& text) : text_(text) {}

  /// Begins an object or an array, as an item of an array or the whole.
  void open(char bracket) {
    separate();
    text_ += bracket;
  }
  /// Begins one, as a member of an object.
  void open(std::string_view name, char bracket) {
    key(name);
    text_ += bracket;
  }
  void close(char bracket) { text_ += bracket; }

  // Members of an object.

  void key(std::string_view name) {
    separate();
    append_text(text_, name);
    text_ += ':';
  }
  /// `value` is JSON already.
  void write_json(std::string_view name, std::string_view value) {
    key(name);
    text_ += value;
  }
  void write_text(std::string_view name, std::string_view value) {
    key(name);
    append_text(text_, value);
  }
  template <typename Integer>
  void write_integer(std::string_view name, Integer value) {
    key(name);
    append_integer(text_, value);
  }
  void write_number(std::string_view name, double value) {
    key(name);
    append_number(text_, value);
  }
  void write_seconds(std::string_view name, Microseconds time) {
    key(name);
    append_seconds(text_, time);
  }
  void write_truth(std::string_view name, bool value) {
    key(name);
    text_ += value ? "true" : "false";
  }
  void write_null(std::string_view name) {
    key(name);
    text_ += "null";
  }

  /// An item of an array.
  void write_text(std::string_view value) {
    separate();
    append_text(text_, value);
  }

 private:
  void separate() {
    if (!text_.empty() && text_.back() != '{' && text_.back() != '[') text_ += ',';
  }

  std::string& text_;
};

/// How deep the arrays and objects of a JSON text are nested: 0 of a number, 1 of `[]`. Takes any
/// text, and no memory: a reader of JSON takes a hundred bytes for each level.
[[nodiscard]] std::size_t nesting_of(std::string_view json);

}  // namespace cbc
