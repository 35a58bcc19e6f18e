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
/// ones the lowest item. An indexed binary heap, which allocates nothing after construction.
class Timers {
 public:
  using Item = std::uint32_t;

  explicit Timers(std::size_t items);

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

  void put(std::uint32_t position, const std::pair<Microseconds, Item>& entry);
  void sift_up(std::uint32_t position);
  void sift_down(std::uint32_t position);

  std::vector<std::pair<Microseconds, Item>> heap_;
  std::vector<std::uint32_t> position_;  ///< by item: where it is in the heap
};

/// The request of a running task.
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
  /// Gives the task a value (a value index, or none). A task that stops loses its request.
  void set_value(TaskId task, std::uint32_t index, Microseconds now);

  // Requests.

  [[nodiscard]] bool has_request(TaskId task) const { return has_request_[task] != 0; }
  [[nodiscard]] const Request& request(TaskId task) const { return requests_[task]; }
  /// The request of a task, or null.
  [[nodiscard]] const Request* find_request(TaskId task) const {
    return has_request(task) ? &requests_[task] : nullptr;
  }
  [[nodiscard]] std::uint32_t request_count() const { return request_count_; }
  /// The task must be running.
  void set_request(TaskId task, std::int32_t priority, std::uint64_t event,
                   std::string_view parameters, std::optional<Microseconds> time);

  // Behaviors.

  /// Whether the behavior can be activated: a script has not denied it, and the behavior fits.
  [[nodiscard]] bool is_available(BehaviorId behavior) const {
    return !is_denied(behavior) && fits(behavior);
  }
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

  [[nodiscard]] bool excludes_running_task(TaskId task) const;

 private:
  void clear();
  void update_available(BehaviorId behavior);

  const CompiledCatalog& catalog_;
  std::vector<std::uint32_t> assignment_;  ///< by task
  std::vector<Microseconds> taken_at_;     ///< by task: when it took its behavior
  std::vector<std::uint8_t> has_request_;  ///< by task
  std::vector<Request> requests_;          ///< by task
  std::vector<std::uint64_t> running_;     ///< bit set of catalog indices
  std::uint32_t idle_running_ = 0;
  std::uint32_t idle_total_ = 0;
  std::uint32_t request_count_ = 0;
  std::vector<std::uint8_t> denied_;    ///< by behavior
  std::vector<std::uint32_t> misfits_;  ///< by behavior: the variables that have no fitting value
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
  std::vector<std::pair<TaskId, Microseconds>> queue;  ///< with due times
  std::vector<TaskId> waiting;                         ///< reactive tasks: see State
};

/// Why no coordinator can be in this state, or nothing. Tasks, behaviors and value indices must be
/// those of the catalog, and `variables` has as many items as the catalog; everything else may be
/// anything.
[[nodiscard]] std::optional<std::string> find_inconsistency(const CompiledCatalog& catalog,
                                                            const Snapshot& snapshot);

}  // namespace cbc
