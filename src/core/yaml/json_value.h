#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/support/json.h"
#include "core/yaml/document.h"
#include "runtime/base/text.h"

// Typed access to the tree of a JSON text, for files that programs write: the first mistake ends
// the reading. What people write is read with Fields, which reports all mistakes with their places.

namespace cbc::yaml {

/// A JSON text is not what it should be. The message is for people: "'seed' is missing".
struct JsonFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A value in a tree of JsonReader, with the name that messages call it. The tree must outlive it.
/// The functions throw a JsonFault if the value is not what is asked for.
class JsonValue {
 public:
  explicit JsonValue(const Node& node, std::string_view name = {}) : node_(&node), name_(name) {}

  [[nodiscard]] bool is_null() const { return node_->kind == Kind::null; }

  /// The member of an object; the first one of the name. A null is a value here.
  [[nodiscard]] std::optional<JsonValue> find(std::string_view name) const {
    for (const auto& [key, value] : of_kind(Kind::mapping, "an object").entries) {
      if (key->text == name) return JsonValue(*value, key->text);
    }
    return std::nullopt;
  }
  /// The same of a member that must be there.
  [[nodiscard]] JsonValue operator[](std::string_view name) const {
    if (const auto value = find(name)) return *value;
    throw JsonFault(quote(name) + " is missing");
  }
  [[nodiscard]] std::vector<JsonValue> members() const {
    std::vector<JsonValue> members;
    for (const auto& [key, value] : of_kind(Kind::mapping, "an object").entries) {
      members.emplace_back(*value, key->text);
    }
    return members;
  }
  /// The items of an array, which are called as it is.
  [[nodiscard]] std::vector<JsonValue> items() const {
    std::vector<JsonValue> items;
    for (const Node* item : of_kind(Kind::sequence, "a list").items) {
      items.emplace_back(*item, name_);
    }
    return items;
  }

  /// The name of a member.
  [[nodiscard]] std::string_view name() const { return name_; }

  /// Says that a word is none of those that the value, or anything of this kind, may be.
  [[noreturn]] void refuse_word(std::string_view word) const { refuse_word(name_, word); }
  [[noreturn]] static void refuse_word(std::string_view what, std::string_view word) {
    throw JsonFault(concat("there is no ", what, " ", quote(word)));
  }

  [[nodiscard]] std::string text() const {
    if (node_->kind != Kind::scalar || node_->plain) fail("a text");
    return node_->text;
  }
  [[nodiscard]] bool truth() const {
    const bool is_true = is_plain() && node_->text == "true";
    if (!is_true && !(is_plain() && node_->text == "false")) fail("true or false");
    return is_true;
  }
  /// A whole number; `least` is not negative.
  template <std::integral Integer>
  [[nodiscard]] Integer integer(Integer least = 0,
                                Integer most = std::numeric_limits<Integer>::max()) const {
    std::uint64_t value = 0;
    const char* const last = node_->text.data() + node_->text.size();
    const auto [end, error] = std::from_chars(node_->text.data(), last, value);
    const bool is_read = is_plain() && error == std::errc() && end == last;
    if (is_read && std::cmp_greater_equal(value, least) && std::cmp_less_equal(value, most)) {
      return static_cast<Integer>(value);
    }
    if (most == std::numeric_limits<Integer>::max()) fail("a whole number in its range");
    fail("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  [[nodiscard]] double number(double least, double most, std::string_view range) const {
    const auto value = is_plain() ? read_double(node_->text) : std::nullopt;
    if (!value || !(*value >= least && *value <= most)) fail("a number " + std::string(range));
    return *value;
  }

 private:
  [[nodiscard]] bool is_plain() const { return node_->kind == Kind::scalar && node_->plain; }

  [[nodiscard]] const Node& of_kind(Kind kind, std::string_view expected) const {
    if (node_->kind != kind) fail(expected);
    return *node_;
  }

  [[noreturn]] void fail(std::string_view expected) const {
    throw JsonFault((name_.empty() ? "it" : quote(name_)) + " is not " + std::string(expected));
  }

  const Node* node_;
  std::string_view name_;
};

}  // namespace cbc::yaml
