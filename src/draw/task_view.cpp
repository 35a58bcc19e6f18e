#include "draw/builder.h"
#include "draw/labels.h"
#include "draw/names.h"
#include "draw/task_requirements.h"
#include "graph/graph.h"
#include "text/decimal.h"

namespace cbc::draw {
namespace {

/// "1 of 2, ≥ 60 %": how many of the behaviors require the task, and the performance they ask for.
std::string label_of(const TaskRequirement& requirement) {
  std::string label;
  if (requirement.requiring < requirement.behaviors && requirement.mark != Mark::removed) {
    label = std::to_string(requirement.requiring) + " of " + std::to_string(requirement.behaviors);
  }
  if (requirement.highest == 0) return label;
  if (!label.empty()) label += ", ";
  if (requirement.lowest == requirement.highest) return label + at_least(requirement.highest);
  return label + "≥ " + format_decimal(requirement.lowest, 4) + "–" +
         format_percent(requirement.highest);
}

/// Which of them follow from others; what stands out is shown in any case.
std::vector<bool> implied(const Builder& builder,
                          const std::vector<TaskRequirement>& requirements) {
  Edges edges;
  for (const TaskRequirement& requirement : requirements) {
    edges.emplace_back(builder.node_of_task(requirement.from),
                       builder.node_of_task(requirement.to));
  }
  std::vector<bool> result = transitive_edges(builder.part().tasks.size(), edges);
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    const Mark mark = requirements[i].mark;
    if (mark != Mark::plain && mark != Mark::faint) result[i] = false;
  }
  return result;
}

}  // namespace

void draw_task_view(Builder& builder, bool reduce) {
  builder.add_tasks();
  const std::vector<TaskRequirement> requirements =
      task_requirements(builder.graph(), builder.part());
  std::vector<bool> is_left_out(requirements.size());
  if (reduce) is_left_out = implied(builder, requirements);
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    if (is_left_out[i]) continue;
    const TaskRequirement& requirement = requirements[i];
    Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_task(requirement.from),
                                  builder.node_of_task(requirement.to), requirement.mark);
    if (requirement.highest > 0) edge.degree = requirement.highest;
    edge.label = with_sign(requirement.mark, label_of(requirement));
  }
}

}  // namespace cbc::draw
