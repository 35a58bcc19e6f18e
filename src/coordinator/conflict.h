#pragma once

#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/question.h"
#include "coordinator/state.h"
#include "explain/reason.h"

namespace cbc {

/// A minimal set of reasons why a start or stop has no solution: together they leave none, and with
/// any one of them left out there is one. `failed`: behaviors whose activation failed in the event.
/// Empty where the set is beyond reach (a group with very many constraints).
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog, const State& state,
                                                const Trigger& trigger,
                                                std::span<const BehaviorId> failed);

}  // namespace cbc
