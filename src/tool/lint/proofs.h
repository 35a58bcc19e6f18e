#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/diagnostic.h"
#include "explain/conflict_search.h"
#include "explain/reasons.h"
#include "solver/problem.h"
#include "solver/solver.h"

namespace cbc {

/// Answers questions about the assignments that satisfy all constraints of a catalog, every
/// behavior available and every task free to run or not.
///
/// The effort of one object is bounded: past it, all answers are unknown.
class AssignmentSearch {
 public:
  /// `max_nodes`: decisions for one answer.
  AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes);

  AssignmentSearch(const AssignmentSearch&) = delete;
  AssignmentSearch& operator=(const AssignmentSearch&) = delete;

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

  /// Whether the effort is used up.
  [[nodiscard]] bool is_exhausted() const { return effort_left_ == 0; }

  /// A value that no assignment has, which need not be tried again.
  void rule_out(ValueId value);

  /// Whether there is an assignment with a value, in which no task of `closed` runs. If so,
  /// `solution` has it, by task of the group.
  [[nodiscard]] Feasibility find(ValueId value, std::span<const TaskId> closed,
                                 Assignment& solution);

  /// The best performance of a task.
  struct Best {
    Feasibility exists = Feasibility::no;  ///< whether the task can run at all
    std::vector<Millionths> factors;       ///< suitabilities of which it is the product
  };
  /// Of all assignments in which the task runs. `ignore_minimum`: the task's own minimum
  /// performance does not count.
  [[nodiscard]] Best best_performance(TaskId task, bool ignore_minimum);

 private:
  /// A value's place in the domains of all tasks.
  struct Bit {
    std::uint32_t word = 0;
    std::uint64_t mask = 0;
  };

  [[nodiscard]] Bit bit_of(ValueId value) const;
  void open_group(std::uint32_t group);
  [[nodiscard]] std::uint32_t first_word() const;
  void allow(ValueId value);
  void must_run(TaskId task);
  void close(TaskId task);
  [[nodiscard]] Feasibility solve(Solver& solver, Assignment& solution);
  [[nodiscard]] std::vector<Millionths> factors_of(TaskId task, const Assignment& solution) const;

  CompiledCatalog catalog_;
  std::vector<CompiledTask> tasks_;  ///< of the catalog, to leave out a minimum for a while
  const std::vector<std::uint32_t> no_ranks_;
  Solver any_;
  Solver best_;
  std::vector<std::uint64_t> domains_;  ///< of all tasks, without the values that are ruled out
  Problem problem_;
  std::uint64_t effort_left_;
};

/// Finds assignments without search, which is enough for most values of most catalogs: what a value
/// requires runs with the first behavior that will do, and so on.
class DirectAssignment {
 public:
  explicit DirectAssignment(const CompiledCatalog& catalog);

  /// The values of an assignment that has a value and satisfies all constraints; valid until the
  /// next call. Empty if none is found in this way. `is_dead`, `is_live`: by value.
  [[nodiscard]] const std::vector<ValueId>& find(ValueId value, const std::vector<bool>& is_dead,
                                                 const std::vector<bool>& is_live);

 private:
  [[nodiscard]] bool take(ValueId value);
  [[nodiscard]] ValueId choose(TaskId task, const std::vector<bool>& is_dead,
                               const std::vector<bool>& is_live) const;

  const CompiledCatalog& catalog_;
  std::vector<ValueId> values_;
  std::uint64_t number_ = 0;            ///< of the present assignment
  std::vector<std::uint64_t> running_;  ///< by task: last assignment in which it runs
  std::vector<std::uint64_t> used_;     ///< by clique: last assignment in which a task of it runs
  std::uint64_t effort_left_;
};

/// All tasks, those that require little first, so that what is dead is known where it is required.
[[nodiscard]] std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog);

/// Which values, behaviors and tasks occur in no assignment that satisfies all constraints.
class Liveness {
 public:
  enum class State : std::uint8_t { live, dead, undecided };

  /// Searches. Dead values are ruled out in `search` from then on.
  explicit Liveness(AssignmentSearch& search);

  [[nodiscard]] State of_value(ValueId value) const {
    if (is_live_[value]) return State::live;
    return is_dead_[value] ? State::dead : State::undecided;
  }
  /// Dead if it is dead as a value of all its tasks.
  [[nodiscard]] State of_behavior(BehaviorId behavior) const;
  /// Dead if all its behaviors are dead as its values; a task without behaviors is dead.
  [[nodiscard]] State of_task(TaskId task) const;

 private:
  void decide(ValueId value, AssignmentSearch& search);

  const CompiledCatalog& catalog_;
  std::vector<bool> is_live_;  ///< by value
  std::vector<bool> is_dead_;
  DirectAssignment direct_;
  Assignment solution_;
};

/// What the semantic checks of one catalog share.
class Semantics {
 public:
  /// All references must outlive this object.
  Semantics(const Catalog& catalog, AssignmentSearch& search, const Liveness& liveness,
            std::uint64_t max_nodes, Reporter& reporter);

  [[nodiscard]] const Catalog& catalog() const { return catalog_; }
  [[nodiscard]] const CompiledCatalog& compiled() const { return search_.catalog(); }
  [[nodiscard]] const Behavior& behavior(BehaviorId id) const {
    return catalog_.behaviors[compiled().behaviors[id].catalog_index];
  }
  [[nodiscard]] const Task& task(TaskId id) const {
    return catalog_.tasks[compiled().tasks[id].catalog_index];
  }
  [[nodiscard]] AssignmentSearch& search() { return search_; }
  [[nodiscard]] const Liveness& liveness() const { return liveness_; }
  [[nodiscard]] Reporter& reporter() { return reporter_; }

  /// Whether a finding says why a behavior is never active, a task never runs.
  [[nodiscard]] bool is_explained_behavior(BehaviorId id) const { return behaviors_[id]; }
  [[nodiscard]] bool is_explained_task(TaskId id) const { return tasks_[id]; }
  void explain_behavior(BehaviorId id) { behaviors_[id] = true; }
  void explain_task(TaskId id) { tasks_[id] = true; }

  /// A question about reasons: tasks of one group, of which at least one runs (with the value).
  struct Goal {
    TaskId task = none;
    std::uint32_t value_index = none;  ///< none: with any behavior
  };
  /// Whether one of the goals can be had with only some constraints in force.
  [[nodiscard]] Feasibility solve(std::span<const Goal> goals, std::span<const Reason> reasons);
  /// The same for a problem that was set up.
  [[nodiscard]] Feasibility solve(ConflictSearch& problem, std::span<const Reason> reasons);

  /// A relaxed problem in which a task runs.
  [[nodiscard]] ConflictSearch relaxed(const Goal& goal) const;

  /// Reports that a question took too many decisions.
  void report_undecided(const Range& range, const std::string& question);

 private:
  const Catalog& catalog_;
  AssignmentSearch& search_;
  const Liveness& liveness_;
  const std::uint64_t max_nodes_;
  Reporter& reporter_;
  std::vector<bool> behaviors_;
  std::vector<bool> tasks_;
  const std::vector<std::uint32_t> nothing_present_;
  std::uint64_t effort_left_;
  bool has_told_exhaustion_ = false;
};

}  // namespace cbc
