#pragma once

#include <array>
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

/// Reads all of a text as a decimal number. Empty if it is none, or one that no double can hold.
[[nodiscard]] std::optional<double> read_double(std::string_view text);

/// Collects JSON in a block of its own before it goes to the end of a text: much is written in
/// small pieces, and a block takes them faster than a string does.
class JsonBuffer {
 public:
  /// The text must outlive this object. It is complete after flush(), or when this object ends.
  explicit JsonBuffer(std::string& text) : text_(text) {}
  ~JsonBuffer() { flush(); }
  JsonBuffer(const JsonBuffer&) = delete;
  JsonBuffer& operator=(const JsonBuffer&) = delete;

  /// The last character; '[' of an empty text.
  [[nodiscard]] char last() const {
    if (used_ > 0) return block_[used_ - 1];
    return text_.empty() ? '[' : text_.back();
  }

  // As it is.

  void put(char character) {
    make_room(1);
    block_[used_++] = character;
  }
  void put(std::string_view json);

  // Values.

  /// Invalid UTF-8 is replaced by U+FFFD.
  void put_text(std::string_view text);
  /// The name of a member with its colon, behind a comma or not.
  void put_name(std::string_view name, bool has_comma);
  void put_number(double number);
  template <std::integral Integer>
  void put_integer(Integer number) {
    make_room(most_digits);
    char* const begin = block_.data() + used_;
    used_ +=
        static_cast<std::size_t>(std::to_chars(begin, begin + most_digits, number).ptr - begin);
  }
  /// A number of millionths, which is not negative, in units: exactly, as a double could not be.
  void put_millionths(std::int64_t number);
  /// A boolean, a number, a text, nullptr, or an optional, which is null if it is empty.
  template <typename Value>
  void put_value(const Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
      put(value ? std::string_view("true") : std::string_view("false"));
    } else if constexpr (std::is_same_v<Value, std::nullptr_t>) {
      put(std::string_view("null"));
    } else if constexpr (std::integral<Value>) {
      put_integer(value);
    } else if constexpr (std::floating_point<Value>) {
      put_number(value);
    } else if constexpr (requires { value.has_value(); }) {
      if (value.has_value()) {
        put_value(*value);
      } else {
        put_value(nullptr);
      }
    } else {
      put_text(value);
    }
  }

  void flush() {
    text_.append(block_.data(), used_);
    used_ = 0;
  }

 private:
  static constexpr std::size_t most_digits = 24;

  void make_room(std::size_t bytes) {
    if (block_.size() - used_ < bytes) flush();
  }

  std::string& text_;
  std::size_t used_ = 0;
  std::array<char, 2048> block_;  // most events fit
};

/// Invalid UTF-8 is replaced by U+FFFD.
inline void append_text(std::string& json, std::string_view text) {
  JsonBuffer(json).put_text(text);
}

/// Appends what a person wrote: a number as it stands, so that no digit is lost, if it is one in
/// JSON and a double can hold it; anything else as a text.
void append_as_written(std::string& json, std::string_view text);

/// The same in the shortest form of the number: 0.5 for 0.50.
void append_shortest(std::string& json, std::string_view text);

/// See JsonBuffer::put_value.
template <typename Value>
void append_value(std::string& json, const Value& value) {
  JsonBuffer(json).put_value(value);
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

  void put_to(JsonBuffer& json) const {
    std::visit([&](const auto& value) { json.put_value(value); }, value_);
  }

 private:
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string_view> value_;
};

inline constexpr Millionths one_percent = one_million / 100;

/// A degree as a number of percent.
[[nodiscard]] constexpr double in_percent(Millionths degree) {
  return static_cast<double>(degree) / one_percent;
}

/// Plain members of an object, in their order: {{"index", 1}, {"count", 2}}.
struct JsonMember {
  std::string_view name;
  JsonPlain value;
};
using JsonMembers = std::initializer_list<JsonMember>;

/// Writes JSON value by value to the end of a text, without a tree in memory. The caller opens and
/// closes brackets in pairs, and gives names to the members of objects only. The text is complete
/// when all brackets are closed, after flush(), and when the writer ends.
class JsonWriter {
 public:
  enum class Layout : std::uint8_t { line, indented };

  /// The text must outlive this object. `indented`: every item and member on its own line, one
  /// blank deeper than its bracket.
  explicit JsonWriter(std::string& text, Layout layout = Layout::line)
      : json_(text), is_indented_(layout == Layout::indented) {}

  /// Begins an object or an array.
  void open(char bracket) {
    separate();
    json_.put(bracket);
    ++depth_;
  }
  void open(std::string_view name, char bracket) {
    key(name);
    json_.put(bracket);
    ++depth_;
  }
  void close(char bracket) {
    --depth_;
    if (is_indented_ && json_.last() != '{' && json_.last() != '[') break_line();
    json_.put(bracket);
    if (depth_ <= 0) flush();
  }
  void flush() { json_.flush(); }

  /// Puts the next item or member on a line of its own.
  JsonWriter& on_new_line() {
    has_new_line_ = true;
    return *this;
  }

  /// The name of a member; its value is written next.
  void key(std::string_view name) {
    if (!is_indented_ && !has_new_line_) {
      json_.put_name(name, follows_another());
      return;
    }
    separate();
    json_.put_name(name, false);
    if (is_indented_) json_.put(' ');
  }

  /// Separates the next item of an array from the one before it.
  void begin_item() {
    if (follows_another()) json_.put(',');
    if (is_indented_ && depth_ > 0) break_line();
    if (has_new_line_) json_.put('\n');
    has_new_line_ = false;
  }

  // The value of a key, an item that has begun, or the whole.

  void begin(char bracket) {
    json_.put(bracket);
    ++depth_;
  }
  template <typename Value>
  void put(const Value& value) {
    json_.put_value(value);
  }
  /// A time, which is not negative.
  void put_seconds(Microseconds time) {
    static_assert(second == 1'000'000);
    json_.put_millionths(time);
  }
  /// In percent: as a whole number where it is one.
  void put_percent(Millionths degree);
  /// `json` is JSON already.
  void put_json(std::string_view json) { json_.put(json); }

  // An item of an array, the value of a key, or the whole; with a name, a member of an object.

  template <typename Value>
  void write(const Value& value) {
    separate();
    json_.put_value(value);
  }
  template <typename Value>
  void write(std::string_view name, const Value& value) {
    key(name);
    json_.put_value(value);
  }
  /// Members of the open object.
  void write_members(JsonMembers members) {
    for (const JsonMember& member : members) {
      key(member.name);
      member.value.put_to(json_);
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
  /// A time, which is not negative.
  void write_seconds(std::string_view name, Microseconds time) {
    key(name);
    static_assert(second == 1'000'000);
    json_.put_millionths(time);
  }
  /// `json` is JSON already.
  void write_json(std::string_view json) {
    separate();
    json_.put(json);
  }
  void write_json(std::string_view name, std::string_view json) {
    key(name);
    json_.put(json);
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
    const char last = json_.last();
    if (last != ':' && last != ' ') begin_item();  // not after a key
  }
  /// Whether the next item or member is not the first one.
  [[nodiscard]] bool follows_another() const {
    const char last = json_.last();
    return last != '{' && last != '[';
  }
  void break_line() {
    json_.put('\n');
    for (int blank = 0; blank < depth_; ++blank) json_.put(' ');
  }

  JsonBuffer json_;
  const bool is_indented_;
  bool has_new_line_ = false;
  int depth_ = 0;  ///< negative if it closes brackets that were in the text
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
