#include "ask/conflict/reasons.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace cbc {

std::string_view name_of(Reason::Kind kind) {
  static constexpr std::array<std::string_view, 16> names{
      "priority",    "no_behavior",  "protected",   "exclusive", "at_most", "on_request",
      "requires",    "performance",  "unavailable", "situation", "faulty",  "not_retried",
      "makes_worse", "not_improved", "finished",    "stopped"};
  return names[static_cast<std::size_t>(kind)];
}

RelevantTasks::RelevantTasks(const CompiledCatalog& catalog, GroupId group)
    : catalog_(catalog),
      first_task_(catalog.group_tasks[group]),
      is_relevant_(catalog.group_tasks[group + 1] - first_task_, 0) {}

void RelevantTasks::add(TaskId task) {
  if (contains(task)) return;
  is_relevant_[task - first_task_] = 1;
  tasks_.push_back(task);
}

bool RelevantTasks::close(std::size_t most) {
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < tasks_.size(); ++next) {
    if (tasks_.size() > most) return false;
    for (const Arc& arc : catalog_.arcs[tasks_[next]]) add(arc.target);
  }
  std::sort(tasks_.begin(), tasks_.end());
  return true;
}

std::vector<BehaviorId> RelevantTasks::behaviors() const {
  std::vector<BehaviorId> behaviors;
  for (const TaskId task : tasks_) {
    for (const Value& value : catalog_.values[task]) behaviors.push_back(value.behavior);
  }
  std::sort(behaviors.begin(), behaviors.end());
  behaviors.erase(std::unique(behaviors.begin(), behaviors.end()), behaviors.end());
  return behaviors;
}

void add_exclusions(const CompiledCatalog& catalog, TaskId task, const RelevantTasks& relevant,
                    std::size_t most, std::vector<Reason>& reasons) {
  for (const std::uint32_t clique : catalog.task_cliques[task]) {
    for (const TaskId other : catalog.cliques[clique]) {
      if (reasons.size() >= most) return;
      if (other <= task || !relevant.contains(other)) continue;
      Reason reason;
      reason.kind = Reason::Kind::exclusive;
      reason.task = task;
      reason.other_task = other;
      reason.line = catalog.clique_lines[clique];
      reasons.push_back(reason);
    }
  }
  for (const std::uint32_t limit : catalog.limits_of(task)) {
    if (reasons.size() >= most) return;
    const auto members = catalog.limited[limit];
    const auto first = std::find_if(members.begin(), members.end(),
                                    [&](TaskId member) { return relevant.contains(member); });
    const auto count = std::count_if(members.begin(), members.end(),
                                     [&](TaskId member) { return relevant.contains(member); });
    if (*first != task || static_cast<std::uint32_t>(count) <= catalog.limits[limit].most) continue;
    Reason reason;
    reason.kind = Reason::Kind::limited;
    reason.task = task;
    reason.limit = limit;
    reason.line = catalog.limits[limit].line;
    reasons.push_back(reason);
  }
}

void add_minimum(const CompiledCatalog& catalog, TaskId task, std::vector<Reason>& reasons) {
  const CompiledTask& compiled = catalog.tasks[task];
  if (compiled.minimum_performance == 0) return;
  Reason reason;
  reason.kind = Reason::Kind::performance;
  reason.task = task;
  reason.minimum_performance = compiled.minimum_performance;
  reason.line = compiled.minimum_line;
  reasons.push_back(reason);
}

void add_requirements(const CompiledCatalog& catalog, BehaviorId behavior,
                      std::vector<Reason>& reasons) {
  for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
    Reason reason;
    reason.kind = Reason::Kind::requires_task;
    reason.behavior = behavior;
    reason.task = requirement.task;
    reason.line = catalog.line_of(requirement);
    reasons.push_back(reason);
    if (requirement.minimum_performance == 0) continue;
    reason.kind = Reason::Kind::performance;
    reason.minimum_performance = requirement.minimum_performance;
    reasons.push_back(reason);
  }
}

}  // namespace cbc
