#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/question.h"
#include "coordinator/state.h"
#include "explain/demand.h"
#include "explain/reason.h"

namespace cbc {

/// An event and what was found out about it.
struct Circumstances {
  const State& state;  ///< before the event
  const Trigger& trigger;
  std::int32_t protection = 0;         ///< the level that was tried last
  std::span<const BehaviorId> failed;  ///< may not be chosen any more in this event
};

/// A minimal set of reasons why the event allows for none of the `ways`: together they leave no
/// solution, and with any one of them left out there is one. Empty if the event alone leaves none,
/// nothing where the set is beyond reach (a group with very many constraints).
[[nodiscard]] std::optional<std::vector<Reason>> find_reasons(const CompiledCatalog& catalog,
                                                              const Circumstances& circumstances,
                                                              std::span<const Demands> ways);

/// The same for a start or stop that has no solution at all. Empty where the set is beyond reach.
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                                const Circumstances& circumstances);

}  // namespace cbc
