#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <unordered_map>

#include "draw/catalog_graph.h"
#include "graph/graph.h"

namespace cbc::draw {
namespace {

/// What errors point at in a file.
std::set<Range> faulty_ranges(const std::vector<Diagnostic>& findings, const std::string& file) {
  std::set<Range> ranges;
  for (const Diagnostic& finding : findings) {
    if (finding.severity != Severity::error || finding.file != file) continue;
    ranges.insert(finding.range);
    for (const Note& note : finding.notes) {
      if (note.file == file) ranges.insert(note.range);
    }
  }
  ranges.erase(Range{});  // stands for what the file does not say
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
    behavior.mark = mark_of(lacks_something || is_faulty(from.range));
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
    std::map<std::vector<std::uint32_t>, bool> lists;  // and whether it is faulty
    for (std::size_t list = 0; list < catalog_.exclusivity.size(); ++list) {
      const ExclusivityList& from = catalog_.exclusivity[list];
      std::vector<std::uint32_t> tasks = from.tasks;
      if (const auto found = undefined_exclusions_.find(list);
          found != undefined_exclusions_.end()) {
        tasks.insert(tasks.end(), found->second.begin(), found->second.end());
      }
      std::sort(tasks.begin(), tasks.end());
      tasks.erase(std::unique(tasks.begin(), tasks.end()), tasks.end());
      if (tasks.size() > 1) lists[std::move(tasks)] |= is_faulty(from.range);
    }
    for (const auto& [tasks, is_wrong] : lists) {
      graph_.exclusions.add_row(tasks);
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

  /// Edges within a strongly connected component are those on cycles.
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
