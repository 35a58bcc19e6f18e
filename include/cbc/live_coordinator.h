#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "cbc/event.h"
#include "cbc/loaded_catalog.h"
#include "cbc/units.h"

namespace cbc {

/// Options of a coordinator. A value out of range counts as the nearest one in range.
struct LiveOptions {
  /// From the moment when a reactive task could start until it starts; 1 to longest_time.
  Microseconds reactive_delay = 80'000;
  // Limits of the search for one event. Without limits every answer is proven optimal. A search
  // that a limit stops takes the best answer so far; if there is none yet, a start or stop is
  // rejected, and a finish stops what needs the finished behavior. max_nodes gives the same answers
  // on every run, time_limit does not.
  std::uint64_t max_nodes = 0;  ///< decisions; 0: no limit
  Microseconds time_limit = 0;  ///< 0 to longest_time; 0: no limit
};

/// The result of a call. Unless it is ok, too_many_events or internal_error, the call changed
/// nothing.
enum class [[nodiscard]] LiveStatus : std::uint8_t{
    ok,
    invalid_time,        ///< before now(), or after longest_time
    invalid_verb,        ///< none of the enumerators
    invalid_cause,       ///< of a finish: none of the enumerators
    invalid_priority,    ///< of a start: below 1; of a stop: below 0
    invalid_parameters,  ///< a length without a text
    invalid_situation,   ///< a length without entries
    unknown_task,        ///< the catalog has no task of this index
    unknown_behavior,    ///< the same of a behavior, also in a situation
    unknown_variable,    ///< the catalog has no situation variable of this index
    unknown_value,       ///< the situation variable has no value of this index
    not_requestable,     ///< of a start: nobody may request the task
    /// So many events fell due that the clock did not reach the time of the call, and its event was
    /// not handled: process events(), and repeat the call.
    too_many_events,
    /// An answer did not pass its check, which is a bug in this library; see internal_error().
    /// Every further call returns the same.
    internal_error};

/// "ok", "invalid_time", ….
[[nodiscard]] std::string_view name_of(LiveStatus status);

/// One activation or deactivation of a behavior.
struct BehaviorChange {
  bool is_activation = false;
  std::uint32_t behavior = 0;
  std::span<const std::uint32_t> tasks;  ///< that it performs from now on, or performed until now
  ChangeCause cause = ChangeCause::requested;
  std::optional<std::int32_t> priority;  ///< the highest of the requests of these tasks, if any
  /// False: an activation of a faulty behavior; do not carry it out.
  bool success = true;
};

/// A task that an event stopped.
struct TaskStop {
  std::uint32_t task = 0;
  FinishCause cause = FinishCause::interrupted;
};

/// What one event did. Tasks and behaviors are catalog indices.
struct HandledEvent {
  Microseconds time = 0;
  Origin origin = Origin::script;  ///< script: the program itself
  Verb verb = Verb::wait;
  /// The task of start and stop, the behavior of finish, fault and repair; no_subject if a finish
  /// named a task that nothing performed.
  std::uint32_t subject = 0;
  std::int32_t priority = 0;                       ///< of start and stop
  FinishCause cause = FinishCause::goal_achieved;  ///< of finish
  Outcome outcome = Outcome::unchanged;
  bool is_proven = true;                    ///< no limit stopped a search
  std::span<const BehaviorChange> changes;  ///< carry them out in this order
  std::span<const TaskStop> stopped_tasks;  ///< in catalog order
};

/// Decides which behaviors are active while a robot runs: on every event it finds the best
/// consistent set of behaviors, and reports the changes.
///
/// At first its clock stands at 0, nothing runs, situation variables have their first values, and
/// all behaviors that fit them are available; none is faulty. Send a situation first if this is not
/// so. Then the program
/// - reports what happens with handle(),
/// - calls advance_to() when next_due() has come, as behaviors time out and reactive tasks start,
/// - and after each call carries out the changes of events(), in order.
///
/// A behavior that finished is inactive already, so the changes contain no deactivation of it. This
/// includes a behavior that timed out: it is the subject of an event of origin timeout, and has to
/// be stopped first, and a behavior that a new situation does not fit, of origin situation.
///
/// An activation counts as done as soon as it is decided. If it fails on the robot, report a fault
/// of the behavior, so that it is not tried again, and then its finish with process_failure.
///
/// Time comes from a clock of the program, in microseconds since it created the coordinator. It
/// never goes back, and does not advance between calls.
///
/// Different coordinators are independent, and may be used in different threads. Calls of one
/// coordinator, const ones included, must not overlap. The only exception thrown is std::bad_alloc;
/// the coordinator must not be used after it. Once the buffers have grown to what the largest event
/// needs, events allocate nothing.
class LiveCoordinator {
 public:
  /// The most events of the clock that one call handles; the next call continues with the rest.
  static constexpr std::size_t most_events = 10'000;

  /// Keeps the catalog in memory.
  explicit LiveCoordinator(const LoadedCatalog& catalog, const LiveOptions& options = {});
  LiveCoordinator(const LiveCoordinator&) = delete;
  LiveCoordinator& operator=(const LiveCoordinator&) = delete;
  ~LiveCoordinator();

  /// Moves the clock to `time`, handles what falls due before it, and then the event. Keeps no
  /// reference to anything in the event.
  LiveStatus handle(Microseconds time, const Event& event);

  /// Moves the clock to `time`, and handles what falls due until then, also at `time` itself.
  LiveStatus advance_to(Microseconds time);

  /// What the last call of handle or advance_to did, in order. Valid until the next such call.
  [[nodiscard]] std::span<const HandledEvent> events() const;

  [[nodiscard]] Microseconds now() const;
  /// When something falls due next, unless an event changes that. It may turn out to be a no-op.
  /// None: nothing is due.
  [[nodiscard]] std::optional<Microseconds> next_due() const;
  /// The behavior that performs a task; none if the task does not run, or there is no such task.
  [[nodiscard]] std::optional<std::uint32_t> behavior_of(std::uint32_t task) const;
  /// The present value of a situation variable; none if there is no such variable.
  [[nodiscard]] std::optional<std::uint32_t> value_of(std::uint32_t variable) const;
  /// What to report to the authors of this library; empty if there was no internal error.
  [[nodiscard]] std::string_view internal_error() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cbc
