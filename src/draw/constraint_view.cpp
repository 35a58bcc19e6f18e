#include <map>

#include "draw/builder.h"
#include "draw/task_requirements.h"

namespace cbc::draw {
namespace {

/// Tasks of one behavior are of one group; a chain of them shows it.
void connect_tasks_of_behaviors(Builder& builder) {
  const CatalogGraph& graph = builder.graph();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    std::uint32_t before = none;
    for (const std::uint32_t link : graph.performances_of_behavior[behavior]) {
      const std::uint32_t node = builder.node_of_task(graph.performances[link].task);
      if (node == none) continue;
      if (before != none) builder.add_edge(EdgeKind::same_behavior, before, node);
      before = node;
    }
  }
}

/// One color a group, but for tasks that are alone in theirs.
void color_groups(std::vector<Node>& tasks) {
  std::map<std::uint32_t, std::uint32_t> sizes;
  for (const Node& task : tasks) ++sizes[task.group];
  std::map<std::uint32_t, std::uint32_t> colors;
  for (Node& task : tasks) {
    if (sizes[task.group] < 2) continue;
    const auto next = static_cast<std::uint32_t>(colors.size());
    task.color = colors.try_emplace(task.group, next).first->second;
  }
}

}  // namespace

void draw_constraint_view(Builder& builder) {
  builder.add_tasks();
  color_groups(builder.diagram().nodes);
  for (const TaskRequirement& requirement : task_requirements(builder.graph(), builder.part())) {
    Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_task(requirement.from),
                                  builder.node_of_task(requirement.to));
    if (requirement.is_faulty) edge.mark = Mark::faulty;
  }
  connect_tasks_of_behaviors(builder);
}

}  // namespace cbc::draw
