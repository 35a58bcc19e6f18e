#include "draw/task_requirements.h"

#include <algorithm>
#include <map>

namespace cbc::draw {
namespace {

/// What a task requires of another one now, and what it required in an older catalog.
struct Sums {
  TaskRequirement present;
  TaskRequirement removed;
};

void count(Mark mark, Millionths minimum, TaskRequirement& sum) {
  const bool is_first = sum.requiring == 0;
  sum.lowest = is_first ? minimum : std::min(sum.lowest, minimum);
  sum.highest = std::max(sum.highest, minimum);
  sum.mark = is_first ? mark : combine(sum.mark, mark);
  ++sum.requiring;
}

TaskRequirement total(const Sums& sums) {
  if (sums.present.requiring == 0) return sums.removed;
  TaskRequirement total = sums.present;
  if (sums.removed.requiring > 0) total.mark = combine(total.mark, Mark::removed);
  return total;
}

}  // namespace

std::vector<TaskRequirement> task_requirements(const CatalogGraph& graph, const Part& part) {
  std::vector<TaskRequirement> all;
  for (const std::uint32_t task : part.tasks) {
    std::uint32_t behaviors = 0;
    std::map<std::uint32_t, Sums> by_target;
    for (const std::uint32_t link : graph.performances_of_task[task]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      if (!part.has_behavior[performance.behavior]) continue;
      if (performance.mark != Mark::removed) ++behaviors;
      const Mark mark = use_of(performance.mark);
      for (const std::uint32_t place : graph.requirements_of_behavior[performance.behavior]) {
        const CatalogGraph::Requirement& requirement = graph.requirements[place];
        if (!part.has_task[requirement.task]) continue;
        const std::optional<Mark> joined = join(mark, requirement.mark);
        if (!joined) continue;
        Sums& sums = by_target[requirement.task];
        count(*joined, requirement.minimum_performance,
              joined == Mark::removed ? sums.removed : sums.present);
      }
    }
    for (const auto& [target, sums] : by_target) {
      TaskRequirement& sum = all.emplace_back(total(sums));
      sum.from = task;
      sum.to = target;
      sum.behaviors = behaviors;
    }
  }
  return all;
}

}  // namespace cbc::draw
