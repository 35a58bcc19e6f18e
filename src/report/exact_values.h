#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "solver/problem.h"

namespace cbc {

/// f2 of a state: the product of the suitabilities of all running tasks, to the nearest double.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state);

/// The same with another configuration of one group.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state,
                                       std::uint32_t group, const Assignment& places);

/// The same exactly, as a decimal number. A suitability of 0 outside the group decides nothing, so
/// then that of the group alone.
[[nodiscard]] std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                                            std::uint32_t group, const Assignment& places);

/// f3: the share of the tasks that are not start_on_request which do not run.
[[nodiscard]] double idle_share(const ObjectiveValues& objective);

[[nodiscard]] double to_seconds(Microseconds time);

}  // namespace cbc
