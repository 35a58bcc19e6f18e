#include "compiled/count_constraints.h"

#include <algorithm>
#include <numeric>

namespace cbc {
namespace {

/// Counts the distinct pairs of tasks that share a clique.
class PairCounter {
 public:
  explicit PairCounter(const CompiledCatalog& catalog)
      : catalog_(catalog), seen_(catalog.tasks.size(), none) {}

  /// In one group. Tasks that are in the same cliques exclude the same tasks (and each other), so
  /// that these are counted once for all of them.
  std::uint64_t count(std::uint32_t group) {
    tasks_.resize(catalog_.group_tasks[group + 1] - catalog_.group_tasks[group]);
    std::iota(tasks_.begin(), tasks_.end(), catalog_.group_tasks[group]);
    std::sort(tasks_.begin(), tasks_.end(), [this](TaskId a, TaskId b) {
      const auto first = catalog_.task_cliques[a];
      const auto second = catalog_.task_cliques[b];
      return std::lexicographical_compare(first.begin(), first.end(), second.begin(), second.end());
    });
    std::uint64_t ends_of_pairs = 0;
    for (auto alike = tasks_.begin(); alike != tasks_.end();) {
      const auto end = std::find_if_not(alike, tasks_.end(),
                                        [&](TaskId task) { return are_in_the_same(*alike, task); });
      ends_of_pairs += static_cast<std::uint64_t>(end - alike) * count_excluded(*alike);
      alike = end;
    }
    return ends_of_pairs / 2;
  }

 private:
  [[nodiscard]] bool are_in_the_same(TaskId a, TaskId b) const {
    const auto first = catalog_.task_cliques[a];
    const auto second = catalog_.task_cliques[b];
    return std::equal(first.begin(), first.end(), second.begin(), second.end());
  }

  /// Number of tasks that share a clique with `task`.
  std::uint64_t count_excluded(TaskId task) {
    std::uint64_t count = 0;
    seen_[task] = task;
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      for (const TaskId other : catalog_.cliques[clique]) {
        if (seen_[other] == task) continue;
        seen_[other] = task;
        ++count;
      }
    }
    return count;
  }

  const CompiledCatalog& catalog_;
  std::vector<TaskId> seen_;   ///< by task: the last one that was found to exclude it
  std::vector<TaskId> tasks_;  ///< of a group, those in the same cliques side by side
};

}  // namespace

std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog) {
  std::vector<ConstraintCount> counts(catalog.group_count());
  PairCounter pairs(catalog);
  for (std::uint32_t group = 0; group < counts.size(); ++group) {
    ConstraintCount& count = counts[group];
    count.exclusive_pairs = pairs.count(group);
    for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
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
