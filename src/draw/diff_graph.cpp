#include "draw/diff_graph.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "diff/attribute_text.h"
#include "draw/diff_exclusions.h"

namespace cbc::draw {
namespace {

using ChangeKind = CatalogChange::Kind;
using ChangeSubject = CatalogChange::Subject;
using Places = std::unordered_map<std::string_view, std::uint32_t>;

Mark mark_of(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::removed:
      return Mark::removed;
    case ChangeKind::added:
      return Mark::added;
    case ChangeKind::changed:
      break;
  }
  return Mark::changed;
}

template <typename Link>
std::pair<std::uint32_t, std::uint32_t> place_of(const Link& link) {
  return {link.behavior, link.task};
}

/// 0 if there is none.
Millionths degree_of(const AttributeValue& value) {
  const Millionths* const degree = std::get_if<Millionths>(&value);
  return degree == nullptr ? 0 : *degree;
}

/// Empty if there is none.
std::string_view package_before(const CatalogChange& change) {
  for (const AttributeChange& attribute : change.attributes) {
    if (attribute.name == "package") return std::get<std::string>(attribute.before);
  }
  return {};
}

class Union {
 public:
  Union(const CompiledCatalog& before, const CompiledCatalog& after, const CatalogDiff& diff)
      : before_(before),
        diff_(diff),
        graph_(to_graph(after)),
        performances_(graph_.performances.size()),
        requirements_(graph_.requirements.size()) {
    for (const auto& task : graph_.tasks) tasks_.emplace(task.name, tasks_.size());
    for (const auto& behavior : graph_.behaviors) {
      behaviors_.emplace(behavior.name, behaviors_.size());
    }
  }

  CatalogGraph run() && {
    for (const CatalogChange& change : diff_.changes) {
      switch (change.subject) {
        case ChangeSubject::task:
          mark_task(change);
          break;
        case ChangeSubject::behavior:
          mark_behavior(change);
          break;
        case ChangeSubject::performs:
          mark_performance(change);
          break;
        case ChangeSubject::requirement:
          mark_requirement(change);
          break;
        case ChangeSubject::exclusion:
          break;  // all at once
      }
    }
    sort(graph_.performances);
    sort(graph_.requirements);
    mark_exclusions(before_, tasks_, diff_, graph_);
    find_groups();
    connect(graph_);
    return std::move(graph_);
  }

 private:
  /// Of what the newer catalog no longer has: the first group of what it was connected with.
  void find_groups() {
    const std::vector<std::uint32_t> components = components_of(graph_);
    std::vector<std::uint32_t> groups(components.size(),
                                      none);  // by component; none is the greatest
    for (std::size_t task = 0; task < graph_.tasks.size(); ++task) {
      std::uint32_t& group = groups[components[task]];
      group = std::min(group, graph_.tasks[task].group);
    }
    const auto fill_in = [&](auto& things, std::size_t first) {
      for (std::size_t i = 0; i < things.size(); ++i) {
        if (things[i].group == none) things[i].group = groups[components[first + i]];
      }
    };
    fill_in(graph_.tasks, 0);
    fill_in(graph_.behaviors, graph_.tasks.size());
  }

  /// Of what both have: what has changed. Of others, that is said by the word.
  static std::vector<std::string> notes_of(const CatalogChange& change) {
    if (change.kind != ChangeKind::changed) return {std::string(cbc::name_of(change.kind))};
    std::vector<std::string> notes;
    for (const AttributeChange& attribute : change.attributes) {
      notes.push_back(describe(change, attribute));
    }
    return notes;
  }

  void mark_task(const CatalogChange& change) {
    if (change.kind == ChangeKind::removed) {
      tasks_.emplace(change.task, graph_.tasks.size());
      CatalogGraph::Task& task = graph_.tasks.emplace_back();
      task.name = change.task;
      task.group = none;
    }
    CatalogGraph::Task& task = graph_.tasks[tasks_.at(change.task)];
    task.mark = mark_of(change.kind);
    task.notes = notes_of(change);
  }

  void mark_behavior(const CatalogChange& change) {
    if (change.kind == ChangeKind::removed) {
      behaviors_.emplace(change.behavior, graph_.behaviors.size());
      CatalogGraph::Behavior& removed = graph_.behaviors.emplace_back();
      removed.name = change.behavior;
      removed.package = package_before(change);
    }
    CatalogGraph::Behavior& behavior = graph_.behaviors[behaviors_.at(change.behavior)];
    behavior.mark = mark_of(change.kind);
    behavior.notes = notes_of(change);
  }

  /// The link of the change, which is a new one if the newer catalog does not have it. `known` of
  /// the links, the first ones, are in order.
  template <typename Link>
  Link& link_of(const CatalogChange& change, std::vector<Link>& links, std::size_t known) {
    const std::uint32_t behavior = behaviors_.at(change.behavior);
    const std::uint32_t task = tasks_.at(change.task);
    if (change.kind == ChangeKind::removed) {
      Link& link = links.emplace_back();
      link.behavior = behavior;
      link.task = task;
      link.mark = Mark::removed;
      return link;
    }
    const auto end = links.begin() + static_cast<std::ptrdiff_t>(known);
    Link& link = *std::lower_bound(
        links.begin(), end, std::pair(behavior, task),
        [](const Link& one, const auto& sought) { return place_of(one) < sought; });
    link.mark = mark_of(change.kind);
    return link;
  }

  void mark_performance(const CatalogChange& change) {
    CatalogGraph::Performance& link = link_of(change, graph_.performances, performances_);
    const Millionths before = degree_of(change.attributes.front().before);
    if (change.kind == ChangeKind::removed) link.suitability = before;
    if (change.kind == ChangeKind::changed) link.before = before;
  }

  /// A requirement without a minimum performance has no attribute that could differ.
  void mark_requirement(const CatalogChange& change) {
    CatalogGraph::Requirement& link = link_of(change, graph_.requirements, requirements_);
    const Millionths before =
        change.attributes.empty() ? 0 : degree_of(change.attributes.front().before);
    if (change.kind == ChangeKind::removed) link.minimum_performance = before;
    if (change.kind == ChangeKind::changed) link.before = before;
  }

  template <typename Link>
  static void sort(std::vector<Link>& links) {
    std::sort(links.begin(), links.end(),
              [](const Link& a, const Link& b) { return place_of(a) < place_of(b); });
  }

  const CompiledCatalog& before_;
  const CatalogDiff& diff_;
  CatalogGraph graph_;
  Places tasks_;
  Places behaviors_;
  std::size_t performances_;  ///< of the newer catalog
  std::size_t requirements_;
};

}  // namespace

CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                      const CatalogDiff& diff) {
  return Union(before, after, diff).run();
}

}  // namespace cbc::draw
