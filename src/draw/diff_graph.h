#pragma once

#include "compiled/compiled_catalog.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"

namespace cbc::draw {

/// Two catalogs as one: all that the newer one has, and what only the older one has, with marks
/// and notes of what `diff`, their comparison, says. Groups are those of the newer one; what it no
/// longer has is in the group of what it was connected with, or in none. The catalogs and `diff`
/// must outlive the result.
///
/// Exclusions that `diff` does not list are not marked.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                                    const CatalogDiff& diff);

}  // namespace cbc::draw
