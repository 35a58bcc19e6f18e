#pragma once

#include <vector>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// Counts the constraints of each group.
[[nodiscard]] std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog);

}  // namespace cbc
