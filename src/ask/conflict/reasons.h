#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A condition on a solution beside the constraints.
struct Demand {
  enum class Kind : std::uint8_t {
    run,     ///< the task runs
    stop,    ///< the task does not run
    has,     ///< the task runs with this value
    has_not  ///< the task does not run with this value
  };
  Kind kind = Kind::run;
  TaskId task;
  std::uint32_t value_index = none;
};

/// Demands that all hold.
using Demands = std::vector<Demand>;

/// One element of a conflict set (docs/semantics.md, "Rejection"): why an event is rejected, or why
/// an accepted one was not answered otherwise.
struct Reason {
  enum class Kind : std::uint8_t {
    priority,       ///< the task's own request has a higher priority than the event; comes alone
    no_behavior,    ///< no behavior performs the task at all; comes alone
    is_protected,   ///< the task may not stop: its request has a higher priority than the event
    exclusive,      ///< at most one of the two tasks runs
    limited,        ///< at most so many tasks of a list run
    on_request,     ///< the task is not running, and starts on request only
    requires_task,  ///< if the behavior is assigned, the task runs
    performance,    ///< if it is (without a behavior: always), the task performs well enough
    unavailable,    ///< a script said that the behavior cannot be activated
    situation,      ///< the behavior does not fit the present situation
    faulty,         ///< the activation of the behavior failed in this event
    not_retried,    ///< the behavior failed before, and is not tried again yet
    makes_worse,    ///< what was asked for would run worse for a task that nobody asked for; alone
    not_improved,   ///< the task gets better than with its behavior only when it is started
    // Not where the event is rejected:
    finished,  ///< the behavior has just finished
    stopped    ///< the event stops the task
  };
  Kind kind = Kind::priority;
  TaskId task = none;
  TaskId other_task = none;  ///< of exclusive
  BehaviorId behavior = none;
  std::int32_t priority = 0;  ///< of priority and is_protected
  bool is_from_any_request =
      false;  ///< of is_protected: whatever the priority, at a reactive start
  Millionths minimum_performance = 0;  ///< of performance
  std::uint32_t variable = none;       ///< of situation: one that the behavior does not fit
  std::uint32_t value = 0;             ///< of situation: its present value; none: any misfit
  std::uint32_t limit = none;          ///< of limited: its number in the catalog
  Microseconds time = 0;               ///< of not_retried: when it failed
  std::uint32_t line = 0;              ///< of the catalog; 0 if no line states the reason
  /// Of performance, where it is known: the values of the task and of all that it requires with
  /// which the task would do best without this minimum (docs/semantics.md, "Rejection").
  std::vector<ValueId> best;

  friend bool operator==(const Reason& a, const Reason& b) = default;
};

[[nodiscard]] std::string_view name_of(Reason::Kind kind);

/// The tasks of one group that some tasks may need, directly or through what they require. All
/// other tasks can be left at "not running", so no constraint on them belongs to a conflict set.
class RelevantTasks {
 public:
  RelevantTasks(const CompiledCatalog& catalog, GroupId group);

  void add(TaskId task);
  /// Adds all that the tasks may require, and puts all into TaskId order. False if these are more
  /// than `most` tasks; then not all of them were added.
  bool close(std::size_t most = SIZE_MAX);

  [[nodiscard]] bool contains(TaskId task) const { return is_relevant_[task - first_task_] != 0; }
  [[nodiscard]] const std::vector<TaskId>& tasks() const { return tasks_; }
  /// The behaviors that perform them, in BehaviorId order.
  [[nodiscard]] std::vector<BehaviorId> behaviors() const;

 private:
  const CompiledCatalog& catalog_;
  TaskId first_task_;
  std::vector<std::uint8_t> is_relevant_;  ///< by task of the group
  std::vector<TaskId> tasks_;
};

/// Appends the exclusions of a task with later relevant tasks, and the limits of which it is the
/// first relevant task; stops at `most` reasons in all.
void add_exclusions(const CompiledCatalog& catalog, TaskId task, const RelevantTasks& relevant,
                    std::size_t most, std::vector<Reason>& reasons);

/// Appends the minimum performance of a task, if it has one.
void add_minimum(const CompiledCatalog& catalog, TaskId task, std::vector<Reason>& reasons);

/// Appends the requirements of a behavior: each task, and separately its minimum performance.
void add_requirements(const CompiledCatalog& catalog, BehaviorId behavior,
                      std::vector<Reason>& reasons);

}  // namespace cbc
