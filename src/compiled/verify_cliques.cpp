#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "compiled/verify_parts.h"

namespace cbc::verify {
namespace {

Fault find_member_fault(const CompiledCatalog& catalog, std::uint32_t clique) {
  const auto members = catalog.cliques[clique];
  if (members.size() < 2) {
    return fmt::format("clique {} has {} tasks, expected at least 2", clique, members.size());
  }
  if (members.front() >= catalog.tasks.size()) {
    return fmt::format("clique {} has task {} of {}", clique, members.front(),
                       catalog.tasks.size());
  }
  for (std::size_t i = 1; i < members.size(); ++i) {
    if (members[i] <= members[i - 1]) {
      return fmt::format("the tasks of clique {} do not ascend", clique);
    }
  }
  const std::uint32_t group = catalog.tasks[members.front()].group;
  if (members.back() >= catalog.group_tasks[group + 1]) {
    return fmt::format("clique {} has task {}, which is none of its group {}", clique,
                       members.back(), group);
  }
  return std::nullopt;
}

}  // namespace

Fault find_clique_fault(const CompiledCatalog& catalog) {
  // By task: the first of its places in task_cliques that no clique has come to yet. There are as
  // many places as tasks in cliques.
  std::vector<std::uint32_t> next(catalog.task_cliques.begin.begin(),
                                  catalog.task_cliques.begin.end());
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    if (auto fault = find_member_fault(catalog, clique)) return fault;
    const auto members = catalog.cliques[clique];
    if (clique > 0) {
      const auto before = catalog.cliques[clique - 1];
      if (!std::lexicographical_compare(before.begin(), before.end(), members.begin(),
                                        members.end())) {
        return fmt::format("cliques {} and {} are not in order", clique - 1, clique);
      }
    }
    for (const TaskId task : members) {
      if (next[task] == catalog.task_cliques.begin[task + 1] ||
          catalog.task_cliques.items[next[task]] != clique) {
        return fmt::format("'task_cliques' of task {} is not what the cliques say", task);
      }
      ++next[task];
    }
  }
  return std::nullopt;
}

}  // namespace cbc::verify
