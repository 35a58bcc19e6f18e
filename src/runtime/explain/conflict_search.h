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

/// Searches for a solution with only some of the reasons in force: the demands hold; otherwise
/// every task of the group may have any of its behaviors or none, and the reasons are all
/// constraints. It records the cause of each removal, so that a failure yields the reasons that it
/// comes from.
///
/// That is conflict-directed backjumping (P. Prosser, "Hybrid algorithms for the constraint
/// satisfaction problem", Computational Intelligence 9, 1993) on propagated domains: the conflict
/// set of a level is read off the causes of the failure, as in the analysis of a SAT solver, but no
/// clause is learned from it.
class ConflictSearch {
 public:
  /// `present`: by task of the group, its value index, or none.
  ConflictSearch(const CompiledCatalog& catalog, std::uint32_t group,
                 const std::vector<std::uint32_t>& present, Demands demands);

  /// Admits only solutions in which `task` runs and its performance is below `minimum`.
  void keep_below(TaskId task, Millionths minimum) {
    low_task_ = task;
    low_minimum_ = minimum;
  }

  [[nodiscard]] Feasibility solve(std::span<const Reason> reasons);

  /// After the answer no: by reason, whether the proof used it. The reasons that it used leave no
  /// solution by themselves.
  [[nodiscard]] const std::vector<std::uint8_t>& is_used() const { return is_used_; }

  /// Reasons and values visited so far: a measure of time that does not depend on the machine.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

 private:
  /// The domains in a subtree, and the causes of their changes. A cause is the index of a reason,
  /// or first_decision + the level of a decision, or none: a demand.
  struct Domains {
    std::vector<std::uint8_t> values;       ///< by value of the group: whether it is in the domain
    std::vector<std::uint32_t> counts;      ///< by task: number of values left
    std::vector<std::uint8_t> needed;       ///< by task: whether it runs
    std::vector<std::uint32_t> removed_by;  ///< by removed value: the cause
    std::vector<std::uint32_t> needed_by;   ///< by task that runs: the cause
    std::vector<std::uint32_t> needed_through;  ///< the value whose requirement it is
  };

  /// A subtree, after `level` decisions.
  struct Branch {
    Domains domains;
    std::uint32_t level = 0;
    TaskId decided = none;  ///< by the last of them
  };
  static constexpr std::uint32_t first_decision = std::uint32_t{1} << 31U;

  void decide(Branch& now, TaskId task);
  void decide_whether_to_run(Branch& now, TaskId task);
  [[nodiscard]] Branch& branch(Branch& now, TaskId task);
  [[nodiscard]] bool backjump(Branch& now);
  [[nodiscard]] bool demand(Domains& domains, const Demand& demand);
  [[nodiscard]] bool begin(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool remove(Domains& domains, TaskId task, std::uint32_t index);
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
  void analyze_conflict(const Domains& domains, std::span<const Reason> reasons);
  void explain_performance(const Domains& domains);
  void explain_value(ValueId id);
  void explain_running(TaskId task);
  void explain_removals(TaskId task, std::uint32_t kept);
  void add_fact(std::size_t fact);
  [[nodiscard]] TaskId choose(const Domains& domains) const;
  [[nodiscard]] TaskId optional_factor(const Domains& domains) const;

  [[nodiscard]] std::size_t value(TaskId task, std::uint32_t index) const {
    return catalog_.values.begin[task] + index - first_value_;
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
  std::vector<std::uint32_t> state_;       ///< the other reasons, which apply once
  std::vector<TaskId> changed_;            ///< tasks whose reasons have to be applied again
  std::vector<std::uint8_t> has_changed_;  ///< by task of the group: whether it is in changed_
  std::uint64_t effort_ = 0;
  std::vector<Branch> open_;           ///< second branches; at most one of each level
  std::vector<std::uint8_t> is_used_;  ///< by reason
  std::vector<std::uint8_t>
      conflict_set_;  ///< by level: whether the failure depends on its decision
  std::vector<std::vector<std::uint8_t>>
      conflict_sets_before_;    ///< by level: that of its first branch
  std::uint32_t cause_ = none;  ///< of the removals and needs that follow
  ValueId through_ = none;      ///< the value whose requirement cause_ is
  TaskId dead_end_ = none;      ///< the needed task without values; none: a performance is too low
  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<TaskId> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task of the group
  /// Facts that the failure comes from: a value is removed (its number in the group), or a task
  /// runs (its number, after all values).
  std::vector<std::size_t> facts_;
  std::vector<std::uint8_t> is_known_fact_;
};

}  // namespace cbc
