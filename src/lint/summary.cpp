#include "lint/summary.h"

#include "compiled/search_space.h"

namespace cbc {

Summary summarize(const CompiledCatalog& catalog) {
  Summary summary;
  summary.tasks = catalog.tasks.size();
  summary.behaviors = catalog.behaviors.size();
  std::vector<std::uint32_t> domain_sizes;
  const std::vector<ConstraintCount> counts = count_constraints(catalog);
  for (std::size_t index = 0; index < catalog.group_count(); ++index) {
    const ConstraintCount& constraints = counts[index];
    summary.constraints.exclusive_pairs += constraints.exclusive_pairs;
    summary.constraints.requirements += constraints.requirements;
    summary.constraints.task_minimums += constraints.task_minimums;
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
