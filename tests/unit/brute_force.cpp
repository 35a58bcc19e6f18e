#include "unit/brute_force.h"

#include <algorithm>
#include <numeric>

namespace cbc::test {
namespace {

/// Behaviors and tasks of the model count from the first ones of the group.
std::size_t behavior_of(const CompiledCatalog& catalog, TaskId task, std::uint32_t index) {
  if (index == none) return oracle::none;
  const BehaviorId first = catalog.group_behaviors[catalog.tasks[task].group];
  return catalog.values[task][index].behavior - first;
}

oracle::CatalogFacts facts_of(const CompiledCatalog& catalog, GroupId group) {
  const TaskId first = catalog.group_tasks[group];
  oracle::Catalog model;
  for (TaskId id = first; id < catalog.group_tasks[group + 1]; ++id) {
    oracle::Task& task = model.tasks.emplace_back();
    task.start_on_request = catalog.tasks[id].start_on_request;
    task.minimum = catalog.tasks[id].minimum_performance;
  }
  for (BehaviorId id = catalog.group_behaviors[group]; id < catalog.group_behaviors[group + 1];
       ++id) {
    oracle::Behavior& behavior = model.behaviors.emplace_back();
    for (const ValueId value : catalog.performs[id]) {
      behavior.performs.push_back(
          {catalog.task_of(value) - first, catalog.values.items[value].suitability});
    }
    for (const CompiledRequirement& requirement : catalog.requirements[id]) {
      behavior.requirements.push_back({requirement.task - first, requirement.minimum_performance});
    }
  }
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    std::vector<std::size_t> list;
    for (const TaskId task : catalog.cliques[clique]) {
      if (catalog.tasks[task].group == group) list.push_back(task - first);
    }
    if (!list.empty()) model.exclusivity.push_back(list);
  }
  oracle::CatalogFacts facts(std::move(model));
  facts.groups.assign(1, std::vector<std::size_t>(facts.catalog.tasks.size()));
  std::iota(facts.groups.front().begin(), facts.groups.front().end(), std::size_t{0});
  return facts;
}

oracle::Problem model_of(const CompiledCatalog& catalog, const Problem& problem) {
  const TaskId first = catalog.group_tasks[problem.group];
  oracle::Problem model;
  for (LocalTask task(0); task < problem.may_stop.size(); ++task) {
    const TaskId id = first + task;
    std::vector<std::size_t>& domain = model.domains.emplace_back();
    for (std::uint32_t index = 0; index < catalog.values[id].size(); ++index) {
      const std::uint32_t word = catalog.words[id] - catalog.words[first] + index / 64;
      if (((problem.domains[word] >> (index % 64)) & 1) != 0) {
        domain.push_back(behavior_of(catalog, id, index));
      }
    }
    if (problem.may_stop[task] != 0) domain.push_back(oracle::none);
    model.before.push_back(behavior_of(catalog, id, problem.present[task]));
  }
  for (const LocalTask task : problem.requests) {
    oracle::ActiveRequest& request = model.requests.emplace_back();
    request.task = task;
  }
  for (const BehaviorId behavior : problem.active) {
    model.active.insert(behavior - catalog.group_behaviors[problem.group]);
  }
  return model;
}

}  // namespace

BruteForce::BruteForce(const CompiledCatalog& catalog, const Problem& problem)
    : first_task_(catalog.group_tasks[problem.group]),
      facts_(facts_of(catalog, problem.group)),
      problem_(model_of(catalog, problem)),
      evaluated_(oracle::enumerate(facts_, problem_)) {
  for (const oracle::Solution& solution : evaluated_) {
    Assignment& assignment = solutions_.emplace_back(solution.values.size(), none);
    for (LocalTask task(0); task < assignment.size(); ++task) {
      const TaskId id = first_task_ + task;
      for (std::uint32_t index = 0; index < catalog.values[id].size(); ++index) {
        if (behavior_of(catalog, id, index) == solution.values[task]) assignment[task] = index;
      }
    }
  }
}

std::optional<Assignment> BruteForce::best(std::size_t among) const {
  if (solutions_.empty()) return std::nullopt;
  const auto end =
      evaluated_.begin() + static_cast<std::ptrdiff_t>(std::min(among, evaluated_.size()));
  return solutions_[static_cast<std::size_t>(
      std::min_element(evaluated_.begin(), end, oracle::is_better) - evaluated_.begin())];
}

bool BruteForce::is_solution(const Assignment& answer) const {
  return std::find(solutions_.begin(), solutions_.end(), answer) != solutions_.end();
}

}  // namespace cbc::test
