#pragma once

#include <string>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"

namespace cbc {

/// A reason why an event was rejected, in a sentence, with the place in the catalog if it has one.
[[nodiscard]] std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                                          const Reason& reason);

}  // namespace cbc
