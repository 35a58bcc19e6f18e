#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/explore.h"
#include "verify/engine/witness.h"

namespace cbc {

/// What was found out about one property.
struct Answer {
  const Property* property = nullptr;
  std::size_t exploration = 0;  ///< place in Verification::explorations
  Verdict verdict;
  std::optional<Witness> witness;  ///< of the verdict's script
};

/// What was found out about a catalog under the assumptions of one property file, or under the
/// default ones.
struct Verification {
  const PropertyFile* file = nullptr;  ///< null: default assumptions, no properties
  std::vector<Exploration> explorations;
  std::vector<Answer> answers;  ///< in the order of the file

  [[nodiscard]] bool is_complete() const;
};

/// Options of a verification; `on_progress` is told the groups that are explored, too.
struct VerificationOptions {
  ExplorationLimits limits;  ///< of each exploration
  unsigned jobs = 1;
  bool reduce = false;  ///< see ExplorationOptions
  std::function<bool(const std::vector<std::uint32_t>& groups, const ExplorationProgress&)>
      on_progress;
};

/// Explores each group of the catalog by itself under the default assumptions.
[[nodiscard]] Verification verify_groups(const CompiledCatalog& catalog,
                                         const VerificationOptions& options);

/// Answers the properties of a file, those of one scope by the same exploration. Without properties
/// each group is explored by itself under the assumptions of the file.
[[nodiscard]] Verification verify_properties(const CompiledCatalog& catalog,
                                             const PropertyFile& file,
                                             const VerificationOptions& options);

/// What a property is about. Properties of one scope are answered by the same exploration.
struct PropertyScope {
  /// Ascending: those of its tasks and behaviors; if there are none, those whose behaviors name its
  /// variables.
  std::vector<std::uint32_t> groups;
  /// The variables that it names, but no behavior of these groups does.
  std::set<std::uint32_t> variables;

  auto operator<=>(const PropertyScope&) const = default;
};
[[nodiscard]] PropertyScope scope_of(const CompiledCatalog& catalog, const Property& property);

}  // namespace cbc
