#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "explain/reason.h"
#include "solver/problem.h"

namespace cbc {

/// Why a behavior was activated or deactivated.
enum class ChangeCause : std::uint8_t {
  requested,  ///< its task has a request of priority >= 1, or is the one of a stop event
  reactive,   ///< its task has a request of priority 0
  required,   ///< its task has no request
  replaced,   ///< its task goes on with another behavior
  displaced,  ///< its task had a request
  released,   ///< its task had none
  restarted,  ///< to take over changed parameters
  undone      ///< takes back an earlier change of the same event
};

[[nodiscard]] std::string_view name_of(ChangeCause cause);
[[nodiscard]] std::string_view name_of(SearchStatus status);

/// One activation or deactivation, in the order applied.
struct Change {
  bool is_activation = false;
  BehaviorId behavior = 0;
  std::vector<TaskId> tasks;
  ChangeCause cause = ChangeCause::requested;
  std::optional<std::int32_t> priority;
  bool success = true;
};

struct StoppedTask {
  TaskId task = 0;
  FinishCause cause = FinishCause::interrupted;
};

/// The objectives of an accepted solution, over the whole catalog. f2 is a property of the state.
struct ObjectiveValues {
  std::uint32_t satisfied = 0;     ///< r of f1
  std::uint32_t requests = 0;      ///< n of f1
  std::uint32_t idle_total = 0;    ///< t of f3
  std::uint32_t idle_running = 0;  ///< a of f3
  std::uint32_t changes = 0;       ///< c of f4
};

struct SearchRecord {
  SearchResult result;  ///< of the last search; its counts over all searches of the event
  std::uint32_t group = 0;
  std::int32_t protection = 0;
  std::vector<std::uint32_t> domain_sizes;  ///< their product is the search space
};

/// What one event did. Valid until the coordinator handles the next one.
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
  std::vector<StoppedTask> stopped_tasks;
  std::optional<ObjectiveValues> objective;
  std::optional<SearchRecord> search;
  std::vector<Reason> conflict;  ///< of a rejected event: a minimal set of reasons
};

}  // namespace cbc
