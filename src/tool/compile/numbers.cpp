#include <algorithm>
#include <numeric>

#include <boost/multiprecision/cpp_int.hpp>

#include "compile/compile.h"

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

/// The constraints of each group.
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

}  // namespace

std::string search_space(const std::vector<std::uint32_t>& domain_sizes) {
  // Most products fit in a machine word.
  std::uint64_t word = 1;
  std::size_t place = 0;
  while (place < domain_sizes.size() && word <= UINT32_MAX) word *= domain_sizes[place++];
  if (place == domain_sizes.size()) return std::to_string(word);

  boost::multiprecision::cpp_int product = word;
  for (; place < domain_sizes.size(); ++place) {
    if (domain_sizes[place] != 1) product *= domain_sizes[place];
  }
  return product.str();
}

namespace {

void add(ConstraintCount& sum, const ConstraintCount& count) {
  sum.exclusive_pairs += count.exclusive_pairs;
  sum.requirements += count.requirements;
  sum.task_minimums += count.task_minimums;
}

}  // namespace

CatalogSummary summarize_groups(const CompiledCatalog& catalog) {
  CatalogSummary summary;
  const std::vector<ConstraintCount> counts = count_constraints(catalog);
  std::vector<std::uint32_t> all_sizes;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    CatalogNumbers& numbers = summary.groups.emplace_back();
    const TaskId begin = catalog.group_tasks[group];
    const TaskId end = catalog.group_tasks[group + 1];
    numbers.tasks = end - begin;
    numbers.behaviors = catalog.group_behaviors[group + 1] - catalog.group_behaviors[group];
    numbers.constraints = counts[group];
    std::vector<std::uint32_t> sizes;
    for (TaskId task = begin; task < end; ++task) {
      numbers.levels = std::max(numbers.levels, 1 + catalog.tasks[task].level);
      sizes.push_back(static_cast<std::uint32_t>(1 + catalog.values[task].size()));
    }
    numbers.search_space = search_space(sizes);
    all_sizes.insert(all_sizes.end(), sizes.begin(), sizes.end());
    summary.total.levels = std::max(summary.total.levels, numbers.levels);
    add(summary.total.constraints, numbers.constraints);
  }
  summary.total.tasks = catalog.tasks.size();
  summary.total.behaviors = catalog.behaviors.size();
  summary.total.search_space = search_space(all_sizes);
  return summary;
}

std::vector<std::uint32_t> cliques_of_group(const CompiledCatalog& catalog, std::size_t group) {
  std::vector<std::uint32_t> cliques;
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    for (const std::uint32_t clique : catalog.task_cliques[task]) {
      if (catalog.cliques[clique].front() == task) cliques.push_back(clique);
    }
  }
  return cliques;
}

Summary summarize(const CompiledCatalog& catalog) {
  Summary summary;
  summary.tasks = catalog.tasks.size();
  summary.behaviors = catalog.behaviors.size();
  std::vector<std::uint32_t> domain_sizes;
  const std::vector<ConstraintCount> counts = count_constraints(catalog);
  for (std::size_t index = 0; index < catalog.group_count(); ++index) {
    const ConstraintCount& constraints = counts[index];
    add(summary.constraints, constraints);
    Summary::Group& group = summary.groups.emplace_back();
    group.constraints = constraints.total();
    for (TaskId task = catalog.group_tasks[index]; task < catalog.group_tasks[index + 1]; ++task) {
      group.tasks.emplace_back(catalog.name_of_task(task));
      domain_sizes.push_back(static_cast<std::uint32_t>(1 + catalog.values[task].size()));
    }
  }
  summary.search_space = search_space(domain_sizes);
  return summary;
}

}  // namespace cbc
