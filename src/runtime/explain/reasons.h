#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "solver/problem.h"

namespace cbc {

/// What a configuration is asked for beside the constraints.
struct Demand {
  enum class Kind : std::uint8_t {
    run,     ///< the task runs
    stop,    ///< the task does not run
    has,     ///< the task runs with this value
    has_not  ///< the task does not run with this value
  };
  Kind kind = Kind::run;
  TaskId task = 0;
  std::uint32_t place = none;  ///< of the value among those of the task
};

/// Demands that hold together.
using Demands = std::vector<Demand>;

/// One of the reasons why an event is rejected, or why an accepted one did not do otherwise.
struct Reason {
  enum class Kind : std::uint8_t {
    priority,       ///< the task's own request is stronger than the event; comes alone
    no_behavior,    ///< no behavior performs the task at all; comes alone
    is_protected,   ///< the task may not stop, as its request is stronger than the event
    exclusive,      ///< at most one of the two tasks runs
    on_request,     ///< the task is not running, and starts on request only
    requires_task,  ///< where the behavior is assigned, the task runs
    performance,    ///< where it is (or, without a behavior, always), the task performs well enough
    unavailable,    ///< the behavior cannot be activated in the present situation
    faulty,         ///< the activation of the behavior failed in this event
    finished        ///< the behavior of a finish event, where it failed; never of a rejected one
  };
  Kind kind = Kind::priority;
  TaskId task = none;
  TaskId other_task = none;  ///< of exclusive
  BehaviorId behavior = none;
  std::int32_t priority = 0;           ///< of priority and is_protected
  Millionths minimum_performance = 0;  ///< of performance
  std::uint32_t line = 0;              ///< of the catalog, where a line says so; else 0
};

[[nodiscard]] std::string_view name_of(Reason::Kind kind);

/// The tasks of one group that some tasks may come to need, directly or through what they require.
/// All others can stay not running, so constraints on them are no reason for anything.
class RelevantTasks {
 public:
  RelevantTasks(const CompiledCatalog& catalog, std::uint32_t group);

  void add(TaskId task);
  /// Adds all that the tasks so far may require; in TaskId order from then on. False if that are
  /// more than `most` tasks, and not all of them were added.
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

/// Appends the exclusions of a task with later relevant tasks; stops at `most` reasons in all.
void add_exclusions(const CompiledCatalog& catalog, TaskId task, const RelevantTasks& relevant,
                    std::size_t most, std::vector<Reason>& reasons);

/// Appends the minimum performance of a task, if it has one.
void add_minimum(const CompiledCatalog& catalog, TaskId task, std::vector<Reason>& reasons);

/// Appends the requirements of a behavior, those of performance apart.
void add_requirements(const CompiledCatalog& catalog, BehaviorId behavior,
                      std::vector<Reason>& reasons);

/// Whether there is a solution with these reasons in force, and no others.
using HasSolution = std::function<bool(std::span<const Reason>)>;

/// A minimal set of reasons out of `candidates`, which together leave no solution: with any one of
/// the set left out there is one.
[[nodiscard]] std::vector<Reason> minimal_set(std::span<const Reason> candidates,
                                              const HasSolution& has_solution);

/// Takes out of the domains of a problem what a demand on a task of its group rules out.
void narrow(const CompiledCatalog& catalog, const Demand& demand, Problem& problem);

/// Whether a task of the group can have more than one value.
[[nodiscard]] bool is_open(const CompiledCatalog& catalog, const Problem& problem, TaskId task);

}  // namespace cbc
