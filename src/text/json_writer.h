#pragma once

#include <string>
#include <string_view>

#include "text/json_text.h"

namespace cbc {

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

}  // namespace cbc
