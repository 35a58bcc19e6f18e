#pragma once

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "compiled/derive.h"

/// From the catalog that people write to the one that the solver uses.
namespace cbc {

/// Works out everything that does not depend on the situation. `catalog` is one that read_catalog
/// accepted, so its requirements are not cyclic.
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog);

}  // namespace cbc
