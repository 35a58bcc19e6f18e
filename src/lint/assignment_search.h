#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/relaxed_problem.h"
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

}  // namespace cbc
