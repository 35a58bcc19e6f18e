#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "cbc/units.h"

// JSON as text: values appended to a string, and a writer that sets the commas between them.

namespace cbc {

/// Invalid UTF-8 is replaced by U+FFFD.
void append_text(std::string& json, std::string_view text);

void append_number(std::string& json, double number);

template <std::integral Integer>
void append_integer(std::string& json, Integer number) {
  char digits[24];
  json.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

/// Appends what a person wrote: a number as it stands, so that no digit is lost, if it is one in
/// JSON and a double can hold it; anything else as a text.
void append_as_written(std::string& json, std::string_view text);

/// The same in the shortest form of the number: 0.5 for 0.50.
void append_shortest(std::string& json, std::string_view text);

/// Appends a time, which is not negative, in seconds. It is exact to the microsecond; a double
/// would not be, as some of them need more digits.
void append_seconds(std::string& json, Microseconds time);

/// Appends a boolean, a number, a text, nullptr, or an optional, which is null if it is empty.
template <typename Value>
void append_value(std::string& json, const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    json += value ? "true" : "false";
  } else if constexpr (std::is_same_v<Value, std::nullptr_t>) {
    json += "null";
  } else if constexpr (std::integral<Value>) {
    append_integer(json, value);
  } else if constexpr (std::floating_point<Value>) {
    append_number(json, value);
  } else if constexpr (requires { value.has_value(); }) {
    if (value.has_value()) {
      append_value(json, *value);
    } else {
      json += "null";
    }
  } else {
    append_text(json, value);
  }
}

/// A boolean, a number, a text that outlives it, or null, which an empty optional is as well.
class JsonPlain {
 public:
  template <typename Value>
  JsonPlain(const Value& value) {  // NOLINT(google-explicit-constructor): stands for the value
    if constexpr (requires { value.has_value(); }) {
      if (value.has_value()) *this = JsonPlain(*value);
    } else if constexpr (std::is_same_v<Value, bool> || std::floating_point<Value>) {
      value_ = value;
    } else if constexpr (std::signed_integral<Value>) {
      value_ = std::int64_t{value};
    } else if constexpr (std::unsigned_integral<Value>) {
      value_ = std::uint64_t{value};
    } else if constexpr (!std::is_same_v<Value, std::nullptr_t>) {
      value_ = std::string_view(value);
    }
  }

  void append_to(std::string& json) const {
    std::visit([&](const auto& value) { append_value(json, value); }, value_);
  }

 private:
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string_view> value_;
};

/// Plain members of an object, in their order: {{"index", 1}, {"count", 2}}.
struct JsonMember {
  std::string_view name;
  JsonPlain value;
};
using JsonMembers = std::initializer_list<JsonMember>;

/// Writes JSON value by value to the end of a text, without a tree in memory. The caller opens and
/// closes brackets in pairs, and gives names to the members of objects only.
class JsonWriter {
 public:
  enum class Layout : std::uint8_t { line, indented };

  /// The text must outlive this object. `indented`: every item and member on its own line, one
  /// blank deeper than its bracket.
  explicit JsonWriter(std::string& text, Layout layout = Layout::line)
      : text_(text), is_indented_(layout == Layout::indented) {}

  /// Begins an object or an array.
  void open(char bracket) {
    separate();
    text_ += bracket;
    ++depth_;
  }
  void open(std::string_view name, char bracket) {
    key(name);
    text_ += bracket;
    ++depth_;
  }
  void close(char bracket) {
    --depth_;
    if (is_indented_ && text_.back() != '{' && text_.back() != '[') break_line();
    text_ += bracket;
  }

  /// Puts the next item or member on a line of its own.
  JsonWriter& on_new_line() {
    has_new_line_ = true;
    return *this;
  }

  /// The name of a member; its value is written next.
  void key(std::string_view name) {
    separate();
    append_text(text_, name);
    text_ += is_indented_ ? ": " : ":";
  }

  // An item of an array, the value of a key, or the whole; with a name, a member of an object.

  template <typename Value>
  void write(const Value& value) {
    separate();
    append_value(text_, value);
  }
  template <typename Value>
  void write(std::string_view name, const Value& value) {
    key(name);
    append_value(text_, value);
  }
  /// Members of the open object.
  void write_members(JsonMembers members) {
    for (const JsonMember& member : members) {
      key(member.name);
      member.value.append_to(text_);
    }
  }
  /// An object of plain members only.
  void write_object(JsonMembers members) {
    open('{');
    write_members(members);
    close('}');
  }
  void write_object(std::string_view name, JsonMembers members) {
    open(name, '{');
    write_members(members);
    close('}');
  }
  void write_seconds(std::string_view name, Microseconds time) {
    key(name);
    append_seconds(text_, time);
  }
  /// In percent: a whole number where it is one.
  void write_percent(std::string_view name, std::optional<Millionths> degree);
  /// `json` is JSON already.
  void write_json(std::string_view json) {
    separate();
    text_ += json;
  }
  void write_json(std::string_view name, std::string_view json) {
    key(name);
    text_ += json;
  }
  /// An array. `write_item` writes one of `items`.
  template <typename Items, typename WriteItem>
  void write_list(std::string_view name, const Items& items, WriteItem write_item) {
    open(name, '[');
    for (const auto& item : items) write_item(item);
    close(']');
  }
  /// An array of plain values.
  template <typename Items>
  void write_list(std::string_view name, const Items& items) {
    write_list(name, items, [this](const auto& item) { this->write(item); });
  }

 private:
  void separate() {
    const char last = text_.empty() ? '[' : text_.back();
    if (last == ':' || last == ' ') return;  // after a key
    if (last != '{' && last != '[') text_ += ',';
    if (is_indented_ && depth_ > 0) break_line();
    if (has_new_line_) text_ += '\n';
    has_new_line_ = false;
  }
  void break_line() {
    text_ += '\n';
    text_.append(depth_, ' ');
  }

  std::string& text_;
  const bool is_indented_;
  bool has_new_line_ = false;
  std::size_t depth_ = 0;
};

/// An object on a line of its own. `write_members` writes its members to a JsonWriter.
template <typename WriteMembers>
[[nodiscard]] std::string json_line(WriteMembers write_members,
                                    JsonWriter::Layout layout = JsonWriter::Layout::line) {
  std::string text;
  JsonWriter json(text, layout);
  json.open('{');
  write_members(json);
  json.close('}');
  return text + "\n";
}

}  // namespace cbc
