#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

// Assignments that run one task, with the solver that decides events.

namespace cbc {

/// Behaviors, ascending.
using BehaviorSet = std::vector<BehaviorId>;

/// The active behaviors of an assignment of the group of a task.
[[nodiscard]] BehaviorSet behaviors_of(const CompiledCatalog& catalog, TaskId task,
                                       const Assignment& assignment);

/// Searches for assignments that satisfy all constraints and run a task, while some behaviors are
/// not to be had. Nothing runs before, and every other task may run.
class TaskSearch {
 public:
  enum class Wanted : std::uint8_t {
    any,  ///< some assignment
    best  ///< the best one, for a request of the task alone (docs/semantics.md, "Objectives")
  };
  enum class Answer : std::uint8_t { found, impossible, stopped };

  /// The catalog must outlive this object.
  TaskSearch(const CompiledCatalog& catalog, TaskId task, Wanted wanted);

  /// Looks for an assignment without the behaviors that are absent; by BehaviorId, of the whole
  /// catalog. `keep_on` is asked now and then; false ends the search.
  [[nodiscard]] Answer find_without(const std::vector<bool>& absent,
                                    const std::function<bool()>& keep_on);

  /// Of the assignment that was found last: the value of each task of the group.
  [[nodiscard]] const Assignment& assignment() const { return assignment_; }
  /// Its active behaviors. A solution runs only what the task needs (solver/domains.h), so none of
  /// them is there in vain.
  [[nodiscard]] BehaviorSet active() const { return behaviors_of(catalog_, task_, assignment_); }

 private:
  void set_budget(std::uint64_t nodes);
  void flip(ValueId value);

  const CompiledCatalog& catalog_;
  const TaskId task_;
  const TaskId first_task_;
  const Wanted wanted_;
  const std::vector<std::uint32_t> no_ranks_;
  Problem problem_;
  std::vector<std::uint64_t> full_domains_;
  std::uint64_t budget_ = 0;
  std::optional<Solver> solver_;
  Assignment assignment_;
};

}  // namespace cbc
