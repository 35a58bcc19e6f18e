#pragma once

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// Does all that does not depend on the situation: groups, levels, constraint counts, costs, and
/// the flat arrays of the solver. `catalog` is one that read_catalog accepted (acyclic).
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog);

}  // namespace cbc
