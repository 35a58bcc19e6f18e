#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ask/conflict/conflict_search.h"
#include "ask/conflict/effort.h"
#include "ask/conflict/reasons.h"
#include "ask/situation_space.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

// Assignments of a group, with the solver that decides events: what all exact answers rest on.

namespace cbc {

/// What the questions about one catalog may cost.
inline constexpr std::uint64_t most_effort_of_assignments = 100'000'000;

/// Behaviors, ascending.
using BehaviorSet = std::vector<BehaviorId>;

/// The active behaviors of an assignment of the group of a task.
[[nodiscard]] BehaviorSet behaviors_of(const CompiledCatalog& catalog, TaskId task,
                                       const Assignment& assignment);

/// The situations of a space that have values of the sets; nothing: any behavior fits.
struct Situations {
  const SituationSpace* space = nullptr;
  const ValueSets* sets = nullptr;
};

/// Finds assignments of a group that satisfy all constraints. Nothing runs before, and every task
/// may run. A solution runs only what is demanded and what that needs (solver/domains.h).
class AssignmentSearch {
 public:
  /// `max_nodes`: decisions for one answer; 0: no limit.
  AssignmentSearch(CompiledCatalog catalog, std::uint64_t max_nodes, Effort effort);

  AssignmentSearch(const AssignmentSearch&) = delete;
  AssignmentSearch& operator=(const AssignmentSearch&) = delete;

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

  /// Whether the effort is used up.
  [[nodiscard]] bool is_exhausted() const { return effort_.left() == 0; }
  [[nodiscard]] Effort& effort() { return effort_; }

  /// Rules out a value that no assignment has, so that it is not tried again.
  void rule_out(ValueId value);

  enum class Wanted : std::uint8_t {
    any,  ///< some assignment
    best  ///< the best one, for a request of what has to run (docs/semantics.md, "Objectives")
  };
  /// Whether there is an assignment of a group that meets the demands, with behaviors that fit in
  /// some of the situations, each by itself. If so, it is in `solution`: the value of each task of
  /// the group.
  [[nodiscard]] Feasibility find(GroupId group, std::span<const Demand> demands,
                                 Assignment& solution, const Situations& where = {},
                                 Wanted wanted = Wanted::any);

  /// The best performance of a task.
  struct Best {
    Feasibility exists = Feasibility::no;  ///< whether the task can run at all
    std::vector<Millionths> factors;       ///< suitabilities of which it is the product
  };
  /// The best one of all assignments in which the task runs. `ignore_minimum`: the task's own
  /// minimum performance does not count.
  [[nodiscard]] Best best_performance(TaskId task, bool ignore_minimum);

 private:
  /// The values of variables in which the behavior of a value fits.
  struct Condition {
    ValueId value;
    std::span<const FittingValue> fitting;
  };

  /// A value's place in the domains of all tasks.
  struct Bit {
    std::uint32_t word = 0;
    std::uint64_t mask = 0;
  };

  [[nodiscard]] Bit bit_of(ValueId value) const;
  [[nodiscard]] std::uint64_t& word_of(const Bit& bit) {
    return problem_.domains[bit.word - catalog_.words[catalog_.group_tasks[problem_.group]]];
  }
  void open_group(GroupId group);
  void demand(const Demand& demand);
  void close_misfits(const SituationSpace& space, const ValueSets& sets);
  [[nodiscard]] Feasibility solve(Wanted wanted, Assignment& solution);
  [[nodiscard]] std::vector<Millionths> factors_of(TaskId task, const Assignment& solution) const;

  CompiledCatalog catalog_;
  std::vector<CompiledTask> tasks_;  ///< those of the catalog, to suspend a minimum
  const std::uint64_t max_nodes_;
  std::optional<Solver> any_;
  std::optional<Solver> best_;
  std::vector<std::uint64_t> domains_;  ///< of all tasks, without the values that are ruled out
  std::vector<Condition> conditions_;   ///< of all values that have any, ascending
  Problem problem_;
  Effort effort_;
};

}  // namespace cbc
