#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/demand.h"
#include "explain/reason.h"
#include "solver/exact_product.h"

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

  /// Reasons and values looked at so far, a measure of the effort.
  [[nodiscard]] std::uint64_t effort() const { return effort_; }

 private:
  /// What is left of the domains in a subtree.
  struct Domains {
    std::vector<std::uint8_t> values;   ///< by value of the group: whether it is left
    std::vector<std::uint32_t> counts;  ///< by task: number of values left
    std::vector<std::uint8_t> needed;   ///< by task: whether it runs
  };

  [[nodiscard]] bool demand(Domains& domains, const Demand& demand);
  [[nodiscard]] bool begin(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool remove(Domains& domains, TaskId task, std::uint32_t place);
  [[nodiscard]] bool close(Domains& domains, TaskId task);
  [[nodiscard]] bool need(Domains& domains, TaskId task);
  [[nodiscard]] bool propagate(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool apply_requirement(Domains& domains, const Reason& reason);
  [[nodiscard]] bool may_perform(const Domains& domains, const Reason& reason);
  [[nodiscard]] bool may_reach(const Domains& domains, TaskId reached, Millionths minimum);
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
  bool has_changed_ = false;
  std::uint64_t effort_ = 0;
  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<TaskId> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task of the group
};

}  // namespace cbc
