#pragma once

#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"

namespace cbc {

/// f2 of a state: the product of the suitabilities of all running tasks, to the nearest double.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state);

/// f3: the share of the tasks that are not start_on_request which do not run.
[[nodiscard]] double idle_share(const ObjectiveValues& objective);

[[nodiscard]] double to_seconds(Microseconds time);

}  // namespace cbc
