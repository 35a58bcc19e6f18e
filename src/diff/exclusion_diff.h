#pragma once

#include "diff/catalog_diff.h"

namespace cbc {

/// Adds the pairs of tasks that exclude one another in one of the catalogs only, in the order of
/// names.
void compare_exclusions(const CompiledCatalog& before, const CompiledCatalog& after,
                        CatalogDiff& diff);

}  // namespace cbc
