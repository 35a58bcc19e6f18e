#include <algorithm>

#include "draw/catalog_graph.h"

namespace cbc::draw {
namespace {

void add_behavior(const CompiledCatalog& catalog, std::uint32_t behavior, CatalogGraph& graph) {
  const BehaviorId id = catalog.behavior_ids[behavior];
  CatalogGraph::Behavior& to = graph.behaviors.emplace_back();
  to.name = catalog.behavior_names[behavior];
  to.package = catalog.texts[catalog.behavior_packages[behavior]];
  to.group = catalog.group_of(id);
  const auto by_task = [](const auto& a, const auto& b) { return a.task < b.task; };
  const auto first_performance = static_cast<std::ptrdiff_t>(graph.performances.size());
  for (const ValueId value : catalog.performs[id]) {
    CatalogGraph::Performance& performance = graph.performances.emplace_back();
    performance.behavior = behavior;
    performance.task = catalog.tasks[catalog.task_of(value)].catalog_index;
    performance.suitability = catalog.values.items[value].suitability;
  }
  std::sort(graph.performances.begin() + first_performance, graph.performances.end(), by_task);
  const auto first_requirement = static_cast<std::ptrdiff_t>(graph.requirements.size());
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    CatalogGraph::Requirement& to_add = graph.requirements.emplace_back();
    to_add.behavior = behavior;
    to_add.task = catalog.tasks[requirement.task].catalog_index;
    to_add.minimum_performance = requirement.minimum_performance;
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
    CatalogGraph::Task& to = graph.tasks.emplace_back();
    to.name = catalog.task_names[task];
    to.group = from.group;
    to.minimum_performance = from.minimum_performance;
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
  graph.exclusion_marks.begin = graph.exclusions.begin;
  graph.exclusion_marks.items.resize(graph.exclusions.items.size());
  connect(graph);
  return graph;
}

}  // namespace cbc::draw
