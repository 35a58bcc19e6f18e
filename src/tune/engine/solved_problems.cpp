#include "tune/engine/solved_problems.h"

#include <algorithm>

namespace cbc {
namespace {

/// What tells problems apart, as bytes.
std::string key_of(const Problem& problem) {
  std::string key(reinterpret_cast<const char*>(&problem.group), sizeof problem.group);
  const auto add = [&key](const auto& list) {
    const std::size_t size = list.size();
    key.append(reinterpret_cast<const char*>(&size), sizeof size);
    key.append(reinterpret_cast<const char*>(list.data()), size * sizeof(list[0]));
  };
  add(problem.domains);
  add(problem.may_stop);
  add(problem.present);
  add(problem.requests);
  add(problem.active);
  return key;
}

}  // namespace

void SolvedProblems::add(const Problem& problem, const Assignment* answer) {
  if (!known_.insert(key_of(problem)).second) return;
  list_.push_back({problem, {}});
  if (answer != nullptr) list_.back().answer = *answer;
}

bool may_run(const CompiledCatalog& catalog, const Problem& problem, TaskId task,
             BehaviorId behavior) {
  if (catalog.tasks[task].group != problem.group) return false;
  const std::uint32_t word =
      catalog.words[task] - catalog.words[catalog.group_tasks[problem.group]];
  const auto values = catalog.values[task];
  for (std::uint32_t index = 0; index < values.size(); ++index) {
    if (behavior != none && values[index].behavior != behavior) continue;
    if ((problem.domains[word + index / 64] >> (index % 64) & 1U) != 0) return true;
  }
  return false;
}

bool uses(const CompiledCatalog& catalog, const Problem& problem, const TunableNumber& number) {
  const TaskId first = catalog.group_tasks[problem.group];
  const TaskId end = catalog.group_tasks[problem.group + 1];
  return std::any_of(number.uses.begin(), number.uses.end(), [&](const TunableNumber::Use& use) {
    const TaskId task = catalog.task_ids[use.task];
    if (use.behavior == none) return may_run(catalog, problem, task);
    const BehaviorId behavior = catalog.behavior_ids[use.behavior];
    if (number.kind == TunableNumber::Kind::suitability) {
      return may_run(catalog, problem, task, behavior);
    }
    for (TaskId performed = first; performed < end; ++performed) {
      if (may_run(catalog, problem, performed, behavior)) return true;
    }
    return false;
  });
}

}  // namespace cbc
