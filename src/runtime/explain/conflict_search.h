#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/reasons.h"
#include "solver/objective.h"

namespace cbc {

/// Whether a problem has a solution; unknown at a limit of effort.
enum class Feasibility : std::uint8_t { no, yes, unknown };

/// A problem with only some of the reasons in force: the demands hold; every task of the group is
/// free otherwise to have any of its behaviors or none; and there is no constraint but those of the
/// reasons.
class RelaxedProblem {
 public:
  /// `present`: by task of the group, place of its behavior, or none.
  RelaxedProblem(const CompiledCatalog& catalog, std::uint32_t group,
                 const std::vector<std::uint32_t>& present, Demands demands);

  /// Only solutions count in which `task` runs, and performs less well than `minimum`.
  void keep_below(TaskId task, Millionths minimum) {
    low_task_ = task;
    low_minimum_ = minimum;
  }

  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons);

  /// After the answer no: by place in the reasons, whether that one had a part in the proof. Those
  /// that had leave no solution either.
  [[nodiscard]] const std::vector<std::uint8_t>& is_used() const { return is_used_; }

  /// Reasons and values looked at so far, a measure of the effort.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

 private:
  /// What is left of the domains in a subtree, and why. A cause is the place of a reason; or that
  /// of a decision, the level, after first_decision; or none: a demand.
  struct Domains {
    std::vector<std::uint8_t> values;           ///< by value of the group: whether it is left
    std::vector<std::uint32_t> counts;          ///< by task: number of values left
    std::vector<std::uint8_t> needed;           ///< by task: whether it runs
    std::vector<std::uint32_t> removed_by;      ///< by value that is not left: the cause
    std::vector<std::uint32_t> needed_by;       ///< by task that runs: the cause
    std::vector<std::uint32_t> needed_through;  ///< the value that a requirement applies to
  };

  /// A subtree, after so many decisions.
  struct Branch {
    Domains domains;
    std::uint32_t level = 0;
    TaskId decided = none;  ///< by the last of them
  };
  static constexpr std::uint32_t first_decision = std::uint32_t{1} << 31U;

  void decide(Branch& now, TaskId task);
  void decide_whether_to_run(Branch& now, TaskId task);
  [[nodiscard]] Branch& branch(Branch& now, TaskId task);
  [[nodiscard]] bool back_up(Branch& now);
  [[nodiscard]] bool demand(Domains& domains, const Demand& demand);
  [[nodiscard]] bool begin(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool remove(Domains& domains, TaskId task, std::uint32_t place);
  [[nodiscard]] bool close(Domains& domains, TaskId task);
  [[nodiscard]] bool need(Domains& domains, TaskId task);
  void sort(std::span<const Reason> reasons);
  void note_change(TaskId task);
  void forget_changes();
  [[nodiscard]] bool propagate(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool follow_changes(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool apply(Domains& domains, const Reason& reason);
  [[nodiscard]] bool apply_state(Domains& domains, const Reason& reason);
  [[nodiscard]] bool apply_requirement(Domains& domains, const Reason& reason);
  [[nodiscard]] bool may_perform(const Domains& domains, const Reason& reason);
  [[nodiscard]] bool may_reach(const Domains& domains, TaskId reached, Millionths minimum);
  void blame(const Domains& domains, std::span<const Reason> reasons);
  void blame_performance(const Domains& domains);
  void blame_fixed(ValueId id);
  void blame_running(TaskId task);
  void blame_removals(TaskId task, std::uint32_t kept);
  void blame_fact(std::size_t fact);
  [[nodiscard]] TaskId choose(const Domains& domains) const;
  [[nodiscard]] TaskId optional_factor(const Domains& domains) const;

  [[nodiscard]] std::size_t value(TaskId task, std::uint32_t place) const {
    return catalog_.values.begin[task] + place - first_value_;
  }
  [[nodiscard]] std::uint32_t best(const Domains& domains, TaskId task) const;
  [[nodiscard]] bool is_needed(const Domains& domains, TaskId task) const {
    return domains.needed[task - first_task_] != 0;
  }
  [[nodiscard]] bool is_fixed(const Domains& domains, TaskId task) const {
    return is_needed(domains, task) && domains.counts[task - first_task_] == 1;
  }
  [[nodiscard]] BehaviorId fixed_behavior(const Domains& domains, TaskId task) const;

  const CompiledCatalog& catalog_;
  const std::vector<std::uint32_t>& present_;
  const Demands demands_;
  TaskId low_task_ = none;
  Millionths low_minimum_ = 0;
  const TaskId first_task_;
  const TaskId end_task_;
  const std::uint32_t first_value_;
  std::vector<std::vector<std::uint32_t>> reasons_of_task_;  ///< exclusions and requirements
  std::vector<std::uint32_t> performances_;                  ///< the reasons of that kind
  std::vector<std::uint32_t> state_;       ///< the others: what the state rules out at once
  std::vector<TaskId> changed_;            ///< tasks whose reasons have to be looked at again
  std::vector<std::uint8_t> has_changed_;  ///< by task of the group: whether it is one
  std::uint64_t effort_ = 0;
  std::vector<Branch> open_;            ///< at most one of each level
  std::vector<std::uint8_t> is_used_;   ///< by reason
  std::vector<std::uint8_t> culprits_;  ///< by level: whether it has a part in the failure
  std::vector<std::vector<std::uint8_t>> culprits_before_;  ///< by level: of its first branch
  std::uint32_t cause_ = none;  ///< of what is removed, or found to be needed
  ValueId through_ = none;      ///< beside it
  TaskId dead_end_ = none;      ///< the task that runs and has no value left; none: a performance
  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<TaskId> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task of the group
  /// Facts that have to be explained: that a value is removed (its place), or that a task runs (its
  /// place after all values).
  std::vector<std::size_t> facts_;
  std::vector<std::uint8_t> is_known_fact_;
};

}  // namespace cbc
