#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "ask/conflict/conflict_search.h"
#include "ask/conflict/reasons.h"
#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

/// What the constraints of a catalog make impossible or redundant: decided exactly, by search.
/// First the checks, then what they share.
namespace cbc {

/// All checks of a catalog whose names were all understood, and whose requirements have no cycle.
/// `conflicts`: by behavior, whether a finding already says that it can never be active.
void check_by_proof(const CatalogReading& reading, const CompiledCatalog& compiled,
                    const std::vector<bool>& conflicts, const LintOptions& options,
                    Reporter& reporter);

/// The one check that is possible without a compiled catalog: reports requirements of tasks that
/// start on request only. Only the required task itself is known to be requested first.
void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter);

class ProofContext;

/// One of these checks: tasks and behaviors that the constraints allow, but that fit, with what
/// they require, in no situation.
void check_situations(ProofContext& proof);

/// One of these checks: minimum performances that are reached anyway.
void check_redundant_minimums(ProofContext& proof);

/// Constraints that are examined for one proof; among more it would take too long.
inline constexpr std::size_t most_constraints = 20'000;

/// Those that bear on some tasks and on what performs them. If there are more than
/// `most_constraints`, some are left out.
[[nodiscard]] std::vector<Reason> constraints_on(const CompiledCatalog& catalog,
                                                 const RelevantTasks& relevant);

/// Answers questions about the assignments that satisfy all constraints of a catalog. Every
/// behavior is available, and every task is free to run or not.
///
/// The effort of one object is bounded: past it, all answers are unknown.
class AssignmentSearch {
 public:
  /// `max_nodes`: decisions for one answer. `is_stopped`: see LintOptions.
  AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes,
                   std::function<bool()> is_stopped = {});

  AssignmentSearch(const AssignmentSearch&) = delete;
  AssignmentSearch& operator=(const AssignmentSearch&) = delete;

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

  /// Whether the effort is used up.
  [[nodiscard]] bool is_exhausted() const { return effort_left_ == 0; }
  [[nodiscard]] bool is_stopped() const { return is_stopped_ && is_stopped_(); }

  /// Rules out a value that no assignment has, so that it is not tried again.
  void rule_out(ValueId value);

  /// Whether there is an assignment with a value in which no task of `closed` runs. If so, it is in
  /// `solution`, by task of the group. `situation`: values of all situation variables, in which its
  /// behaviors have to fit; empty: any behavior will do.
  [[nodiscard]] Feasibility find(ValueId value, std::span<const TaskId> closed,
                                 Assignment& solution,
                                 std::span<const std::uint32_t> situation = {});

  /// Whether there is an assignment in which all of some tasks, which are of one group, run; the
  /// rest as for find().
  [[nodiscard]] Feasibility find_running(std::span<const TaskId> tasks,
                                         std::span<const std::uint32_t> situation,
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

  /// The values of variables in which the behavior of a value fits.
  struct Condition {
    ValueId value;
    std::span<const FittingValue> fitting;
  };

  [[nodiscard]] Bit bit_of(ValueId value) const;
  void open_group(GroupId group);
  [[nodiscard]] std::uint32_t first_word() const;
  void allow(ValueId value);
  void must_run(TaskId task);
  void close(TaskId task);
  void close_misfits(std::span<const std::uint32_t> situation);
  void spend(std::uint64_t effort) { effort_left_ -= std::min(effort, effort_left_); }
  [[nodiscard]] Feasibility solve(Solver& solver, Assignment& solution);
  [[nodiscard]] std::vector<Millionths> factors_of(TaskId task, const Assignment& solution) const;

  CompiledCatalog catalog_;
  std::vector<CompiledTask> tasks_;  ///< those of the catalog, to suspend a minimum
  const std::vector<std::uint32_t> no_ranks_;
  Solver any_;
  Solver best_;
  std::vector<std::uint64_t> domains_;  ///< of all tasks, without the values that are ruled out
  std::vector<Condition> conditions_;   ///< of all values that have any, ascending
  Problem problem_;
  const std::function<bool()> is_stopped_;
  std::uint64_t effort_left_;
};

/// All tasks from the lowest level up, so that what is required is decided before what requires it.
[[nodiscard]] std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog);

class DirectAssignment;

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
  /// Dead if the behavior is dead as a value of each of its tasks.
  [[nodiscard]] State of_behavior(BehaviorId behavior) const;
  /// Dead if all its values are dead, so also if it has none.
  [[nodiscard]] State of_task(TaskId task) const;

 private:
  [[nodiscard]] bool requires_dead_task(ValueId value) const;
  void decide(ValueId value, DirectAssignment& direct, AssignmentSearch& search);

  const CompiledCatalog& catalog_;
  std::vector<bool> is_live_;  ///< by value
  std::vector<bool> is_dead_;
  Assignment solution_;
};

class ProofContext;

/// The checks about tasks that run at the same time. `is_complete`: all of the catalog was
/// understood.
void check_together(ProofContext& proof, const LintOptions& options, bool is_complete);

/// What the proof checks of one catalog share.
class ProofContext {
 public:
  /// All references must outlive this object.
  ProofContext(const Catalog& catalog, AssignmentSearch& search, const Liveness& liveness,
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

  /// A task that is to run, perhaps with a certain value.
  struct Goal {
    TaskId task = none;
    std::uint32_t value_index = none;  ///< none: with any behavior
  };
  /// A relaxed problem in which a task runs.
  [[nodiscard]] ConflictSearch relaxed(const Goal& goal) const;
  /// One for each of some goals.
  [[nodiscard]] std::vector<ConflictSearch> relaxed(std::span<const Goal> goals) const;

  /// Whether a problem has a solution under some of the constraints alone.
  [[nodiscard]] Feasibility solve(ConflictSearch& problem, std::span<const Reason> reasons);
  /// Whether one of several problems has.
  [[nodiscard]] Feasibility solve(std::span<ConflictSearch> problems,
                                  std::span<const Reason> reasons);

  /// Whether the effort is used up.
  [[nodiscard]] bool is_exhausted() const { return effort_left_ == 0; }
  /// Takes what a check does beside the searches from their effort: so many constraints or tasks
  /// were looked at.
  void spend(std::uint64_t effort) { effort_left_ -= std::min(effort, effort_left_); }

  /// Notes that say, for each of a set of constraints, what it is and where it stands.
  [[nodiscard]] std::vector<Note> notes_of(std::span<const Reason> constraints) const;

  /// Reports that a question could not be decided within the limits.
  void report_undecided(const Range& range, const std::string& question);

 private:
  [[nodiscard]] Note note_of(const Reason& reason) const;
  [[nodiscard]] Note note_of_condition(const Reason& reason) const;

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
