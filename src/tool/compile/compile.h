#pragma once

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "compiled/derive.h"

namespace cbc {

/// Works out all that does not depend on the situation. `catalog` is one that read_catalog accepted
/// (acyclic).
[[nodiscard]] CompiledCatalog compile(const Catalog& catalog);

}  // namespace cbc
