#include <map>

#include "draw/builder.h"
#include "draw/names.h"

namespace cbc::draw {
namespace {

/// What a behavior requires of each one that may do it.
std::map<std::uint32_t, CatalogGraph::Requirement> required_behaviors(const Builder& builder,
                                                                      std::uint32_t behavior) {
  const CatalogGraph& graph = builder.graph();
  std::map<std::uint32_t, CatalogGraph::Requirement> required;
  for (const std::uint32_t place : graph.requirements_of_behavior[behavior]) {
    const CatalogGraph::Requirement& requirement = graph.requirements[place];
    for (const std::uint32_t link : graph.performances_of_task[requirement.task]) {
      const std::uint32_t node = builder.node_of_behavior(graph.performances[link].behavior);
      if (node == none) continue;
      CatalogGraph::Requirement& known = required.try_emplace(node, requirement).first->second;
      known.minimum_performance =
          std::max(known.minimum_performance, requirement.minimum_performance);
      known.is_faulty |= requirement.is_faulty;
    }
  }
  return required;
}

}  // namespace

void draw_behavior_view(Builder& builder) {
  builder.add_behaviors();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    for (const auto& [node, requirement] : required_behaviors(builder, behavior)) {
      Edge& edge =
          builder.add_edge(EdgeKind::requirement, builder.node_of_behavior(behavior), node);
      if (requirement.minimum_performance > 0) {
        edge.degree = requirement.minimum_performance;
        edge.label = at_least(requirement.minimum_performance);
      }
      if (requirement.is_faulty) edge.mark = Mark::faulty;
    }
  }
}

}  // namespace cbc::draw
