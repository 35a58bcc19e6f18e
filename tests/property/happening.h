#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// What one event of a coordinator did to some groups, as far as a robot or a comparison of two
// catalogs can see it.

namespace cbc::plain {

/// Running tasks with their behaviors, the sets of the queue in order of due time, and the waiting
/// tasks; each list in ascending order.
struct VisibleState {
  std::vector<std::pair<TaskId, BehaviorId>> running;
  std::vector<std::vector<TaskId>> queue;
  std::vector<TaskId> waiting;

  bool operator==(const VisibleState&) const = default;
};

struct Happening {
  struct Change {
    BehaviorId behavior = none;
    bool is_activation = false;
    bool success = true;

    bool operator==(const Change&) const = default;
  };
  Verb verb = Verb::wait;
  Origin origin = Origin::script;
  TaskId task = none;          ///< of start and stop
  BehaviorId behavior = none;  ///< of finish, fault and repair
  Outcome outcome = Outcome::unchanged;
  std::vector<Change> changes;                          ///< in the order applied
  std::vector<std::pair<TaskId, FinishCause>> stopped;  ///< in ascending order
  VisibleState after;

  bool operator==(const Happening&) const = default;
};

/// Of these tasks only.
[[nodiscard]] VisibleState visible_part(const CompiledCatalog& catalog, const State& state,
                                        std::vector<TaskId> tasks);
/// `record` and `state` are those after the event.
[[nodiscard]] Happening happening_of(const CompiledCatalog& catalog, const EventRecord& record,
                                     const State& state, const std::vector<TaskId>& tasks);

/// For reports: one line.
[[nodiscard]] std::string text_of(const CompiledCatalog& catalog, const Happening& happening);

}  // namespace cbc::plain
