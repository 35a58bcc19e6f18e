#pragma once

#include <span>
#include <string>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"

namespace cbc {

/// A set of reasons as the JSON of `cbc solve` has it, on one line.
[[nodiscard]] std::string reasons_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                                          std::span<const Reason> reasons);

}  // namespace cbc
