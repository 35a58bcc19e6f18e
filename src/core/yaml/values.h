#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cbc/units.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

/// Mappings with known keys, and values of known types, with findings about all that is different.
namespace cbc::yaml {

/// Reports keys that are given twice in a mapping that may have any keys.
void report_duplicate_keys(const Node& mapping, Reporter& reporter);

/// Whether a text stands in a list, or is a key of a mapping.
[[nodiscard]] bool stands_in(const Node& node, std::string_view text);

/// A key that a mapping may have.
struct Key {
  std::string_view name;
  std::string_view replaced_by = {};  ///< of an older name: the present one
  /// Of an older name: how its value is written under the present one, or nothing if the value is
  /// not valid. Values stay as they are without it.
  std::optional<std::string_view> (*translate)(const Node& value) = nullptr;
};

/// A key that a mapping does not have, though people expect it there.
struct Hint {
  std::string_view key;
  std::string_view advice;     ///< where to say it
  bool is_constraint = false;  ///< without it, more is allowed than was meant: an error
};

/// What a kind of mapping may contain.
struct Shape {
  std::string_view what;  ///< "a task"
  std::span<const Key> keys;
  const Shape* outer = nullptr;              ///< the mapping this one stands in
  std::span<const Shape* const> inner = {};  ///< mappings that stand in this one
  bool is_entry = false;                     ///< it stands in a list
  std::span<const Hint> hints = {};
  bool tells_keys = false;  ///< what is said of an unknown key ends with the known ones

  [[nodiscard]] bool has(std::string_view key) const;
};

/// "'start', 'stop' and 'faults'"
[[nodiscard]] std::string list_keys(const Shape& shape);

/// What becomes of keys that a mapping must not have.
enum class UnknownKeys : std::uint8_t {
  ignored,  ///< it is understood without them; it is an error if a known key is probably meant
  refused   ///< each of them is an error that settings cannot change
};

/// The keys of a mapping, sorted out: duplicates and older names are reported, keys that begin with
/// "x-" are ignored, and a null value is as if its key were absent.
class Fields {
 public:
  /// Reads several mappings as if they were one. `shape` and `reporter` must outlive this object.
  Fields(std::span<const Node* const> mappings, const Shape& shape, Reporter& reporter);
  Fields(const Node& mapping, const Shape& shape, Reporter& reporter);

  /// The value of a key, or nullptr if there is none.
  [[nodiscard]] const Node* find(std::string_view key) const;
  /// Whether a key is there, with or without a value.
  [[nodiscard]] bool has(std::string_view key) const;
  /// Whether the keys stand on lines of their own, not in braces.
  [[nodiscard]] bool is_block() const { return is_block_; }
  [[nodiscard]] bool has_unknown() const { return !unknown_.empty(); }
  /// Whether all keys are understood: none is unknown, or the user's own.
  [[nodiscard]] bool is_understood() const { return unknown_.empty() && !has_own_; }
  /// The place of a key that is there.
  [[nodiscard]] const Range& range_of(std::string_view key) const;

  /// What the mapping is called in messages: "behavior 'A'". At first the name of its shape.
  void call(std::string what) { what_ = std::move(what); }

  /// As `find`, but reports an absent key as missing at `range`. A misspelt key is taken in its
  /// place.
  [[nodiscard]] const Node* require(std::string_view key, const Range& range);

  /// Takes a misspelt key in the place of `key`, which is absent, and reports it as missing.
  [[nodiscard]] const Node* adopt(std::string_view key);

  /// Reports the unknown keys. Call it once, after all required keys were asked for.
  void report_unknown(UnknownKeys treatment);

 private:
  struct Field {
    std::size_t place = 0;  ///< of its key in the shape
    const Node* key = nullptr;
    const Node* value = nullptr;
    bool is_repeated = false;
  };

  void add_all(const Node& mapping);
  [[nodiscard]] bool begins_entry(const Node& mapping, const Node& key);
  /// Null if the key is not there.
  [[nodiscard]] const Field* find_field(std::string_view key) const;
  void add(const Node& key, const Node& value);
  void report_older_names();
  [[nodiscard]] std::string_view suggestion_for(std::string_view key) const;
  /// Whether a key of the shape is there, under its present name or an older one.
  [[nodiscard]] bool is_given(std::string_view key) const;
  [[nodiscard]] std::size_t place_of(std::string_view key) const;

  const Shape& shape_;
  Reporter& reporter_;
  std::string what_;
  std::vector<Field> fields_;  // those that are there; most mappings have few of their keys
  std::vector<Field> unknown_;
  bool has_own_ = false;  // a key that begins with "x-"
  bool is_block_ = false;
};

/// Which of some keys a mapping has.
struct ChosenKey {
  std::string_view name;           ///< empty: none of them, or several
  bool is_reported = false;        ///< that there are several
  std::string_view without_value;  ///< if there is none: one that has no value
};

/// Finds the only one of some keys that has a value. `what` begins the message about several: "an
/// event must have exactly one verb".
[[nodiscard]] ChosenKey choose_key(const Fields& fields, std::span<const std::string_view> keys,
                                   std::string_view what, Reporter& reporter);

// Readers of values. Each reports a value that is not as expected, and then returns nothing; `what`
// is the name of its key.

/// What a node is, for messages: "a list", "'80' in quotes".
[[nodiscard]] std::string describe(const Node& node);

/// The value of one of YAML 1.1's booleans; empty if the node is none of them.
[[nodiscard]] std::optional<bool> to_boolean(const Node& node);

/// Reports a node that is not what was `expected` ("a list of tasks").
void report_wrong_type(const Node& node, std::string_view what, std::string_view expected,
                       Reporter& reporter);

/// The node itself if it is a list or a mapping.
[[nodiscard]] const Node* read_list(const Node& node, std::string_view what,
                                    std::string_view expected, Reporter& reporter);
[[nodiscard]] const Node* read_mapping(const Node& node, std::string_view what,
                                       std::string_view expected, Reporter& reporter);

/// Any scalar, which may be empty.
[[nodiscard]] std::optional<std::string_view> read_text(const Node& node, std::string_view what,
                                                        std::string_view expected,
                                                        Reporter& reporter);

/// A name: any scalar that is not empty.
[[nodiscard]] std::optional<std::string_view> read_name(const Node& node, std::string_view what,
                                                        std::string_view expected,
                                                        Reporter& reporter);

/// One of YAML 1.1's booleans.
[[nodiscard]] std::optional<bool> read_boolean(const Node& node, std::string_view what,
                                               Reporter& reporter);

/// The other boolean, spelled in the same way ("No" of "Yes"); nothing if the node is none.
[[nodiscard]] std::optional<std::string_view> opposite(const Node& node);

[[nodiscard]] std::optional<Millionths> read_percent(const Node& node, std::string_view what,
                                                     Reporter& reporter);

/// Seconds; over 0 if `positive`.
[[nodiscard]] std::optional<Microseconds> read_seconds(const Node& node, std::string_view what,
                                                       bool positive, Reporter& reporter);

[[nodiscard]] std::optional<std::int32_t> read_integer(const Node& node, std::string_view what,
                                                       std::int32_t lowest, Reporter& reporter);

/// The index of a word among `choices`.
[[nodiscard]] std::optional<std::size_t> read_choice(const Node& node, std::string_view what,
                                                     std::span<const std::string_view> choices,
                                                     Reporter& reporter);

}  // namespace cbc::yaml
