#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"

namespace cbc {

/// All that a coordinator, and whoever runs a script with it, knows between two events.
struct Snapshot {
  struct RunningTask {
    TaskId task = 0;
    std::uint32_t place = 0;  ///< of its behavior among its values
    Microseconds since = 0;   ///< when it took the behavior
    std::optional<Request> request;
    bool waits_for_timeout = false;
  };
  Microseconds now = 0;
  std::uint64_t events = 0;  ///< number of the last one
  Microseconds reactive_delay = 0;
  std::optional<Outcome> outcome;  ///< of the last scripted start, stop or finish; see Runner
  std::vector<RunningTask> running;
  std::vector<std::pair<BehaviorId, Microseconds>> active;  ///< with the time of the activation
  std::vector<BehaviorId> unavailable;
  std::vector<BehaviorId> faulty;
  std::vector<std::pair<TaskId, Microseconds>> queue;  ///< with due times
};

/// Why no coordinator can be in this state, or nothing. Tasks, behaviors and places are those of
/// the catalog; everything else may be anything.
[[nodiscard]] std::optional<std::string> find_inconsistency(const CompiledCatalog& catalog,
                                                            const Snapshot& snapshot);

}  // namespace cbc
