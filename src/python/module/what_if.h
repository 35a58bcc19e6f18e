#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "python/module/session.h"
#include "solve/engine/what_if.h"

namespace cbc::python {

/// Something that could happen next, and what would come of it.
struct Option {
  std::vector<HandledEvent> events;  ///< the move itself, and what follows from it at once
  MoveEffects effects;
  std::vector<std::pair<TaskId, BehaviorId>> started;
  std::vector<std::pair<TaskId, BehaviorId>> changed;
  std::vector<std::pair<TaskId, std::int32_t>> requested;
  std::vector<std::pair<TaskId, Microseconds>> queued;
};

/// What could happen next, in the order of `cbc solve --what-if`; the clock comes last. Starts have
/// each of the priorities, which ascend. Means nothing once `is_stopped` has ended it.
[[nodiscard]] std::vector<Option> find_options(const Session& session,
                                               std::span<const std::int32_t> priorities,
                                               const IsStopped& is_stopped);

}  // namespace cbc::python
