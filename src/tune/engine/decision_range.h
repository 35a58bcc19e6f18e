#pragma once

#include <vector>

#include "core/catalog/catalog.h"
#include "runtime/compiled/compiled_catalog.h"
#include "tune/engine/numbers.h"
#include "tune/engine/solved_problems.h"

namespace cbc {

/// How far a number may go from `value`, upwards or downwards, so that all decisions of `recorded`
/// stay. `catalog`: its source, where the number has this value.
[[nodiscard]] Millionths last_unchanged(const Catalog& catalog, const TunableNumber& number,
                                        Millionths value, const CompiledCatalog& recorded,
                                        const std::vector<SolvedProblem>& decisions, bool upwards);

}  // namespace cbc
