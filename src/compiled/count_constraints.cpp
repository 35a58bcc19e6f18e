#include "compiled/count_constraints.h"

namespace cbc {
namespace {

/// Counts the distinct pairs of tasks that share a clique.
class PairCounter {
 public:
  explicit PairCounter(const CompiledCatalog& catalog)
      : catalog_(catalog),
        seen_(catalog.tasks.size(), none),
        met_(catalog.cliques.size(), none),
        is_apart_(catalog.cliques.size(), 0) {
    for (std::uint32_t clique = 0; clique < is_apart_.size(); ++clique) {
      is_apart_[clique] = shares_no_pair(clique) ? 1 : 0;
    }
  }

  /// Of `task`, with tasks after it.
  std::uint64_t count(TaskId task) {
    std::uint64_t count = 0;
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      const std::span<const TaskId> tasks = catalog_.cliques[clique];
      if (is_apart_[clique] != 0) {
        // Nobody else counts these pairs, so they need not be looked at.
        if (task == tasks.front()) count += std::uint64_t{tasks.size()} * (tasks.size() - 1) / 2;
        continue;
      }
      for (const TaskId other : tasks) {
        if (other <= task || seen_[other] == task) continue;
        seen_[other] = task;
        ++count;
      }
    }
    return count;
  }

 private:
  /// Whether no other clique has two tasks of this one. Says no, too, where finding that out takes
  /// longer than going through its pairs.
  bool shares_no_pair(std::uint32_t clique) {
    const std::span<const TaskId> tasks = catalog_.cliques[clique];
    std::uint64_t work_left = std::uint64_t{tasks.size()} * tasks.size();
    for (const TaskId task : tasks) {
      const std::span<const std::uint32_t> others = catalog_.task_cliques[task];
      if (others.size() > work_left) return false;
      work_left -= others.size();
      for (const std::uint32_t other : others) {
        if (other != clique && met_[other] == clique) return false;
        met_[other] = clique;
      }
    }
    return true;
  }

  const CompiledCatalog& catalog_;
  std::vector<TaskId> seen_;            ///< by task: the last one that met it in `count`
  std::vector<std::uint32_t> met_;      ///< by clique: the last one that met it, by a common task
  std::vector<std::uint8_t> is_apart_;  ///< by clique
};

}  // namespace

std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog) {
  std::vector<ConstraintCount> counts(catalog.group_count());
  PairCounter pairs(catalog);
  for (std::size_t group = 0; group < counts.size(); ++group) {
    ConstraintCount& count = counts[group];
    for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
      count.exclusive_pairs += pairs.count(task);
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
