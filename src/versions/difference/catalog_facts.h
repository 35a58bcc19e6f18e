#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "versions/difference/catalog_diff.h"
#include "versions/names/renames.h"

namespace cbc {

// What a catalog says, in a form that two of them can be compared in.

/// The beginning of the name of an attribute that is a condition on a situation variable.
inline constexpr std::string_view condition_prefix = "situation ";
/// The beginning of the name of an attribute that is a parameter of a task.
inline constexpr std::string_view parameter_prefix = "parameter ";

/// Zero stands for nothing in compiled catalogs.
template <typename Number>
[[nodiscard]] AttributeValue unless_zero(Number number) {
  return number == 0 ? AttributeValue() : AttributeValue(number);
}

/// A catalog, and what its things are called in a comparison; both catalogs must outlive it.
struct NamedCatalog {
  const CompiledCatalog& catalog;
  std::vector<std::string_view> tasks;      ///< by TaskId
  std::vector<std::string_view> behaviors;  ///< by BehaviorId
  std::vector<std::string_view> variables;
  std::vector<std::string> limits;  ///< by limit: its tasks by name
};
[[nodiscard]] NamedCatalog with_own_names(const CompiledCatalog& catalog);
/// The older catalog, with the names that the newer one has for what was renamed.
[[nodiscard]] NamedCatalog with_new_names(const CompiledCatalog& before,
                                          const CompiledCatalog& after, const Renames& renames);

/// An attribute and its value.
struct Attribute {
  std::string name;
  AttributeValue value;    ///< what is compared
  std::string shown = {};  ///< if not empty, what is shown of it
};
using Attributes = std::vector<Attribute>;  ///< in the order of names

/// Something that a catalog says, and the names by which to find it in another one.
struct Fact {
  std::string_view first;
  std::string_view second;  ///< of pairs
  Attributes attributes;
};
[[nodiscard]] bool precedes(const Fact& a, const Fact& b);

/// In the order of names; none of exclusions.
[[nodiscard]] std::vector<Fact> facts(const NamedCatalog& named, CatalogChange::Subject subject);

/// Adds the differences between all that two catalogs say of a subject.
void compare_facts(CatalogChange::Subject subject, const NamedCatalog& before,
                   const NamedCatalog& after, std::vector<CatalogChange>& changes);

}  // namespace cbc
