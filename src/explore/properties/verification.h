#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/witness.h"
#include "explore/properties/explore.h"
#include "runtime/compiled/compiled_catalog.h"

// The answers to all questions of a property file, or about all groups of a catalog.

namespace cbc {

/// What was found out about one property.
struct PropertyAnswer {
  const Property* property = nullptr;
  /// Place in Verification::explorations; nothing: the constraints alone decided it.
  std::optional<std::size_t> exploration;
  Verdict verdict;
  std::optional<Witness> witness;  ///< of the verdict's script
};

/// What was found out about a catalog under the assumptions of one property file, or under the
/// default ones.
struct Verification {
  const PropertyFile* file = nullptr;  ///< null: default assumptions, no properties
  std::vector<Exploration> explorations;
  std::vector<PropertyAnswer> answers;  ///< in the order of the file

  [[nodiscard]] bool is_complete() const;
};

/// Explores each group of the catalog by itself under the default assumptions.
[[nodiscard]] Verification verify_groups(const CompiledCatalog& catalog,
                                         const ExplorationOptions& options);

/// Answers the properties of a file, those of one scope by the same exploration, but for what the
/// constraints alone decide (constraint_proof.h). Without properties each group is explored by
/// itself under the assumptions of the file.
[[nodiscard]] Verification verify_properties(const CompiledCatalog& catalog,
                                             const PropertyFile& file,
                                             const ExplorationOptions& options);

/// What a property is about. Properties of one scope are answered by the same exploration.
struct PropertyScope {
  /// Ascending: those of its tasks and behaviors; if there are none, those whose behaviors name its
  /// variables; if there are none either, and it is about faults of any behavior, all.
  std::vector<GroupId> groups;
  /// The variables that it names, but no behavior of these groups does.
  std::set<std::uint32_t> variables;
  /// Of a property with Property::after, whose mark is part of the state: itself.
  const Property* marked = nullptr;

  bool operator<(const PropertyScope& other) const {
    return std::tie(groups, variables, marked) <
           std::tie(other.groups, other.variables, other.marked);
  }
};
[[nodiscard]] PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property);

}  // namespace cbc
