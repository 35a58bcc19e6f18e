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

/// How a coordinator works. Values out of range count as the nearest one in it.
struct LiveOptions {
  /// Time from the moment a reactive task can start until it does; 1 to longest_time.
  Microseconds reactive_delay = 80'000;
  // Limits of one search; an event may need several. Without limits every answer is proven best. A
  // search that a limit stops takes its best answer so far; if there is none yet, the event is
  // rejected. Answers are reproducible under max_nodes, but not under time_limit.
  std::uint64_t max_nodes = 0;  ///< decisions; 0: no limit
  Microseconds time_limit = 0;  ///< 0 to longest_time; 0: no limit
};

/// The result of a call. A call changed nothing unless it is ok, too_many_events or internal_error.
enum class [[nodiscard]] LiveStatus : std::uint8_t{
    ok,
    invalid_time,        ///< before now(), or after longest_time
    invalid_verb,        ///< none of the enumerators
    invalid_cause,       ///< of a finish: none of the enumerators
    invalid_priority,    ///< of a start: below 1; of a stop: below 0
    invalid_parameters,  ///< a length without a text
    invalid_situation,   ///< a length without entries
    unknown_task,        ///< the catalog has no such place
    unknown_behavior,    ///< the same; also of an entry of a situation
    /// So much fell due that the clock did not reach the requested time, and the event was not
    /// handled: carry out events(), and repeat the call.
    too_many_events,
    /// An answer did not pass its check, which is a bug of this library; see internal_error().
    /// Every further call returns the same.
    internal_error};

/// "ok", "invalid_time", ….
[[nodiscard]] std::string_view name_of(LiveStatus status);

/// One activation or deactivation of a behavior.
struct BehaviorChange {
  bool is_activation = false;
  std::uint32_t behavior = 0;
  std::span<const std::uint32_t> tasks;  ///< that it performs from now on, or performed
  ChangeCause cause = ChangeCause::requested;
  std::optional<std::int32_t> priority;  ///< the highest of the requests of these tasks, if any
  /// False for an activation of a behavior that has a fault; do not carry it out.
  bool success = true;
};

/// A task that an event stopped.
struct TaskStop {
  std::uint32_t task = 0;
  FinishCause cause = FinishCause::interrupted;
};

/// What one event did. Tasks and behaviors are places in the catalog.
struct HandledEvent {
  Microseconds time = 0;
  Origin origin = Origin::script;  ///< script: the program itself
  Verb verb = Verb::wait;
  std::uint32_t subject = 0;  ///< the task of start and stop, the behavior of finish, fault, repair
  std::int32_t priority = 0;  ///< of start and stop
  FinishCause cause = FinishCause::goal_achieved;  ///< of finish
  Outcome outcome = Outcome::unchanged;
  bool is_proven = true;                    ///< no limit stopped a search
  std::span<const BehaviorChange> changes;  ///< to be carried out in this order
  std::span<const TaskStop> stopped_tasks;  ///< in catalog order
};

/// Decides which behaviors are active while a robot runs: on every event it finds the best
/// consistent set of them, and says what has to change.
///
/// At first its clock stands at 0, nothing runs, and all behaviors are available and without fault;
/// a situation as the first event says otherwise. Then the program
/// - reports what happens with handle(),
/// - calls advance_to() when next_due() has come, as behaviors time out and reactive tasks start,
/// - and after each call carries out the changes of events(), in order.
///
/// A behavior that finished is over, and no deactivation of it is among the changes. That holds for
/// one that timed out, too: it is the subject of the event, whose origin is timeout, and is to be
/// stopped first. (If a search limit lets a finish be rejected, its behavior goes on.)
///
/// An activation counts as done as soon as it is decided. If it fails on the robot, report a fault
/// of the behavior, so that it is not tried again, and then its finish with process_failure.
///
/// Time is that of a clock of the program, in microseconds since it made the coordinator. It never
/// goes back, and stands still between calls.
///
/// Different coordinators are independent, and may be in different threads; one of them takes one
/// call at a time, const ones included. Nothing is thrown but std::bad_alloc, when memory runs out;
/// the coordinator must not be used after that. Buffers grow to what the largest event needs; from
/// then on, events do not allocate.
class LiveCoordinator {
 public:
  /// A call that has reported this many events leaves the others for the next one.
  static constexpr std::size_t most_events = 10'000;

  /// Keeps the catalog in memory.
  explicit LiveCoordinator(const LoadedCatalog& catalog, const LiveOptions& options = {});
  LiveCoordinator(const LiveCoordinator&) = delete;
  LiveCoordinator& operator=(const LiveCoordinator&) = delete;
  ~LiveCoordinator();

  /// Moves the clock to `time`, through all that falls due before it, and handles the event there.
  /// What the event refers to is not used after the call.
  LiveStatus handle(Microseconds time, const Event& event);

  /// Moves the clock to `time`, through all that falls due until then, `time` included.
  LiveStatus advance_to(Microseconds time);

  /// What the last call of handle() or advance_to() did, in order. Valid until the next call.
  [[nodiscard]] std::span<const HandledEvent> events() const;

  [[nodiscard]] Microseconds now() const;
  /// When a timeout or a reactive start is due next, if nothing happens before; it may turn out to
  /// be a no-op. None: nothing is due.
  [[nodiscard]] std::optional<Microseconds> next_due() const;
  /// The behavior that performs a task; none if the task does not run, or there is no such place.
  [[nodiscard]] std::optional<std::uint32_t> behavior_of(std::uint32_t task) const;
  /// What a bug report to the authors of this library should quote; empty if there is nothing.
  [[nodiscard]] std::string_view internal_error() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cbc
