#include "report/catalog_numbers.h"

#include <algorithm>

#include "compiled/search_space.h"

namespace cbc {
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

}  // namespace cbc
