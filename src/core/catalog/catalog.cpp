#include "core/catalog/catalog.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/support/graph.h"
#include "runtime/base/text.h"

namespace cbc {

const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task) {
  const Requirement* found = nullptr;
  for (const Requirement& requirement : behavior.requirements) {
    if (requirement.task != task) continue;
    if (found == nullptr || requirement.minimum_performance > found->minimum_performance) {
      found = &requirement;
    }
  }
  return *found;  // NOLINT(clang-analyzer-core.uninitialized.UndefReturn): there is one
}

std::vector<TaskIndex> distinct_tasks(const ExclusivityList& list) {
  std::vector<TaskIndex> tasks = list.tasks;
  std::sort(tasks.begin(), tasks.end());
  tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
  return tasks;
}

namespace {

std::optional<std::size_t> search(const std::vector<std::size_t>& few,
                                  const std::vector<std::size_t>& many) {
  for (const std::size_t list : few) {
    if (std::binary_search(many.begin(), many.end(), list)) return list;
  }
  return std::nullopt;
}

}  // namespace

Exclusions::Exclusions(const Catalog& catalog) : lists_(catalog.tasks.size()) {
  for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
    if (catalog.exclusivity[list].at_most > 1) continue;
    for (const TaskIndex task : catalog.exclusivity[list].tasks) {
      auto& of_task = lists_[task];
      if (of_task.empty() || of_task.back() != list) of_task.push_back(list);
    }
  }
}

std::optional<std::size_t> Exclusions::find(TaskIndex a, TaskIndex b) {
  if (lists_[a].size() > lists_[b].size()) std::swap(a, b);
  if (lists_[a].empty()) return std::nullopt;
  const std::uint64_t pair = (std::uint64_t{a} << 32U) | b;
  const auto [entry, is_new] = known_.try_emplace(pair);
  if (is_new) entry->second = search(lists_[a], lists_[b]);
  return entry->second;
}

std::optional<std::size_t> Exclusions::find_for_all(const Behavior& behavior, TaskIndex task) {
  std::optional<std::size_t> first;
  for (const Performance& performance : behavior.performs) {
    // A behavior that requires its own task is part of a cycle, which is another finding.
    if (performance.task == task) return std::nullopt;
    const auto list = find(performance.task, task);
    if (!list) return std::nullopt;
    if (!first) first = list;
  }
  return first;
}

namespace {

/// A behavior that performs `task`, and one of its requirements.
struct CycleStep {
  TaskIndex task = 0;
  BehaviorIndex behavior = 0;
  std::size_t requirement = 0;  ///< place in Behavior::requirements
};

/// Tasks that require themselves indirectly: each step's requirement is the task of the next step,
/// and that of the last step the task of the first.
using Cycle = std::vector<CycleStep>;

using Vertex = std::uint32_t;

// The vertices are the tasks, then the behaviors. Edges lead from a task to the behaviors that
// perform it, and from a behavior to the tasks it requires, so there are no more edges than lines
// in the file.
class RequirementGraph {
 public:
  explicit RequirementGraph(const Catalog& catalog)
      : catalog_(catalog), tasks_(static_cast<Vertex>(catalog.tasks.size())) {
    const std::size_t vertices = catalog.tasks.size() + catalog.behaviors.size();
    for (std::size_t index = 0; index < catalog.behaviors.size(); ++index) {
      const auto vertex = static_cast<Vertex>(tasks_ + index);
      for (const Performance& performance : catalog.behaviors[index].performs) {
        edges_.emplace_back(performance.task, vertex);
      }
      for (const Requirement& requirement : catalog.behaviors[index].requirements) {
        edges_.emplace_back(vertex, requirement.task);
      }
    }
    component_ = strong_components(vertices, edges_);
    std::sort(edges_.begin(), edges_.end());
    from_.resize(vertices, unreached);
  }

  /// Whether a requirement is part of a cycle.
  [[nodiscard]] bool has_cycle(BehaviorIndex behavior, TaskIndex task) const {
    return component_[tasks_ + behavior] == component_[task];
  }

  /// For each set of tasks that require one another, a shortest cycle through the first of them, in
  /// catalog order of these.
  std::vector<Cycle> find_cycles() {
    // The component of a task has behaviors only if it contains a cycle.
    std::vector<bool> has_cycle(component_.size(), false);
    for (std::size_t vertex = tasks_; vertex < component_.size(); ++vertex) {
      has_cycle[component_[vertex]] = true;
    }
    std::vector<Cycle> cycles;
    for (Vertex task = 0; task < tasks_; ++task) {
      if (!has_cycle[component_[task]]) continue;
      has_cycle[component_[task]] = false;  // one is enough
      cycles.push_back(to_steps(shortest_cycle_through(task)));
    }
    return cycles;
  }

 private:
  static constexpr Vertex unreached = static_cast<Vertex>(-1);

  // `start` is part of a cycle.
  std::vector<Vertex> shortest_cycle_through(Vertex start) {
    std::vector<Vertex> queue{start};
    for (std::size_t next = 0;; ++next) {
      const Vertex vertex = queue[next];
      for (auto edge = std::lower_bound(edges_.begin(), edges_.end(), std::pair(vertex, Vertex{0}));
           edge != edges_.end() && edge->first == vertex; ++edge) {
        const Vertex target = edge->second;
        if (target == start) return path_to(start, vertex);
        if (component_[target] != component_[start] || from_[target] != unreached) continue;
        from_[target] = vertex;
        queue.push_back(target);
      }
    }
  }

  [[nodiscard]] std::vector<Vertex> path_to(Vertex start, Vertex end) const {
    std::vector<Vertex> path{end};
    while (path.back() != start) path.push_back(from_[path.back()]);
    std::reverse(path.begin(), path.end());
    return path;
  }

  [[nodiscard]] Cycle to_steps(const std::vector<Vertex>& path) const {
    Cycle cycle;
    for (std::size_t i = 0; i + 1 < path.size(); i += 2) {
      const Vertex next = i + 2 < path.size() ? path[i + 2] : path[0];
      const BehaviorIndex behavior = path[i + 1] - tasks_;
      const auto& requirements = catalog_.behaviors[behavior].requirements;
      const auto found =
          std::find_if(requirements.begin(), requirements.end(),
                       [next](const Requirement& requirement) { return requirement.task == next; });
      cycle.push_back({path[i], behavior, static_cast<std::size_t>(found - requirements.begin())});
    }
    return cycle;
  }

  const Catalog& catalog_;
  Vertex tasks_;
  Edges edges_;  // sorted
  std::vector<Vertex> component_;
  std::vector<Vertex> from_;  // by vertex that was reached: the one before it
};

// Longer cycles are shown by their first steps.
constexpr std::size_t longest_chain = 10;

}  // namespace

std::vector<std::vector<bool>> requirements_in_cycles(const Catalog& catalog) {
  const RequirementGraph graph(catalog);
  std::vector<std::vector<bool>> in_cycle(catalog.behaviors.size());
  for (BehaviorIndex index = 0; index < catalog.behaviors.size(); ++index) {
    for (const Requirement& requirement : catalog.behaviors[index].requirements) {
      in_cycle[index].push_back(graph.has_cycle(index, requirement.task));
    }
  }
  return in_cycle;
}

void check_requirement_cycles(const Catalog& catalog, Reporter& reporter) {
  for (const Cycle& cycle : RequirementGraph(catalog).find_cycles()) {
    std::string chain;
    std::vector<Note> notes;
    for (const CycleStep& step : cycle) {
      const Behavior& behavior = catalog.behaviors[step.behavior];
      const Requirement& requirement = behavior.requirements[step.requirement];
      const std::string task = quote(catalog.tasks[step.task].name);
      if (notes.size() < longest_chain) chain += task + " -> ";
      notes.push_back(reporter.note(
          requirement.range, describe(behavior) + ", which performs " + task + ", requires " +
                                 quote(catalog.tasks[requirement.task].name)));
    }
    if (cycle.size() > longest_chain) chain += "... -> ";
    chain += quote(catalog.tasks[cycle.front().task].name);
    const Range place = notes.front().range;
    reporter.report(rule::requirement_cycle, place, "tasks require one another: " + chain,
                    std::move(notes));
  }
}

void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter) {
  Exclusions exclusions(catalog);
  std::unordered_set<TaskIndex> reported;
  for (const Behavior& behavior : catalog.behaviors) {
    if (behavior.performs.empty()) continue;
    reported.clear();
    for (const Requirement& requirement : behavior.requirements) {
      const auto list = exclusions.find_for_all(behavior, requirement.task);
      if (!list || !reported.insert(requirement.task).second) continue;
      const std::string own =
          behavior.performs.size() == 1
              ? quote(catalog.tasks[behavior.performs.front().task].name) + ", the task it performs"
              : std::string("every task it performs");
      reporter.report(
          rule::exclusive_requirement, requirement.range,
          describe(behavior) + " requires " + quote(catalog.tasks[requirement.task].name) +
              ", which excludes " + own,
          {reporter.note(catalog.exclusivity[*list].range, "mutually exclusive by this list")});
    }
  }
}

namespace {

/// The parameters of a task, without those that repeat the previous one of the same name.
std::vector<const Parameter*> without_repetitions(const Task& task) {
  std::vector<const Parameter*> parameters;
  std::map<std::string_view, const Parameter*> last;
  for (const Parameter& parameter : task.parameters) {
    const Parameter*& before = last[parameter.name];
    if (before == nullptr || !allow_the_same(*before, parameter)) parameters.push_back(&parameter);
    before = &parameter;
  }
  return parameters;
}

bool same_parameters(const Task& a, const Task& b) {
  const std::vector<const Parameter*> of_a = without_repetitions(a);
  const std::vector<const Parameter*> of_b = without_repetitions(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const Parameter* x, const Parameter* y) {
                      return x->name == y->name && allow_the_same(*x, *y);
                    });
}

bool same_task(const Task& a, const Task& b) {
  return a.name == b.name && a.implicit == b.implicit && a.execution_goal == b.execution_goal &&
         a.start_on_request == b.start_on_request && a.reactive_start == b.reactive_start &&
         a.timeout == b.timeout && a.minimum_performance == b.minimum_performance &&
         a.rules == b.rules && same_parameters(a, b);
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

/// The values of each variable in which a behavior fits.
std::map<std::uint32_t, std::vector<std::uint32_t>> conditions_of(const Behavior& behavior) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> conditions;
  for (const Condition& condition : behavior.situation) {
    conditions[condition.variable] = condition.values;
  }
  return conditions;
}

bool same_behavior(const Behavior& a, const Behavior& b) {
  const bool same_performs =
      std::equal(a.performs.begin(), a.performs.end(), b.performs.begin(), b.performs.end(),
                 [](const Performance& x, const Performance& y) {
                   return x.task == y.task && x.suitability == y.suitability;
                 });
  return same_performs && a.name == b.name && a.package == b.package && a.timeout == b.timeout &&
         a.retry == b.retry && requirements_of(a) == requirements_of(b) &&
         conditions_of(a) == conditions_of(b);
}

bool same_variable(const Variable& a, const Variable& b) {
  return a.name == b.name && a.is_boolean == b.is_boolean && a.values == b.values;
}

/// The tasks of one list, ascending, each once.
using Clique = std::vector<TaskIndex>;

std::set<Clique> cliques_of(const Catalog& catalog) {
  std::set<Clique> cliques;
  for (const ExclusivityList& list : catalog.exclusivity) {
    if (list.at_most > 1) continue;
    Clique clique = distinct_tasks(list);
    if (clique.size() > 1) cliques.insert(std::move(clique));
  }
  return cliques;
}

/// The lists that let several tasks run, and restrict them.
std::set<std::pair<Clique, std::uint32_t>> limits_of(const Catalog& catalog) {
  std::set<std::pair<Clique, std::uint32_t>> limits;
  for (const ExclusivityList& list : catalog.exclusivity) {
    Clique tasks = distinct_tasks(list);
    if (list.at_most > 1 && tasks.size() > list.at_most) {
      limits.emplace(std::move(tasks), list.at_most);
    }
  }
  return limits;
}

/// Whether each clique is contained in one of `others`.
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
                  same_behavior) ||
      !std::equal(a.variables.begin(), a.variables.end(), b.variables.begin(), b.variables.end(),
                  same_variable)) {
    return false;
  }
  const std::set<Clique> of_a = cliques_of(a);
  const std::set<Clique> of_b = cliques_of(b);
  return limits_of(a) == limits_of(b) && are_contained(of_a, of_b, a.tasks.size()) &&
         are_contained(of_b, of_a, a.tasks.size());
}

}  // namespace cbc
