#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// What an attribute is set to: nothing, a truth, a degree, a time or a word.
using AttributeValue = std::variant<std::monostate, bool, Millionths, Microseconds, std::string>;

/// One attribute of what both catalogs have.
struct AttributeChange {
  std::string name;  ///< as the catalog spells it; "parameter NAME" for one of a task
  AttributeValue before;
  AttributeValue after;
};

/// One difference between two catalogs.
struct CatalogChange {
  enum class Kind : std::uint8_t { removed, added, changed };
  enum class Subject : std::uint8_t {
    task,         ///< `task`
    behavior,     ///< `behavior`
    performs,     ///< `behavior` performs `task`; attribute "suitability"
    requirement,  ///< `behavior` requires `task`; attribute "minimum_performance"
    exclusion     ///< `task` excludes `other_task`, which stands behind it in the order of names
  };
  Kind kind = Kind::changed;
  Subject subject = Subject::task;
  std::string task;
  std::string other_task;
  std::string behavior;
  /// Of `changed`, at least one; of others, what is set: `before` of removed, `after` of added.
  std::vector<AttributeChange> attributes;
};

[[nodiscard]] std::string_view name_of(CatalogChange::Kind kind);
[[nodiscard]] std::string_view name_of(CatalogChange::Subject subject);

/// What two catalogs do not have in common, in the order of subjects and, within one, of names.
struct CatalogDiff {
  std::vector<CatalogChange> changes;
  /// Exclusions that differ beyond the most that are listed.
  std::uint64_t further_exclusions = 0;

  [[nodiscard]] std::uint64_t size() const { return changes.size() + further_exclusions; }
};

/// Exclusions listed at most: two lists of n tasks may differ in n² of them.
inline constexpr std::size_t most_listed_exclusions = 100'000;

/// Compares what two catalogs say, not how: names decide what belongs together; order, layout,
/// comments, older keys, and how exclusions are put into lists do not count.
[[nodiscard]] CatalogDiff compare_catalogs(const CompiledCatalog& before,
                                           const CompiledCatalog& after);

/// What a difference says of an attribute: "timeout 5 s -> 10 s" if it has changed, "timeout 5 s"
/// if one catalog alone has it.
[[nodiscard]] std::string describe(const CatalogChange& change, const AttributeChange& attribute);

}  // namespace cbc
