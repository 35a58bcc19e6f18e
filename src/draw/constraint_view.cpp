#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "draw/builder.h"
#include "draw/task_requirements.h"

namespace cbc::draw {
namespace {

/// Tasks of one behavior are of one group; a chain of them shows it. What one of two catalogs has
/// is connected to what both have.
void connect_tasks_of_behaviors(Builder& builder) {
  const CatalogGraph& graph = builder.graph();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    std::vector<std::pair<std::uint32_t, Mark>> tasks;  // their nodes
    for (const std::uint32_t link : graph.performances_of_behavior[behavior]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      const std::uint32_t node = builder.node_of_task(performance.task);
      if (node != none) tasks.emplace_back(node, presence_of(performance.mark));
    }
    std::stable_partition(tasks.begin(), tasks.end(),
                          [](const auto& task) { return task.second == Mark::plain; });
    std::size_t before = 0;
    for (std::size_t i = 1; i < tasks.size(); ++i) {
      if (const auto mark = join(tasks[before].second, tasks[i].second)) {
        builder.add_edge(EdgeKind::same_behavior, tasks[before].first, tasks[i].first, *mark);
      }
      if (tasks[i].second == Mark::plain) before = i;
    }
  }
}

/// One color a group, but for tasks that are alone in theirs, or in none.
void color_groups(std::vector<Node>& tasks) {
  std::map<std::uint32_t, std::uint32_t> sizes;
  for (const Node& task : tasks) ++sizes[task.group];
  std::map<std::uint32_t, std::uint32_t> colors;
  for (Node& task : tasks) {
    if (task.group == none || sizes[task.group] < 2) continue;
    const auto next = static_cast<std::uint32_t>(colors.size());
    task.color = colors.try_emplace(task.group, next).first->second;
  }
}

}  // namespace

void draw_constraint_view(Builder& builder) {
  builder.add_tasks();
  color_groups(builder.diagram().nodes);
  for (const TaskRequirement& requirement : task_requirements(builder.graph(), builder.part())) {
    builder.add_edge(EdgeKind::requirement, builder.node_of_task(requirement.from),
                     builder.node_of_task(requirement.to), requirement.mark);
  }
  connect_tasks_of_behaviors(builder);
}

}  // namespace cbc::draw
