#include <map>
#include <vector>

#include "draw/builder.h"
#include "draw/labels.h"

namespace cbc::draw {
namespace {

using Requirements = std::vector<CatalogGraph::Requirement>;

/// What a behavior requires of each one that may do it, by node.
std::map<std::uint32_t, Requirements> required_behaviors(const Builder& builder,
                                                         std::uint32_t behavior) {
  const CatalogGraph& graph = builder.graph();
  std::map<std::uint32_t, Requirements> required;
  for (const std::uint32_t place : graph.requirements_of_behavior[behavior]) {
    const CatalogGraph::Requirement& requirement = graph.requirements[place];
    for (const std::uint32_t link : graph.performances_of_task[requirement.task]) {
      const std::uint32_t node = builder.node_of_behavior(graph.performances[link].behavior);
      if (node == none) continue;
      const auto mark = join(requirement.mark, use_of(graph.performances[link].mark));
      if (mark) required[node].emplace_back(requirement).mark = *mark;
    }
  }
  return required;
}

/// All of them as one, with the highest minimum performance of those that there are.
CatalogGraph::Requirement combine(const Requirements& requirements) {
  CatalogGraph::Requirement all = requirements.front();
  for (const CatalogGraph::Requirement& one : requirements) {
    const bool is_higher = one.minimum_performance > all.minimum_performance;
    const bool is_there = one.mark != Mark::removed;
    const bool was_there = all.mark != Mark::removed;
    if (is_there && (is_higher || !was_there)) all.minimum_performance = one.minimum_performance;
    all.mark = combine(all.mark, one.mark);
  }
  if (requirements.size() > 1) all.before.reset();
  return all;
}

}  // namespace

void draw_behavior_view(Builder& builder) {
  builder.add_behaviors();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    for (const auto& [node, requirements] : required_behaviors(builder, behavior)) {
      const CatalogGraph::Requirement requirement = combine(requirements);
      Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_behavior(behavior), node,
                                    requirement.mark);
      if (requirement.minimum_performance > 0) edge.degree = requirement.minimum_performance;
      edge.label = label_of(requirement);
    }
  }
}

}  // namespace cbc::draw
