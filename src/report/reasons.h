#pragma once

#include <string>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"

namespace cbc {

/// Why an event was rejected before any search. Needs record.priority_conflict.
[[nodiscard]] std::string describe_priority_conflict(const CompiledCatalog& catalog,
                                                     const EventRecord& record);

}  // namespace cbc
