#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/text.h"
#include "catalog/catalog.h"
#include "catalog/draft.h"
#include "diagnostic/rules.h"
#include "support/graph.h"

namespace cbc {
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
    // What a behavior requires of itself is a cycle.
    if (performance.task == task) return std::nullopt;
    const auto list = find(performance.task, task);
    if (!list) return std::nullopt;
    if (!first) first = list;
  }
  return first;
}

namespace {

using Vertex = std::uint32_t;

// Steps that the search for the shortest cycles may take; enough for every catalog that a person
// writes.
constexpr std::size_t most_work = 100'000'000;

// Vertices are the tasks, then the behaviors; edges go from a task to the behaviors that perform
// it, from a behavior to the tasks it requires. So there are no more edges than lines in the file.
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
    for (const Vertex component : component_) {
      components_ = std::max<std::size_t>(components_, component + 1);
    }
    std::sort(edges_.begin(), edges_.end());
    reached_.resize(vertices, unreached);
    from_.resize(vertices);
  }

  std::vector<Cycle> find_cycles() {
    std::vector<std::vector<Vertex>> members(components_);
    for (Vertex task = 0; task < tasks_; ++task) members[component_[task]].push_back(task);
    std::vector<Cycle> cycles;
    // A component with edges has a behavior besides its tasks.
    std::vector<bool> has_behavior(components_, false);
    for (std::size_t vertex = tasks_; vertex < component_.size(); ++vertex) {
      has_behavior[component_[vertex]] = true;
    }
    for (std::size_t component = 0; component < components_; ++component) {
      if (members[component].empty() || !has_behavior[component]) continue;
      cycles.push_back(shortest_cycle(members[component]));
    }
    std::sort(cycles.begin(), cycles.end(),
              [](const Cycle& a, const Cycle& b) { return a.front().task < b.front().task; });
    return cycles;
  }

 private:
  static constexpr Vertex unreached = static_cast<Vertex>(-1);

  // Of equally short ones the one with the first task in catalog order.
  Cycle shortest_cycle(const std::vector<Vertex>& members) {
    std::vector<Vertex> best;
    for (const Vertex start : members) {
      if (!best.empty() && work_ > most_work) break;
      const std::size_t bound = best.empty() ? component_.size() + 1 : best.size();
      if (auto found = shortest_cycle_through(start, bound)) best = std::move(*found);
      if (best.size() == 2) break;
    }
    return to_steps(best);
  }

  // A path from `start` to an edge back to it, of fewer than `bound` vertices.
  std::optional<std::vector<Vertex>> shortest_cycle_through(Vertex start, std::size_t bound) {
    std::vector<Vertex> queue{start};
    reached_[start] = start;
    std::optional<std::vector<Vertex>> result;
    std::size_t level_end = 1;
    std::size_t length = 1;  // vertices on the path to the present level
    for (std::size_t next = 0; next < queue.size() && !result && length < bound; ++next) {
      if (next == level_end) {
        level_end = queue.size();
        if (++length >= bound) break;
      }
      const Vertex vertex = queue[next];
      for (auto edge = std::lower_bound(edges_.begin(), edges_.end(), std::pair(vertex, Vertex{0}));
           edge != edges_.end() && edge->first == vertex; ++edge) {
        const Vertex target = edge->second;
        ++work_;
        if (component_[target] != component_[start]) continue;
        if (target == start) {
          result = path_to(start, vertex);
          break;
        }
        if (reached_[target] != unreached) continue;
        reached_[target] = start;
        from_[target] = vertex;
        queue.push_back(target);
      }
    }
    for (const Vertex vertex : queue) reached_[vertex] = unreached;
    return result;
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
  std::size_t components_ = 0;
  std::vector<Vertex> reached_;
  std::vector<Vertex> from_;
  std::size_t work_ = 0;
};

}  // namespace

std::vector<Cycle> find_requirement_cycles(const Catalog& catalog) {
  return RequirementGraph(catalog).find_cycles();
}

namespace {

// Longer cycles are shown by their beginning.
constexpr std::size_t longest_chain = 10;

}  // namespace

void check_requirement_cycles(const Catalog& catalog, Reporter& reporter) {
  for (const Cycle& cycle : find_requirement_cycles(catalog)) {
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

}  // namespace cbc
