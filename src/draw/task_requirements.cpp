#include "draw/task_requirements.h"

#include <algorithm>
#include <map>

namespace cbc::draw {
namespace {

void count(const CatalogGraph::Requirement& requirement, TaskRequirement& sum) {
  const Millionths minimum = requirement.minimum_performance;
  sum.lowest = sum.requiring == 0 ? minimum : std::min(sum.lowest, minimum);
  sum.highest = std::max(sum.highest, minimum);
  sum.is_faulty |= requirement.is_faulty;
  ++sum.requiring;
}

}  // namespace

std::vector<TaskRequirement> task_requirements(const CatalogGraph& graph, const Part& part) {
  std::vector<TaskRequirement> all;
  for (const std::uint32_t task : part.tasks) {
    std::uint32_t behaviors = 0;
    std::map<std::uint32_t, TaskRequirement> by_target;
    for (const std::uint32_t link : graph.performances_of_task[task]) {
      const std::uint32_t behavior = graph.performances[link].behavior;
      if (!part.has_behavior[behavior]) continue;
      ++behaviors;
      for (const std::uint32_t place : graph.requirements_of_behavior[behavior]) {
        const CatalogGraph::Requirement& requirement = graph.requirements[place];
        if (part.has_task[requirement.task]) count(requirement, by_target[requirement.task]);
      }
    }
    for (auto& [target, sum] : by_target) {
      sum.from = task;
      sum.to = target;
      sum.behaviors = behaviors;
      all.push_back(sum);
    }
  }
  return all;
}

}  // namespace cbc::draw
