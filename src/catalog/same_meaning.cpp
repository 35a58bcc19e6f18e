#include "catalog/same_meaning.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace cbc {
namespace {

bool same_allowed(const Parameter& a, const Parameter& b) {
  return a.allowed_is_list == b.allowed_is_list && a.allowed_values == b.allowed_values;
}

/// The parameters of a task, without those that repeat the last one of their name.
std::vector<const Parameter*> without_repetitions(const Task& task) {
  std::vector<const Parameter*> parameters;
  std::map<std::string_view, const Parameter*> last;
  for (const Parameter& parameter : task.parameters) {
    const Parameter*& before = last[parameter.name];
    if (before == nullptr || !same_allowed(*before, parameter)) parameters.push_back(&parameter);
    before = &parameter;
  }
  return parameters;
}

bool same_parameters(const Task& a, const Task& b) {
  const std::vector<const Parameter*> of_a = without_repetitions(a);
  const std::vector<const Parameter*> of_b = without_repetitions(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const Parameter* x, const Parameter* y) {
                      return x->name == y->name && same_allowed(*x, *y);
                    });
}

bool same_task(const Task& a, const Task& b) {
  return a.name == b.name && a.implicit == b.implicit && a.execution_goal == b.execution_goal &&
         a.start_on_request == b.start_on_request && a.reactive_start == b.reactive_start &&
         a.timeout == b.timeout && a.minimum_performance == b.minimum_performance &&
         same_parameters(a, b);
}

/// What a behavior requires of each task: the highest of the minimums.
std::map<TaskIndex, Millionths> requirements_of(const Behavior& behavior) {
  std::map<TaskIndex, Millionths> requirements;
  for (const Requirement& requirement : behavior.requirements) {
    Millionths& minimum = requirements[requirement.task];
    minimum = std::max(minimum, requirement.minimum_performance);
  }
  return requirements;
}

bool same_behavior(const Behavior& a, const Behavior& b) {
  const bool same_performs =
      std::equal(a.performs.begin(), a.performs.end(), b.performs.begin(), b.performs.end(),
                 [](const Performance& x, const Performance& y) {
                   return x.task == y.task && x.suitability == y.suitability;
                 });
  return same_performs && a.name == b.name && a.package == b.package && a.timeout == b.timeout &&
         requirements_of(a) == requirements_of(b);
}

/// The tasks of one list, ascending, each once.
using Clique = std::vector<TaskIndex>;

std::set<Clique> cliques_of(const Catalog& catalog) {
  std::set<Clique> cliques;
  for (const ExclusivityList& list : catalog.exclusivity) {
    Clique clique = list.tasks;
    std::sort(clique.begin(), clique.end());
    clique.erase(std::unique(clique.begin(), clique.end()), clique.end());
    if (clique.size() > 1) cliques.insert(std::move(clique));
  }
  return cliques;
}

/// Whether each of some cliques is one of `others`, or a part of one.
bool are_contained(const std::set<Clique>& cliques, const std::set<Clique>& others,
                   std::size_t tasks) {
  std::vector<std::vector<const Clique*>> others_of(tasks);
  for (const Clique& other : others) {
    for (const TaskIndex task : other) others_of[task].push_back(&other);
  }
  return std::all_of(cliques.begin(), cliques.end(), [&](const Clique& clique) {
    if (others.contains(clique)) return true;
    const TaskIndex rarest = *std::min_element(
        clique.begin(), clique.end(),
        [&](TaskIndex a, TaskIndex b) { return others_of[a].size() < others_of[b].size(); });
    return std::any_of(
        others_of[rarest].begin(), others_of[rarest].end(), [&clique](const Clique* other) {
          return std::includes(other->begin(), other->end(), clique.begin(), clique.end());
        });
  });
}

}  // namespace

bool same_meaning(const Catalog& a, const Catalog& b) {
  if (!std::equal(a.tasks.begin(), a.tasks.end(), b.tasks.begin(), b.tasks.end(), same_task)) {
    return false;
  }
  if (!std::equal(a.behaviors.begin(), a.behaviors.end(), b.behaviors.begin(), b.behaviors.end(),
                  same_behavior)) {
    return false;
  }
  const std::set<Clique> of_a = cliques_of(a);
  const std::set<Clique> of_b = cliques_of(b);
  return are_contained(of_a, of_b, a.tasks.size()) && are_contained(of_b, of_a, a.tasks.size());
}

}  // namespace cbc
