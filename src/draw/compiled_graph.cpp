#include <algorithm>

#include "draw/catalog_graph.h"

namespace cbc::draw {
namespace {

void add_behavior(const CompiledCatalog& catalog, std::uint32_t behavior, CatalogGraph& graph) {
  const BehaviorId id = catalog.behavior_ids[behavior];
  graph.behaviors.push_back({catalog.behavior_names[behavior],
                             catalog.texts[catalog.behavior_packages[behavior]],
                             catalog.group_of(id), false});
  const auto by_task = [](const auto& a, const auto& b) { return a.task < b.task; };
  const auto first_performance = static_cast<std::ptrdiff_t>(graph.performances.size());
  for (const ValueId value : catalog.performs[id]) {
    graph.performances.push_back({behavior, catalog.tasks[catalog.task_of(value)].catalog_index,
                                  catalog.values.items[value].suitability, false});
  }
  std::sort(graph.performances.begin() + first_performance, graph.performances.end(), by_task);
  const auto first_requirement = static_cast<std::ptrdiff_t>(graph.requirements.size());
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    graph.requirements.push_back({behavior, catalog.tasks[requirement.task].catalog_index,
                                  requirement.minimum_performance, false});
  }
  std::sort(graph.requirements.begin() + first_requirement, graph.requirements.end(), by_task);
}

}  // namespace

CatalogGraph to_graph(const CompiledCatalog& catalog) {
  CatalogGraph graph;
  graph.file = catalog.file;
  graph.tasks.reserve(catalog.tasks.size());
  for (std::uint32_t task = 0; task < catalog.tasks.size(); ++task) {
    const CompiledTask& from = catalog.tasks[catalog.task_ids[task]];
    graph.tasks.push_back(
        {catalog.task_names[task], from.group, from.minimum_performance, true, false});
  }
  graph.behaviors.reserve(catalog.behaviors.size());
  graph.performances.reserve(catalog.values.items.size());
  graph.requirements.reserve(catalog.requirements.items.size());
  for (std::uint32_t behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    add_behavior(catalog, behavior, graph);
  }
  std::vector<std::uint32_t> tasks;
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    tasks.clear();
    for (const TaskId task : catalog.cliques[clique]) {
      tasks.push_back(catalog.tasks[task].catalog_index);
    }
    std::sort(tasks.begin(), tasks.end());
    graph.exclusions.add_row(tasks);
  }
  graph.exclusion_is_faulty.resize(graph.exclusions.size());
  connect(graph);
  return graph;
}

}  // namespace cbc::draw
