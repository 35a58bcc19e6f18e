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
  /// From when a reactive task could start until it does; 1 to longest_time.
  Microseconds reactive_delay = 80'000;
  // Limits of one search, of which an event may take several. Without limits every answer is proven
  // best. What a limit stops takes the best answer so far; if there is none yet, the event is
  // rejected. Answers repeat under max_nodes, but not under time_limit.
  std::uint64_t max_nodes = 0;  ///< decisions; 0: no limit
  Microseconds time_limit = 0;  ///< 0 to longest_time; 0: no limit
};

/// What became of a call. But for ok, too_many_events and internal_error, it changed nothing.
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
    /// So much fell due that the clock has not come to the instant asked for, and the event was not
    /// handled: take care of events(), and repeat the call.
    too_many_events,
    /// An answer did not pass its check, which is a mistake in this library; see internal_error().
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
  /// False: an activation of a behavior that has a fault, which is not to be carried out.
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
/// An activation counts as done as soon as it is decided. If it fails in the world, report a fault
/// of the behavior, so that it is not tried again, and then its finish with process_failure.
///
/// Time is counted on a clock of the program, in microseconds since it made the coordinator. It
/// never goes back, and stands still between calls.
///
/// Different coordinators are independent, and may be in different threads; one of them takes one
/// call at a time, const ones included. Nothing is thrown, but for std::bad_alloc where memory is
/// at an end; the coordinator must not be used after that. Buffers grow to what the greatest event
/// needs; then events allocate nothing.
class LiveCoordinator {
 public:
  /// A call after which this many events have been reported leaves the others for the next one.
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

  /// What the last call of the two brought about, in order. Valid until the next one.
  [[nodiscard]] std::span<const HandledEvent> events() const;

  [[nodiscard]] Microseconds now() const;
  /// When the clock brings about something next, if nothing happens before; it may turn out to be
  /// nothing. None: nothing is due ever.
  [[nodiscard]] std::optional<Microseconds> next_due() const;
  /// The behavior that performs a task; none if the task does not run, or there is no such place.
  [[nodiscard]] std::optional<std::uint32_t> behavior_of(std::uint32_t task) const;
  /// What to tell the authors of this library; empty if there is nothing.
  [[nodiscard]] std::string_view internal_error() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cbc
