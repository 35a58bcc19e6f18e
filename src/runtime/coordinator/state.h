#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// At most one due time for each of a fixed number of items; the earliest comes first, of equal
/// ones the item of the lowest rank. An indexed binary heap, which allocates nothing after
/// construction.
class Timers {
 public:
  using Item = std::uint32_t;

  /// `ranks`: by item; empty: the items themselves are the ranks.
  explicit Timers(std::size_t items, std::vector<std::uint32_t> ranks = {});

  void set(Item item, Microseconds due);
  void remove(Item item);
  void clear();

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] bool has(Item item) const { return position_[item] != absent; }
  [[nodiscard]] Item first() const { return heap_.front().second; }
  [[nodiscard]] Microseconds first_due() const { return heap_.front().first; }
  /// Needs has(item).
  [[nodiscard]] Microseconds due(Item item) const { return heap_[position_[item]].first; }
  /// All entries, in no particular order.
  [[nodiscard]] const std::vector<std::pair<Microseconds, Item>>& entries() const { return heap_; }

 private:
  static constexpr std::uint32_t absent = UINT32_MAX;

  using Entry = std::pair<Microseconds, Item>;

  [[nodiscard]] bool is_before(const Entry& a, const Entry& b) const {
    if (ranks_.empty() || a.first != b.first) return a < b;
    return ranks_[a.second] < ranks_[b.second];
  }
  void put(std::uint32_t position, const Entry& entry);
  void sift_up(std::uint32_t position);
  void sift_down(std::uint32_t position);

  std::vector<std::pair<Microseconds, Item>> heap_;
  std::vector<std::uint32_t> position_;  ///< by item: where it is in the heap
  std::vector<std::uint32_t> ranks_;
};

/// The request of a running task, or of one that it waits for.
struct Request {
  std::int32_t priority = 0;
  std::uint64_t event = 0;  ///< number of the event that set it: a later one is more recent
  std::string parameters;   ///< canonical form
  std::optional<Microseconds> time = std::nullopt;  ///< of the event; unknown in a restored state
};

struct Snapshot;

/// How long the task may run with the behavior; 0: without limit.
[[nodiscard]] Microseconds timeout_of(const CompiledCatalog& catalog, TaskId task,
                                      BehaviorId behavior);

/// State of a coordinator (docs/semantics.md, "State"): what runs, what was requested, what can be
/// activated, and what falls due.
class State {
 public:
  explicit State(const CompiledCatalog& catalog);

  /// Takes over a state that find_inconsistency accepts.
  void restore(const Snapshot& snapshot);

  // Values of the tasks.

  [[nodiscard]] bool is_running(TaskId task) const { return assignment_[task] != none; }
  /// The value index of the task's behavior, or none.
  [[nodiscard]] std::uint32_t value_index(TaskId task) const { return assignment_[task]; }
  [[nodiscard]] BehaviorId behavior(TaskId task) const {
    return is_running(task) ? catalog_.values[task][assignment_[task]].behavior : none;
  }
  /// Running tasks as catalog indices, ascending. Takes time proportional to the catalog.
  [[nodiscard]] std::vector<std::uint32_t> running() const;
  /// Idle tasks are those that can start without a request; f3 counts them.
  [[nodiscard]] std::uint32_t idle_running() const { return idle_running_; }
  [[nodiscard]] std::uint32_t idle_total() const { return idle_total_; }

  /// When a running task took its behavior.
  [[nodiscard]] Microseconds taken_at(TaskId task) const { return taken_at_[task]; }
  /// Gives the task a value (a value index, or none). The request of a task that stops ends, or is
  /// suspended; that of a task that runs again is active again.
  void set_value(TaskId task, std::uint32_t index, Microseconds now, bool suspends = false);

  // Requests: active ones, of running tasks, and suspended ones, of tasks that do not run.

  [[nodiscard]] bool has_request(TaskId task) const {
    return request_states_[task] == RequestState::active;
  }
  [[nodiscard]] bool is_suspended(TaskId task) const {
    return request_states_[task] == RequestState::suspended;
  }
  [[nodiscard]] const Request& request(TaskId task) const { return requests_[task]; }
  /// The active request of a task, or null.
  [[nodiscard]] const Request* find_request(TaskId task) const {
    return has_request(task) ? &requests_[task] : nullptr;
  }
  /// The request of a task, active or suspended, or null.
  [[nodiscard]] const Request* find_own_request(TaskId task) const {
    return request_states_[task] == RequestState::absent ? nullptr : &requests_[task];
  }
  /// The number of active requests that f1 counts: those of priority 1 or more.
  [[nodiscard]] std::uint32_t request_count() const { return request_count_; }
  [[nodiscard]] bool is_counted(TaskId task) const {
    return has_request(task) && requests_[task].priority >= 1;
  }
  [[nodiscard]] std::uint32_t suspended_count() const { return suspended_count_; }
  /// The task must be running.
  void set_request(TaskId task, std::int32_t priority, std::uint64_t event,
                   std::string_view parameters, std::optional<Microseconds> time);
  /// Suspends a request of a task that does not run.
  void suspend_request(TaskId task, const Request& request);
  /// Ends a suspended request.
  void end_suspended_request(TaskId task);

  // Behaviors.

  /// Whether the behavior can be activated: a script has not denied it, the behavior fits, and it
  /// has not failed, to be tried again only later.
  [[nodiscard]] bool is_available(BehaviorId behavior) const {
    return !is_denied(behavior) && fits(behavior) && !has_failed(behavior);
  }
  /// Whether the behavior is in X: it has failed, and is not tried again (docs/semantics.md,
  /// "Remembered failures").
  [[nodiscard]] bool has_failed(BehaviorId behavior) const { return failed_[behavior] != 0; }
  /// When a behavior that is in X failed.
  [[nodiscard]] Microseconds failed_at(BehaviorId behavior) const { return failed_at_[behavior]; }
  void set_failed(BehaviorId behavior, Microseconds time);
  void clear_failed(BehaviorId behavior);
  /// The number of behaviors in X.
  [[nodiscard]] std::uint32_t failed_count() const { return failed_count_; }
  /// A script said that the behavior cannot be activated.
  [[nodiscard]] bool is_denied(BehaviorId behavior) const { return denied_[behavior] != 0; }
  void set_denied(BehaviorId behavior, bool denied);
  /// Whether each variable that the behavior names has a value that it names.
  [[nodiscard]] bool fits(BehaviorId behavior) const { return misfits_[behavior] == 0; }
  [[nodiscard]] bool has_available_behavior(TaskId task) const;
  /// The available values of all tasks, as domain words.
  [[nodiscard]] const std::vector<std::uint64_t>& available_words() const {
    return available_words_;
  }

  // The situation.

  /// Denies or permits the behaviors, and gives the variables their values. Everything is given by
  /// catalog index; what is not named stays as it is.
  void change_situation(std::span<const Availability> availability,
                        std::span<const VariableValue> variables);
  [[nodiscard]] std::uint32_t value_of(std::uint32_t variable) const { return values_[variable]; }
  [[nodiscard]] const std::vector<std::uint32_t>& variables() const { return values_; }
  void set_variable(VariableValue value);
  /// All values of a variable that behaviors name, by behavior.
  [[nodiscard]] const std::vector<FittingValue>& fitting(std::uint32_t variable) const {
    return fitting_[variable];
  }

  // Faults and activity.

  [[nodiscard]] bool is_faulty(BehaviorId behavior) const { return faulty_[behavior] != 0; }
  void set_faulty(BehaviorId behavior, bool faulty) { faulty_[behavior] = faulty ? 1 : 0; }
  [[nodiscard]] bool is_active(BehaviorId behavior) const { return active_[behavior] != 0; }
  /// When an active behavior was activated.
  [[nodiscard]] Microseconds activated_at(BehaviorId behavior) const {
    return activated_at_[behavior];
  }
  void set_inactive(BehaviorId behavior) { active_[behavior] = 0; }
  void set_active(BehaviorId behavior, Microseconds now);
  /// Counts the behavior as active although its activation failed.
  void leave_active(BehaviorId behavior) { active_[behavior] = 1; }

  // What falls due. Items are catalog indices.

  /// When the present behavior of each task times out.
  [[nodiscard]] const Timers& timeouts() const { return timeouts_; }
  void update_timeout(TaskId task, Microseconds now);
  /// The timeout was handled. The next one is due after another activation of the behavior.
  void drop_timeout(TaskId task) { timeouts_.remove(catalog_.tasks[task].catalog_index); }
  /// The queue of reactive tasks.
  [[nodiscard]] const Timers& queue() const { return queue_; }
  void enqueue(TaskId task, Microseconds due);
  void dequeue(TaskId task) { queue_.remove(catalog_.tasks[task].catalog_index); }
  /// Whether the task waits for a change of its group, as its reactive start had no solution.
  [[nodiscard]] bool is_waiting(TaskId task) const { return waiting_[task] != 0; }
  void set_waiting(TaskId task, bool waiting);
  [[nodiscard]] std::uint32_t waiting_count() const { return waiting_count_; }

  /// Whether exclusivity lists leave no place for a task that does not run. Of the running tasks
  /// those count that have a request of priority `least` or more; where it is 0, all.
  [[nodiscard]] bool is_blocked(TaskId task, std::int32_t least) const;
  /// The same, by the lists with `rival` alone, which counts.
  [[nodiscard]] bool is_blocked_by(TaskId task, std::int32_t least, TaskId rival) const;

 private:
  enum class RequestState : std::uint8_t { absent, active, suspended };

  void set_request_state(TaskId task, RequestState state);
  [[nodiscard]] bool counts_for(TaskId task, std::int32_t least) const {
    return is_running(task) &&
           (least == 0 || (has_request(task) && requests_[task].priority >= least));
  }
  [[nodiscard]] bool is_full(std::span<const TaskId> list, std::uint32_t most, TaskId task,
                             std::int32_t least) const;
  void clear();
  void update_available(BehaviorId behavior);

  const CompiledCatalog& catalog_;
  std::vector<std::uint32_t> assignment_;     ///< by task
  std::vector<Microseconds> taken_at_;        ///< by task: when it took its behavior
  std::vector<RequestState> request_states_;  ///< by task
  std::vector<Request> requests_;             ///< by task
  std::vector<std::uint64_t> running_;        ///< bit set of catalog indices
  std::uint32_t idle_running_ = 0;
  std::uint32_t idle_total_ = 0;
  std::uint32_t request_count_ = 0;
  std::uint32_t suspended_count_ = 0;
  std::vector<std::uint8_t> denied_;  ///< by behavior
  std::vector<std::uint8_t> failed_;  ///< by behavior
  std::uint32_t failed_count_ = 0;
  std::vector<Microseconds> failed_at_;  ///< by behavior, where it is in X
  std::vector<std::uint32_t> misfits_;   ///< by behavior: the variables that have no fitting value
  std::vector<std::uint64_t> available_words_;
  std::vector<std::uint32_t> values_;               ///< by variable
  std::vector<std::vector<FittingValue>> fitting_;  ///< by variable
  std::vector<std::uint8_t> faulty_;                ///< by behavior
  std::vector<std::uint8_t> active_;                ///< by behavior
  std::vector<Microseconds> activated_at_;          ///< by behavior
  Timers timeouts_;
  Timers queue_;
  std::vector<std::uint8_t> waiting_;  ///< by task
  std::uint32_t waiting_count_ = 0;
};

/// The state of a coordinator, and of the runner of its script, between two events.
struct Snapshot {
  struct RunningTask {
    TaskId task;
    std::uint32_t value_index = 0;
    Microseconds since = 0;  ///< when it took the behavior
    std::optional<Request> request;
    bool waits_for_timeout = false;
  };
  Microseconds now = 0;
  std::uint64_t events = 0;  ///< number of the last one
  Microseconds reactive_delay = 0;
  bool timeouts = true;            ///< see CoordinatorOptions; if false, no task waits for one
  std::optional<Outcome> outcome;  ///< of the last scripted start, stop or finish; see Runner
  std::vector<RunningTask> running;
  std::vector<std::pair<BehaviorId, Microseconds>> active;  ///< with the time of the activation
  std::vector<BehaviorId> denied;        ///< those that a script made unavailable
  std::vector<std::uint32_t> variables;  ///< the value of each
  std::vector<BehaviorId> faulty;
  std::vector<std::pair<BehaviorId, Microseconds>> failed;  ///< those in X, with times; see State
  std::vector<std::pair<TaskId, Request>> suspended;
  std::vector<std::pair<TaskId, Microseconds>> queue;  ///< with due times
  std::vector<TaskId> waiting;                         ///< reactive tasks: see State
};

/// Why no coordinator can be in this state, or nothing. Tasks, behaviors and value indices must be
/// those of the catalog, and `variables` has as many items as the catalog; everything else may be
/// anything.
[[nodiscard]] std::optional<std::string> find_inconsistency(const CompiledCatalog& catalog,
                                                            const Snapshot& snapshot);

}  // namespace cbc
