#include <vector>

#include <fmt/format.h>

#include "compiled/verify_parts.h"
#include "graph/graph.h"

namespace cbc::verify {

Fault find_connection_fault(const CompiledCatalog& catalog) {
  Edges edges;
  edges.reserve(catalog.arcs.items.size() + catalog.cliques.items.size());
  for (const Arc& arc : catalog.arcs.items) edges.emplace_back(arc.source, arc.target);
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    const auto members = catalog.cliques[clique];
    for (const TaskId task : members) edges.emplace_back(members.front(), task);
  }
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const auto values = catalog.performs[behavior];
    if (values.size() == 1) continue;
    for (const ValueId value : values) {
      edges.emplace_back(catalog.task_of(values.front()), catalog.task_of(value));
    }
  }
  // Components are counted by their first task, and so are groups.
  const std::vector<std::uint32_t> components = connected_components(catalog.tasks.size(), edges);
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (components[task] == catalog.tasks[task].group) continue;
    return fmt::format("task {} is not connected with the first task of its group {}", task,
                       catalog.tasks[task].group);
  }
  return std::nullopt;
}

}  // namespace cbc::verify
