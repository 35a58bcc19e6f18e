#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/may_need.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/coordinator/transition.h"
#include "runtime/solver/checker.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/solver.h"

namespace cbc {

struct CoordinatorOptions {
  SearchOptions search;
  Microseconds reactive_delay = 80'000;        ///< over 0; see docs/semantics.md, "Reactive tasks"
  bool timeouts = true;                        ///< false: the clock ends no behavior
  std::uint64_t max_clock_events = 1'000'000;  ///< timeouts and reactive starts, no-ops too
  bool measure_time = false;                   ///< records the time of searches
  /// Asked before the clock moves on; true ends a call with Coordinator::Status::stopped.
  std::function<bool()> is_stopped;
};

/// Receives the record of every event, in order.
class EventListener {
 public:
  virtual ~EventListener() = default;
  virtual void on_event(const EventRecord& record) = 0;
  /// A problem was searched. An event that escalates, or in which a behavior fails, has several.
  /// `solution`: null if none was found. Both are valid until the next search.
  virtual void on_search(const Problem& /*problem*/, const Assignment* /*solution*/) {}
  /// An answer was found, or that there is none (null), of which on_event will tell.
  virtual void on_decision(const EventRecord& /*record*/, const Circumstances& /*circumstances*/,
                           const Assignment* /*solution*/) {}
};

/// Finds and applies the best consistent set of active behaviors on every event.
///
/// Time never goes back. After too_many_clock_events some events are still due; after
/// restart_count() the next call goes on with them. After stopped, all that is due at the present
/// instant is done, and the next call goes on. After refused_answer the coordinator must not
/// be used any more.
///
/// Once the buffers have grown to what the events need, an event allocates nothing.
class Coordinator {
 public:
  enum class [[nodiscard]] Status : std::uint8_t{
      ok, too_many_clock_events, stopped,
      refused_answer  ///< the checker refused an answer of the solver; see internal_error()
  };

  /// `catalog` and `listener` must outlive the coordinator.
  Coordinator(const CompiledCatalog& catalog, const CoordinatorOptions& options,
              EventListener& listener);
  Coordinator(const Coordinator&) = delete;
  Coordinator& operator=(const Coordinator&) = delete;

  /// To be called before the first event: sets the situation and queues the reactive tasks.
  void begin(std::span<const Availability> situation,
             std::span<const VariableValue> variables = {});

  /// Instead of begin, or at any time later: continues from the state of another coordinator, which
  /// find_inconsistency accepts. The reactive delay, and whether there are timeouts, are those of
  /// the options; they should be those of the snapshot.
  void resume(const Snapshot& snapshot);
  /// All that another coordinator needs to continue, without the outcome. Not after
  /// refused_answer.
  [[nodiscard]] Snapshot snapshot() const;

  /// Moves the clock to `time` (not before now) after processing everything that falls due earlier.
  Status advance_to(Microseconds time);
  /// Processes what is due at the present instant.
  Status settle();
  /// Handles one event at the present instant. Subjects are catalog indices. If it returns
  /// too_many_clock_events, the event itself is done.
  Status handle(const Event& event);
  /// Allows max_clock_events from here on.
  void restart_count() { clock_events_ = 0; }

  [[nodiscard]] Microseconds now() const { return now_; }
  /// When something falls due next. It may be a no-op.
  [[nodiscard]] std::optional<Microseconds> next_due() const;
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const std::string& internal_error() const { return internal_error_; }

 private:
  Status process_next_due();
  Status time_out(TaskId task);
  Status start_reactive(TaskId task);
  Status finish_pending();
  [[nodiscard]] bool may_start(TaskId task) const;
  [[nodiscard]] bool is_blocked(TaskId task) const;

  void open_record(Origin origin, Verb verb);
  Status report();

  Status take(const Event& event);
  Status start(TaskId task, std::int32_t priority, std::optional<std::string_view> parameters,
               bool is_reactive);
  Status stop(TaskId task, std::optional<std::int32_t> priority);
  Status reject_by_priority(const Trigger& trigger);
  Status finish(BehaviorId behavior, FinishCause cause);
  Status change_situation(const Event& event);
  void find_affected(const Event& event);
  void repair(BehaviorId behavior);
  void make_possible(BehaviorId behavior);
  Status reconsider(GroupId group);
  [[nodiscard]] bool may_improve(TaskId task) const;
  [[nodiscard]] bool improves(GroupId group) const;

  void note_failure(BehaviorId behavior);
  void forgive(TaskId task);
  void end_forgiving();
  [[nodiscard]] bool excludes(TaskId a, TaskId b) const;

  Status coordinate(const Trigger& trigger);
  [[nodiscard]] const Problem* search(const Trigger& trigger);
  [[nodiscard]] const Problem& keep_present(std::int32_t protection);
  [[nodiscard]] const Problem* timed_search(const Trigger& trigger);
  [[nodiscard]] std::string describe_refusal(const std::string& violation) const;
  void note_domain_sizes(const Problem& problem);
  [[nodiscard]] BehaviorId behavior_to_restart(const Trigger& trigger) const;
  void accept(const Trigger& trigger, const Problem& problem);
  [[nodiscard]] Circumstances circumstances_of(const Trigger& trigger,
                                               const Problem* problem) const;
  Status reject(const Trigger& trigger);
  bool note_waiting(const Trigger& trigger);
  [[nodiscard]] bool was_active(BehaviorId behavior) const;
  void assign(const Trigger& trigger);
  [[nodiscard]] bool is_suspended_by(const Trigger& trigger, TaskId task) const;
  void update_timeouts(GroupId group);
  void update_queue();
  void retry_waiting(GroupId group);
  void enqueue_if_reactive(TaskId task);
  void enqueue_rivals(TaskId task);
  void dequeue_with_rivals(TaskId task);
  template <typename Visit>
  void for_each_rival(TaskId task, const Visit& visit);
  void enqueue_group(GroupId group);

  const CompiledCatalog& catalog_;
  const CoordinatorOptions options_;
  EventListener& listener_;
  State state_;
  EventRecord record_;
  SearchRecord search_;
  ProblemBuilder problem_builder_;
  Transition transition_;
  Solver solver_;
  Checker checker_;
  AskedProduct asked_;
  MayNeed needs_;
  MayNeed needs_of_others_;
  Assignment solution_;
  std::vector<TaskId> started_;
  std::vector<TaskId> stopped_by_others_;  ///< not by their own stop or end: see update_queue
  /// The behaviors that a situation may affect, and whether they were available before it.
  std::vector<std::pair<BehaviorId, bool>> affected_;
  std::vector<BehaviorId> lost_;  ///< of a failed rollback; the last one finishes next
  /// Active behaviors that may no longer fit, by catalog index; the last one is checked next.
  std::vector<std::uint32_t> misfits_;
  /// Out of X for the present event, and when they failed.
  std::vector<std::pair<BehaviorId, Microseconds>> forgiven_;
  /// Groups in which more has become possible, descending.
  std::vector<GroupId> to_reconsider_;
  Origin cause_of_reconsidering_ = Origin::situation;
  Microseconds now_ = 0;
  std::uint64_t clock_events_ = 0;
  std::string internal_error_;
};

}  // namespace cbc
