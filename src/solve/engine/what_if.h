#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// What could happen next in a state, and what would come of each of these moves.

namespace cbc {

/// An event that outlives its coordinator.
struct KeptEvent {
  ExplainedRecord record;
  std::unique_ptr<const SearchRecord> search;  ///< that of the record, if it has one
  const Step* step = nullptr;                  ///< the scripted one, or null

  KeptEvent(const ExplainedRecord& of, const Step* its_step);
};

/// Whether an event of origin `fault`, `situation` or `repair` belongs to the one before it:
/// nothing can happen between them.
[[nodiscard]] inline bool follows_at_once(const EventRecord& record) {
  return record.origin == Origin::fault || record.origin == Origin::situation ||
         record.origin == Origin::repair;
}

/// A state of a mission, between two events.
struct MissionMoment {
  Snapshot snapshot;
  std::optional<KeptEvent> event;  ///< the last one; empty before the first
};

struct MomentSearch {
  /// Empty: there is no such event, or the run ended before it.
  std::optional<MissionMoment> moment;
  RunResult result;  ///< of the run up to the moment, or to its end
};

/// Runs a mission until the event with this number is done (0: before the first one), or to its
/// end. The events that follow from it at once are a part of it. The script must outlive the
/// answer.
[[nodiscard]] MomentSearch find_moment(const CompiledCatalog& catalog, const Script& script,
                                       const CoordinatorOptions& options,
                                       std::optional<std::uint64_t> event);

/// What may be asked for in any state.
struct MoveChoice {
  std::vector<std::uint32_t> tasks;      ///< that may be started, by catalog index, ascending
  std::vector<std::int32_t> priorities;  ///< of their starts, from 1, ascending
  std::vector<std::uint32_t> behaviors;  ///< of which a script may say whether they are available
};

/// The requestable tasks with start_on_request and those that the mission starts; the priorities of
/// its starts, or 1; and the behaviors in its situations.
[[nodiscard]] MoveChoice choice_of(const CompiledCatalog& catalog, const Script& script);

/// All moves in a state that do not come from the clock, as steps without a time, in this order:
/// starts, by task and then by priority; stops of tasks that run or whose request is suspended;
/// finishes of active behaviors,
/// first with goal_achieved where all tasks that they perform now have goals to achieve, then with
/// process_failure, then with situation_change where the situation denies them; faults of active
/// behaviors; repairs of those that are faulty or have failed; changes of one value of the
/// situation.
[[nodiscard]] std::vector<Step> list_moves(const CompiledCatalog& catalog, const State& state,
                                           const MoveChoice& choice);

/// What a move would do.
struct PossibleMove {
  struct Event : KeptEvent {
    State after;

    Event(const ExplainedRecord& of, const Step* its_step, State its_after)
        : KeptEvent(of, its_step), after(std::move(its_after)) {}
  };

  const State& before;
  /// The move itself, and what follows from it at once; at least one.
  std::span<const Event> events;

  [[nodiscard]] const State& after() const { return events.back().after; }
};

/// What is different after a move, in catalog order.
struct MoveEffects {
  std::vector<TaskId> started;          ///< run after it, but not before
  std::vector<TaskId> stopped;          ///< ran before it, but not after
  std::vector<TaskId> changed;          ///< run before and after it, with different behaviors
  std::vector<TaskId> requested;        ///< go on with a request of another priority
  std::vector<BehaviorId> failed;       ///< whose activation was tried, as they are faulty
  std::vector<TaskId> ended;            ///< whose request was suspended, and ends
  std::vector<BehaviorId> forgiven;     ///< which had failed, and are tried again
  std::vector<TaskId> suspended;        ///< whose request is suspended
  std::vector<BehaviorId> not_retried;  ///< which are not tried again at any event
  std::vector<TaskId> queued;           ///< reactive tasks that have come into the queue
};

[[nodiscard]] MoveEffects effects_of(const CompiledCatalog& catalog, const PossibleMove& move);

/// Valid until the function returns.
using TakeMove = std::function<void(const PossibleMove&)>;

/// Tries each of the steps in the state, and then what the clock does next if nothing else happens:
/// all events of the first instant at which there is one. The options are those of the mission.
[[nodiscard]] RunResult try_moves(const CompiledCatalog& catalog, const CoordinatorOptions& options,
                                  const Snapshot& snapshot, std::span<const Step> steps,
                                  const TakeMove& take);

}  // namespace cbc
