#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/reason.h"
#include "solver/exact_product.h"

namespace cbc {

/// The problem of an event with only some of the reasons in force: the event itself (the task runs,
/// or stops), every other task free to have any of its behaviors or none, and no constraint but
/// those of the reasons.
class RelaxedProblem {
 public:
  /// `present`: by task of the group, place of its behavior, or none. `is_start`: the task of the
  /// event starts, else it stops.
  RelaxedProblem(const CompiledCatalog& catalog, std::uint32_t group,
                 const std::vector<std::uint32_t>& present, TaskId task, bool is_start);

  /// Whether there is a solution. At a limit of effort it is taken that there is one.
  [[nodiscard]] bool has_solution(std::span<const Reason> reasons);

 private:
  /// What is left of the domains in a subtree.
  struct Domains {
    std::vector<std::uint8_t> values;   ///< by value of the group: whether it is left
    std::vector<std::uint32_t> counts;  ///< by task: number of values left
    std::vector<std::uint8_t> needed;   ///< by task: whether it runs
  };

  [[nodiscard]] bool begin(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool remove(Domains& domains, TaskId task, std::uint32_t place);
  [[nodiscard]] bool close(Domains& domains, TaskId task);
  [[nodiscard]] bool need(Domains& domains, TaskId task);
  [[nodiscard]] bool propagate(Domains& domains, std::span<const Reason> reasons);
  [[nodiscard]] bool apply_requirement(Domains& domains, const Reason& reason);
  [[nodiscard]] bool may_perform(const Domains& domains, const Reason& reason);
  [[nodiscard]] TaskId choose(const Domains& domains) const;

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
  const TaskId task_;
  const bool is_start_;
  const TaskId first_task_;
  const TaskId end_task_;
  const std::uint32_t first_value_;
  bool has_changed_ = false;
  ExactProduct product_;
  ExactProduct minimum_;
  std::vector<TaskId> closure_;
  std::vector<std::uint8_t> in_closure_;  ///< by task of the group
};

}  // namespace cbc
