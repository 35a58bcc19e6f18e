#include "draw/builder.h"
#include "draw/labels.h"

namespace cbc::draw {

void draw_full_view(Builder& builder) {
  const CatalogGraph& graph = builder.graph();
  const Part& part = builder.part();
  builder.add_tasks();
  builder.add_behaviors();
  for (const std::uint32_t task : part.tasks) {
    for (const std::uint32_t link : graph.performances_of_task[task]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      if (!part.has_behavior[performance.behavior]) continue;
      Edge& edge =
          builder.add_edge(EdgeKind::performed_by, builder.node_of_task(task),
                           builder.node_of_behavior(performance.behavior), performance.mark);
      edge.degree = performance.suitability;
      edge.label = label_of(performance);
    }
  }
  for (const std::uint32_t behavior : part.behaviors) {
    for (const std::uint32_t link : graph.requirements_of_behavior[behavior]) {
      const CatalogGraph::Requirement& requirement = graph.requirements[link];
      if (!part.has_task[requirement.task]) continue;
      Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_behavior(behavior),
                                    builder.node_of_task(requirement.task), requirement.mark);
      if (requirement.minimum_performance > 0) edge.degree = requirement.minimum_performance;
      edge.label = label_of(requirement);
    }
  }
}

}  // namespace cbc::draw
