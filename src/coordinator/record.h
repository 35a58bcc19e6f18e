#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/explanation.h"
#include "explain/configuration.h"
#include "explain/reason.h"
#include "solver/problem.h"

namespace cbc {

[[nodiscard]] std::string_view name_of(SearchStatus status);

/// One activation or deactivation, in the order applied.
struct Change {
  bool is_activation = false;
  BehaviorId behavior = 0;
  std::uint32_t first_task = 0;  ///< of its tasks, in EventRecord::tasks_of_changes
  std::uint32_t task_count = 0;
  ChangeCause cause = ChangeCause::requested;
  std::optional<std::int32_t> priority;
  bool success = true;
};

struct StoppedTask {
  TaskId task = 0;
  FinishCause cause = FinishCause::interrupted;
};

struct SearchRecord {
  SearchResult result;  ///< of the last search; its counts over all searches of the event
  std::uint32_t group = 0;
  std::int32_t protection = 0;
  bool is_escalated = false;                ///< there was no solution at the first protection level
  std::vector<std::uint32_t> domain_sizes;  ///< their product is the search space
  /// What all searches of the event took, with the making of their problems; empty unless measured.
  std::optional<std::chrono::nanoseconds> elapsed;
};

/// What one event did. Valid until the coordinator handles the next one, whose record takes over
/// the memory.
struct EventRecord {
  std::uint64_t index = 0;  ///< counts all events from 1
  Microseconds time = 0;
  Origin origin = Origin::script;
  Verb verb = Verb::wait;
  TaskId task = none;          ///< of start and stop
  BehaviorId behavior = none;  ///< of finish, fault and repair
  std::int32_t priority = 0;   ///< of start and stop
  FinishCause cause = FinishCause::goal_achieved;

  Outcome outcome = Outcome::unchanged;
  std::vector<Change> changes;
  std::vector<TaskId> tasks_of_changes;
  std::vector<StoppedTask> stopped_tasks;
  std::optional<ObjectiveValues> objective;
  const SearchRecord* search = nullptr;  ///< null: there was none
  std::vector<Reason> conflict;          ///< of a rejected event: a minimal set of reasons
  Explanation explanation;               ///< of an accepted event, what was asked for

  /// The tasks that one of the changes is about.
  [[nodiscard]] std::span<const TaskId> tasks_of(const Change& change) const {
    return std::span(tasks_of_changes).subspan(change.first_task, change.task_count);
  }
};

}  // namespace cbc
