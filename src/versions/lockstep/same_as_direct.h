#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/lockstep/same_as.h"
#include "versions/names/translation.h"

namespace cbc {

// What decides at run time and is no part of the states of two catalogs that are compared.

/// Timeouts, goals and parameters of what both have.
[[nodiscard]] std::vector<DirectDifference> compare_attributes(const CompiledCatalog& old_catalog,
                                                               const CompiledCatalog& new_catalog,
                                                               const Translation& to_old,
                                                               const Renames& renames);

/// What only one of two catalogs has.
struct MissingNames {
  std::vector<DirectDifference> differences;
  std::optional<Budget::End> end;    ///< of the first search that a limit ended
  std::optional<std::string> error;  ///< see Exploration
};

/// Finds what `catalog` has and the other one lacks, if it can be requested, be active, or change
/// under these assumptions about `catalog`.
[[nodiscard]] MissingNames find_missing(const CompiledCatalog& catalog, const Translation& to_other,
                                        const Assumptions& assumptions,
                                        const ExplorationOptions& options);

}  // namespace cbc
