#pragma once

#include <cstdint>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// The parameters that a task declares, `task` being its place in the catalog. Ranges are empty: a
/// compiled catalog does not say where its parameters stand.
[[nodiscard]] std::vector<Parameter> parameters_of(const CompiledCatalog& catalog,
                                                   std::uint32_t task);

}  // namespace cbc
