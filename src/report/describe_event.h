#pragma once

#include <string>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "script/script.h"

namespace cbc {

/// Seconds, to the millisecond, or to the microsecond where it takes that.
[[nodiscard]] std::string format_time(Microseconds time);

/// What happened: "start HOVER, priority 2". `step` is the scripted one, or null.
[[nodiscard]] std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                                         const Step* step);

/// " GPS unavailable, RADAR available"
[[nodiscard]] std::string describe_situation(const CompiledCatalog& catalog,
                                             const std::vector<Availability>& situation);

/// "outcome accepted, HOVER runs with HOVER_WITH_MPC, LAND does not run"
[[nodiscard]] std::string describe_expectation(const CompiledCatalog& catalog,
                                               const Expectation& expectation);

}  // namespace cbc
