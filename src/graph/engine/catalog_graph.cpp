#include "graph/engine/catalog_graph.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <unordered_map>

#include "core/support/graph.h"

namespace cbc::draw {
namespace {

bool was_in_use(Mark mark) { return mark == Mark::active || mark == Mark::stopped; }
bool is_in_use(Mark mark) { return mark == Mark::active || mark == Mark::started; }

bool is_of_use(Mark mark) { return mark == Mark::faint || was_in_use(mark) || is_in_use(mark); }

}  // namespace

Mark mark_of_use(bool was_in_use, bool is_in_use) {
  if (is_in_use) return was_in_use ? Mark::active : Mark::started;
  return was_in_use ? Mark::stopped : Mark::faint;
}

Mark combine(Mark a, Mark b) {
  if (a == b) return a;
  if (a == Mark::faulty || b == Mark::faulty) return Mark::faulty;
  if (a == Mark::faint) return b;
  if (b == Mark::faint) return a;
  if (is_of_use(a) && is_of_use(b)) {
    return mark_of_use(was_in_use(a) || was_in_use(b), is_in_use(a) || is_in_use(b));
  }
  return Mark::changed;
}

Mark presence_of(Mark mark) {
  return mark == Mark::added || mark == Mark::removed ? mark : Mark::plain;
}

Mark use_of(Mark mark) { return is_of_use(mark) ? mark : presence_of(mark); }

std::optional<Mark> join(Mark a, Mark b) {
  const auto either_is = [&](Mark mark) { return a == mark || b == mark; };
  if (either_is(Mark::added) && either_is(Mark::removed)) return std::nullopt;
  if (is_of_use(a) && is_of_use(b)) {
    return mark_of_use(was_in_use(a) && was_in_use(b), is_in_use(a) && is_in_use(b));
  }
  for (const Mark mark : {Mark::faulty, Mark::added, Mark::removed}) {
    if (either_is(mark)) return mark;
  }
  return combine(a, b);
}

std::string_view name_of(Mark mark) {
  constexpr std::string_view names[] = {"",        "",       "faulty",  "added",   "removed",
                                        "changed", "active", "started", "stopped", "unavailable"};
  return names[static_cast<std::size_t>(mark)];
}

namespace {

/// The indices of `items` by key, which is less than `keys`; in order.
template <typename Items, typename Key>
GrowingRows<std::uint32_t> places_by(const Items& items, std::size_t keys, const Key& key) {
  GrowingRows<std::uint32_t> rows;
  rows.begin.assign(keys + 1, 0);
  for (const auto& item : items) ++rows.begin[key(item) + 1];
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  rows.items.resize(items.size());
  std::vector<std::uint32_t> next = rows.begin;
  std::uint32_t place = 0;
  for (const auto& item : items) rows.items[next[key(item)]++] = place++;
  return rows;
}

}  // namespace

std::vector<std::uint32_t> components_of(const CatalogGraph& graph) {
  const auto tasks = static_cast<std::uint32_t>(graph.tasks.size());
  Edges edges;
  const auto add = [&](const auto& links) {
    for (const auto& link : links) edges.emplace_back(tasks + link.behavior, link.task);
  };
  add(graph.performances);
  add(graph.requirements);
  for (std::size_t list = 0; list < graph.exclusions.size(); ++list) {
    for (const std::uint32_t task : graph.exclusions[list]) {
      edges.emplace_back(graph.exclusions[list].front(), task);
    }
  }
  return connected_components(tasks + graph.behaviors.size(), edges);
}

void connect(CatalogGraph& graph) {
  const auto task_of = [](const auto& link) { return link.task; };
  const auto behavior_of = [](const auto& link) { return link.behavior; };
  const std::size_t tasks = graph.tasks.size();
  const std::size_t behaviors = graph.behaviors.size();
  graph.performances_of_task = places_by(graph.performances, tasks, task_of);
  graph.performances_of_behavior = places_by(graph.performances, behaviors, behavior_of);
  graph.requirements_of_task = places_by(graph.requirements, tasks, task_of);
  graph.requirements_of_behavior = places_by(graph.requirements, behaviors, behavior_of);
  graph.exclusions_of_task =
      places_by(graph.exclusions.items, tasks, [](std::uint32_t task) { return task; });
  // From the index of a task in all lists to that of the list.
  for (std::uint32_t& place : graph.exclusions_of_task.items) {
    const auto& begin = graph.exclusions.begin;
    place = static_cast<std::uint32_t>(std::upper_bound(begin.begin(), begin.end(), place) -
                                       begin.begin() - 1);
  }
}

namespace {

void add_behavior(const CompiledCatalog& catalog, std::uint32_t behavior, CatalogGraph& graph) {
  const BehaviorId id = catalog.behavior_ids[behavior];
  CatalogGraph::Behavior& to = graph.behaviors.emplace_back();
  to.name = catalog.behavior_names[behavior];
  to.package = catalog.texts[catalog.behavior_packages[behavior]];
  to.group = catalog.group_of(id);
  to.situation = conditions_of(catalog, id);
  const auto by_task = [](const auto& a, const auto& b) { return a.task < b.task; };
  const auto first_performance = static_cast<std::ptrdiff_t>(graph.performances.size());
  for (const ValueId value : catalog.performs[id]) {
    CatalogGraph::Performance& performance = graph.performances.emplace_back();
    performance.behavior = behavior;
    performance.task = catalog.tasks[catalog.task_of(value)].catalog_index;
    performance.suitability = catalog.values.items[value].suitability;
  }
  std::sort(graph.performances.begin() + first_performance, graph.performances.end(), by_task);
  const auto first_requirement = static_cast<std::ptrdiff_t>(graph.requirements.size());
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    CatalogGraph::Requirement& to_add = graph.requirements.emplace_back();
    to_add.behavior = behavior;
    to_add.task = catalog.tasks[requirement.task].catalog_index;
    to_add.minimum_performance = requirement.minimum_performance;
  }
  std::sort(graph.requirements.begin() + first_requirement, graph.requirements.end(), by_task);
}

}  // namespace

CatalogGraph to_graph(const CompiledCatalog& catalog) {
  CatalogGraph graph;
  graph.file = catalog.file;
  graph.tasks.reserve(catalog.tasks.size());
  for (std::uint32_t task = 0; task < catalog.tasks.size(); ++task) {
    const CompiledTask& from = catalog.tasks[catalog.task_ids[task]];
    CatalogGraph::Task& to = graph.tasks.emplace_back();
    to.name = catalog.task_names[task];
    to.group = from.group;
    to.minimum_performance = from.minimum_performance;
  }
  graph.behaviors.reserve(catalog.behaviors.size());
  graph.performances.reserve(catalog.values.items.size());
  graph.requirements.reserve(catalog.requirements.items.size());
  for (std::uint32_t behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    add_behavior(catalog, behavior, graph);
  }
  const auto add_list = [&](std::span<const TaskId> members, std::uint32_t at_most) {
    std::vector<std::uint32_t> tasks;
    for (const TaskId task : members) tasks.push_back(catalog.tasks[task].catalog_index);
    std::sort(tasks.begin(), tasks.end());
    graph.exclusions.add_row(tasks);
    graph.at_most.push_back(at_most);
  };
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    add_list(catalog.cliques[clique], 1);
  }
  for (std::size_t limit = 0; limit < catalog.limits.size(); ++limit) {
    add_list(catalog.limited[limit], catalog.limits[limit].most);
  }
  graph.exclusion_marks.begin = graph.exclusions.begin;
  graph.exclusion_marks.items.resize(graph.exclusions.items.size());
  connect(graph);
  return graph;
}

namespace {

/// The places in a file that errors point at.
std::set<Range> faulty_ranges(const std::vector<Diagnostic>& findings, const std::string& file) {
  std::set<Range> ranges;
  for (const Diagnostic& finding : findings) {
    if (finding.severity != Severity::error || finding.file != file) continue;
    ranges.insert(finding.range);
    for (const Note& note : finding.notes) {
      if (note.file == file) ranges.insert(note.range);
    }
  }
  ranges.erase(Range{});  // stands for what is not in the file
  return ranges;
}

class ReadingGraph {
 public:
  ReadingGraph(const CatalogReading& reading, const std::vector<Diagnostic>& findings)
      : reading_(reading),
        catalog_(reading.catalog),
        faulty_(faulty_ranges(findings, catalog_.file)) {}

  CatalogGraph run() && {
    graph_.file = catalog_.file;
    add_tasks();
    add_undefined_tasks();
    for (std::uint32_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      add_behavior(behavior);
    }
    add_exclusions();
    add_groups();
    mark_cycles();
    connect(graph_);
    return std::move(graph_);
  }

 private:
  [[nodiscard]] bool is_faulty(const Range& range) const { return faulty_.contains(range); }
  [[nodiscard]] bool has_fault_within(const Range& range) const {
    return std::any_of(faulty_.begin(), faulty_.end(), [&](const Range& fault) {
      return range.begin <= fault.begin && fault.end <= range.end;
    });
  }
  static Mark mark_of(bool is_faulty) { return is_faulty ? Mark::faulty : Mark::plain; }

  void add_tasks() {
    for (const Task& from : catalog_.tasks) {
      CatalogGraph::Task task;
      task.name = from.name;
      task.minimum_performance = from.minimum_performance;
      task.mark = mark_of(is_faulty(from.range) || is_faulty(from.minimum_performance_range) ||
                          (from.start_on_request && from.reactive_start));
      graph_.tasks.push_back(std::move(task));
    }
  }

  void add_undefined_tasks() {
    std::unordered_map<std::string_view, std::uint32_t> known;
    for (const UndefinedTask& undefined : reading_.undefined_tasks) {
      const auto task = static_cast<std::uint32_t>(graph_.tasks.size());
      const auto [entry, is_new] = known.try_emplace(undefined.name, task);
      if (is_new) {
        CatalogGraph::Task& added = graph_.tasks.emplace_back();
        added.name = undefined.name;
        added.is_defined = false;
        added.mark = Mark::faulty;
      }
      if (undefined.behavior) {
        CatalogGraph::Requirement& requirement =
            undefined_requirements_[*undefined.behavior].emplace_back();
        requirement.behavior = *undefined.behavior;
        requirement.task = entry->second;
        requirement.minimum_performance = undefined.minimum_performance;
        requirement.mark = Mark::faulty;
      } else {
        undefined_exclusions_[undefined.list].push_back(entry->second);
      }
    }
  }

  void add_behavior(std::uint32_t index) {
    const Behavior& from = catalog_.behaviors[index];
    const bool lacks_something = from.name.empty() || from.performs.empty();
    CatalogGraph::Behavior& behavior = graph_.behaviors.emplace_back();
    behavior.name = from.name;
    behavior.package = from.package;
    behavior.situation = conditions_of(catalog_, from);
    behavior.mark = mark_of(lacks_something || is_faulty(from.range) ||
                            (from.situation_range && has_fault_within(*from.situation_range)));
    std::map<std::uint32_t, CatalogGraph::Performance> performances;
    for (const Performance& performance : from.performs) {
      const bool is_wrong =
          is_faulty(performance.range) ||
          (performance.suitability_range && is_faulty(*performance.suitability_range));
      CatalogGraph::Performance& to = performances[performance.task];
      to.behavior = index;
      to.task = performance.task;
      to.suitability = performance.suitability;
      to.mark = mark_of(is_wrong);
    }
    for (const auto& [task, performance] : performances) graph_.performances.push_back(performance);

    std::map<std::uint32_t, CatalogGraph::Requirement> requirements;
    const auto add = [&](const CatalogGraph::Requirement& requirement) {
      const auto [entry, is_new] = requirements.try_emplace(requirement.task, requirement);
      if (is_new) return;
      CatalogGraph::Requirement& known = entry->second;
      known.minimum_performance =
          std::max(known.minimum_performance, requirement.minimum_performance);
      known.mark = combine(known.mark, requirement.mark);
    };
    for (const Requirement& requirement : from.requirements) {
      CatalogGraph::Requirement to;
      to.behavior = index;
      to.task = requirement.task;
      to.minimum_performance = requirement.minimum_performance;
      to.mark =
          mark_of(is_faulty(requirement.range) || is_faulty(requirement.minimum_performance_range));
      add(to);
    }
    if (const auto found = undefined_requirements_.find(index);
        found != undefined_requirements_.end()) {
      for (const CatalogGraph::Requirement& requirement : found->second) add(requirement);
    }
    for (const auto& [task, requirement] : requirements) {
      graph_.requirements.push_back(requirement);
    }
  }

  void add_exclusions() {
    // With how many may run, and whether it is faulty.
    std::map<std::pair<std::vector<std::uint32_t>, std::uint32_t>, bool> lists;
    for (std::size_t list = 0; list < catalog_.exclusivity.size(); ++list) {
      const ExclusivityList& from = catalog_.exclusivity[list];
      std::vector<std::uint32_t> tasks = from.tasks;
      if (const auto found = undefined_exclusions_.find(list);
          found != undefined_exclusions_.end()) {
        tasks.insert(tasks.end(), found->second.begin(), found->second.end());
      }
      std::sort(tasks.begin(), tasks.end());
      tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
      if (tasks.size() > 1) lists[{std::move(tasks), from.at_most}] |= is_faulty(from.range);
    }
    for (const auto& [list, is_wrong] : lists) {
      const auto& [tasks, at_most] = list;
      graph_.exclusions.add_row(tasks);
      graph_.at_most.push_back(at_most);
      graph_.exclusion_marks.add_row(std::vector<Mark>(tasks.size(), mark_of(is_wrong)));
    }
  }

  [[nodiscard]] std::uint32_t vertex_of(std::uint32_t behavior) const {
    return static_cast<std::uint32_t>(graph_.tasks.size()) + behavior;
  }

  void add_groups() {
    const std::vector<std::uint32_t> component = components_of(graph_);
    std::uint32_t groups = 0;
    for (std::uint32_t task = 0; task < graph_.tasks.size(); ++task) {
      graph_.tasks[task].group = component[task];
      groups = std::max(groups, component[task] + 1);
    }
    for (std::uint32_t behavior = 0; behavior < graph_.behaviors.size(); ++behavior) {
      const std::uint32_t group = component[vertex_of(behavior)];
      if (group < groups) graph_.behaviors[behavior].group = group;
    }
  }

  /// An edge is on a cycle if both ends are in one strongly connected component.
  void mark_cycles() {
    if (reading_.is_acyclic) return;
    Edges edges;
    for (const auto& link : graph_.performances) {
      edges.emplace_back(link.task, vertex_of(link.behavior));
    }
    for (const auto& link : graph_.requirements) {
      edges.emplace_back(vertex_of(link.behavior), link.task);
    }
    const std::vector<std::uint32_t> component =
        strong_components(graph_.tasks.size() + graph_.behaviors.size(), edges);
    const auto mark = [&](auto& link) {
      if (component[link.task] != component[vertex_of(link.behavior)]) return;
      link.mark = Mark::faulty;
      graph_.tasks[link.task].mark = Mark::faulty;
      graph_.behaviors[link.behavior].mark = Mark::faulty;
    };
    for (auto& link : graph_.performances) mark(link);
    for (auto& link : graph_.requirements) mark(link);
  }

  const CatalogReading& reading_;
  const Catalog& catalog_;
  const std::set<Range> faulty_;
  std::unordered_map<std::uint32_t, std::vector<CatalogGraph::Requirement>> undefined_requirements_;
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> undefined_exclusions_;
  CatalogGraph graph_;
};

}  // namespace

CatalogGraph to_graph(const CatalogReading& reading, const std::vector<Diagnostic>& findings) {
  return ReadingGraph(reading, findings).run();
}

}  // namespace cbc::draw
