#include "compiled/count_constraints.h"

namespace cbc {
namespace {

/// Number of tasks after `task` that share a clique with it. `seen` holds, by task, the last task
/// that met it here.
std::uint64_t count_later_neighbors(const CompiledCatalog& catalog, TaskId task,
                                    std::vector<TaskId>& seen) {
  std::uint64_t count = 0;
  for (const std::uint32_t clique : catalog.task_cliques[task]) {
    for (const TaskId other : catalog.cliques[clique]) {
      if (other <= task || seen[other] == task) continue;
      seen[other] = task;
      ++count;
    }
  }
  return count;
}

}  // namespace

std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog) {
  std::vector<ConstraintCount> counts(catalog.group_tasks.size() - 1);
  std::vector<TaskId> seen(catalog.tasks.size(), none);
  for (std::size_t group = 0; group < counts.size(); ++group) {
    ConstraintCount& count = counts[group];
    for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
      count.exclusive_pairs += count_later_neighbors(catalog, task, seen);
      if (catalog.tasks[task].minimum_performance > 0) ++count.task_minimums;
    }
    for (BehaviorId behavior = catalog.group_behaviors[group];
         behavior < catalog.group_behaviors[group + 1]; ++behavior) {
      count.requirements += catalog.requirements[behavior].size();
    }
  }
  return counts;
}

}  // namespace cbc
