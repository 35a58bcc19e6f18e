// Single mistakes put into the text of good catalogs. Each knows from its own edit what lint has to
// report, and where.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "catalog_outline.h"
#include "random.h"

namespace cbc::mutation {

using oracle::Random;

/// A finding that there must be.
struct Expected {
  std::string_view rule;
  std::set<std::size_t> lines;        ///< it begins on one of them
  std::optional<std::size_t> column;  ///< and there, if that is given
  std::string says = {};              ///< part of the message
};

struct Mutation {
  std::string text;
  std::vector<Expected> expected;
  /// Other rules that the mutated catalog may break in new ways, as its meaning has changed.
  std::set<std::string_view> also = {};
};

/// Nothing if there is no place for the mistake in the catalog.
using Mutator = std::optional<Mutation> (*)(const CatalogOutline& catalog, Random& random);

struct MistakeKind {
  std::string_view name;
  Mutator apply;
};

/// Of the YAML itself.
[[nodiscard]] std::vector<MistakeKind> syntax_mistakes();
/// Keys that are absent, unknown, given twice, or in the wrong place.
[[nodiscard]] std::vector<MistakeKind> key_mistakes();
/// Values of the wrong type, or out of range.
[[nodiscard]] std::vector<MistakeKind> value_mistakes();
/// Names that are not defined, or defined twice.
[[nodiscard]] std::vector<MistakeKind> name_mistakes();
/// What is understood, but cannot be meant.
[[nodiscard]] std::vector<MistakeKind> meaning_mistakes();

// What the mutators share -------------------------------------------------------------------------

[[nodiscard]] std::string spaces(std::size_t count);

/// The name in quotes, as messages show it.
[[nodiscard]] std::string in_quotes(std::string_view name);

/// A finding at a place of `lines`, which is a key or a value: line from 1, column from 0.
[[nodiscard]] Expected at(const Lines& lines, std::string_view rule, std::size_t line,
                          std::size_t column, std::string says = {});

/// Adds an entry to a mapping, at its end. Returns its line.
std::size_t add_field(Lines& lines, const Item& mapping, const std::string& content);

/// Takes a field out of a mapping that has others. Returns the first line of the mapping.
std::size_t remove_field(Lines& lines, const Item& mapping, const Field& field);

/// Puts another text in the place of a value that is a scalar.
void set_value(Lines& lines, const Field& field, std::string_view now);

/// The lines of an entry of a list, from its dash.
[[nodiscard]] std::vector<std::string> copy_entry(const Lines& lines, const Item& list,
                                                  const Item& entry);

/// A word with one letter missing, doubled, replaced or swapped with its neighbor.
[[nodiscard]] std::string misspell(const std::string& word, Random& random);

/// Whether `name` is no more than one edit from `meant`, and further from all other words.
[[nodiscard]] bool is_clear_misspelling(std::string_view name, std::string_view meant,
                                        const std::vector<std::string_view>& words);

/// All that fulfil a condition, then one of them.
template <typename T, typename Condition>
const T* pick_if(const std::vector<T>& items, Random& random, Condition condition) {
  std::vector<const T*> candidates;
  for (const T& item : items) {
    if (condition(item)) candidates.push_back(&item);
  }
  return candidates.empty() ? nullptr : random.pick(candidates);
}

/// A field with the mapping that it stands in.
struct PlacedField {
  const Shape* shape;
  const Item* mapping;
  const Field* field;
};

[[nodiscard]] std::vector<PlacedField> all_fields(const CatalogOutline& catalog);

}  // namespace cbc::mutation
