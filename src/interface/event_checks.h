#pragma once

#include "cbc/event.h"
#include "cbc/live_coordinator.h"
#include "compiled/compiled_catalog.h"

namespace cbc {

/// What is wrong with an event that may hold anything; ok if nothing is. Only what its verb uses is
/// looked at.
LiveStatus check_event(const CompiledCatalog& catalog, const Event& event);

}  // namespace cbc
