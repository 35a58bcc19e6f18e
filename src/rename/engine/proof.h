#pragma once

#include "core/catalog/name_place.h"
#include "core/catalog/renaming.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/lockstep/same_as.h"

namespace cbc {

/// Proves that a rename changes nothing but a name: compares two catalogs, of which the second has
/// the new name for what the first has the old name for, as `cbc verify --same-as` does. Each
/// exploration ends after `max_states` pairs of states.
[[nodiscard]] CatalogComparison compare_renamed(const CompiledCatalog& before,
                                                const CompiledCatalog& after,
                                                const Renaming& renaming, const Budget& budget,
                                                unsigned jobs);

}  // namespace cbc
