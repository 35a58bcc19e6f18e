#pragma once

#include <cstddef>
#include <string>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

// Properties and assumptions in words.

namespace cbc {

/// "LAND can always start with priority 3"
[[nodiscard]] std::string describe_property(const CompiledCatalog& catalog,
                                            const Property& property);

/// What may happen, and who says so, on one line: "assumed (default): 2 of 3 tasks are requested
/// (priority 1) and stopped; behaviors succeed and fail; none is faulty; all variables change".
[[nodiscard]] std::string describe_assumptions(const CompiledCatalog& catalog,
                                               const StatedAssumptions& stated);

/// The same, broken to the width of tables, or of a terminal that is narrower. `columns`: of the
/// terminal, 0 if there is none.
[[nodiscard]] std::string assumptions_to_text(const CompiledCatalog& catalog,
                                              const StatedAssumptions& stated,
                                              std::size_t columns = 0);

}  // namespace cbc
