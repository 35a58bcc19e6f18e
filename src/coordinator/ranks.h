#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// By value, its place in the order of its task if behaviors of equal suitability are put in an
/// order drawn from `seed`.
[[nodiscard]] std::vector<std::uint32_t> draw_ranks(const CompiledCatalog& catalog,
                                                    std::uint64_t seed);

}  // namespace cbc
