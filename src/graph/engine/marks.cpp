#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "graph/engine/catalog_graph.h"
#include "runtime/base/text.h"
#include "versions/difference/catalog_diff.h"

namespace cbc::draw {
namespace {

/// The behavior of each task that runs, and whether each behavior is active.
struct Use {
  Use(const CatalogGraph& graph, const std::vector<RunState::RunningTask>& running)
      : behavior_of_task(graph.tasks.size(), none), is_active(graph.behaviors.size()) {
    for (const RunState::RunningTask& one : running) {
      behavior_of_task[one.task] = one.behavior;
      is_active[one.behavior] = true;
    }
  }
  [[nodiscard]] bool is_running(std::uint32_t task) const { return behavior_of_task[task] != none; }

  std::vector<std::uint32_t> behavior_of_task;
  std::vector<bool> is_active;
};

std::string describe(const RunState::Change& change) {
  std::string text = change.is_activation ? "activat" : "deactivat";
  return change.is_successful ? text + "ed" : text + "ion failed";
}

class StateMarker {
 public:
  StateMarker(CatalogGraph& graph, const RunState& state)
      : graph_(graph), state_(state), before_(graph, state.before), now_(graph, state.running) {}

  void run() {
    mark_tasks();
    mark_behaviors();
    mark_links();
    mark_exclusions();
  }

 private:
  [[nodiscard]] Mark mark_of_task(std::uint32_t task) const {
    return mark_of_use(before_.is_running(task), now_.is_running(task));
  }
  [[nodiscard]] Mark mark_of_behavior(std::uint32_t behavior) const {
    return mark_of_use(before_.is_active[behavior], now_.is_active[behavior]);
  }

  void mark_tasks() {
    for (std::uint32_t task = 0; task < graph_.tasks.size(); ++task) {
      CatalogGraph::Task& marked = graph_.tasks[task];
      marked.mark = mark_of_task(task);
      if (marked.mark == Mark::started || marked.mark == Mark::stopped) {
        marked.notes.emplace_back(name_of(marked.mark));
      }
    }
    for (const RunState::RunningTask& one : state_.running) {
      CatalogGraph::Task& task = graph_.tasks[one.task];
      task.priority = one.priority;
      if (one.priority) {
        const std::string origin = *one.priority == 0 ? "reactive start" : "request";
        task.notes.push_back(origin + ", priority " + std::to_string(*one.priority));
      } else if (is_required(one.task)) {
        task.notes.emplace_back("required");
      }
    }
  }

  [[nodiscard]] bool is_required(std::uint32_t task) const {
    const auto requirements = graph_.requirements_of_task[task];
    return std::any_of(requirements.begin(), requirements.end(), [&](std::uint32_t place) {
      return now_.is_active[graph_.requirements[place].behavior];
    });
  }

  void mark_behaviors() {
    for (std::uint32_t behavior = 0; behavior < graph_.behaviors.size(); ++behavior) {
      graph_.behaviors[behavior].mark = mark_of_behavior(behavior);
    }
    if (state_.finished) graph_.behaviors[*state_.finished].notes.emplace_back("finished");
    for (std::size_t place = 0; place < state_.changes.size(); ++place) {
      const RunState::Change& change = state_.changes[place];
      CatalogGraph::Behavior& behavior = graph_.behaviors[change.behavior];
      behavior.notes.push_back(std::to_string(place + 1) + ". " + describe(change));
      // It was restarted, or had finished.
      const bool is_new = change.is_activation && change.is_successful && !change.is_undoing;
      if (is_new && behavior.mark == Mark::active) behavior.mark = Mark::started;
    }
    for (const std::uint32_t place : state_.unavailable) note_hindrance(place, "unavailable");
    for (const RunState::Misfit& misfit : state_.misfits) {
      note_hindrance(misfit.behavior, "does not fit: " + misfit.why);
    }
    for (const std::uint32_t place : state_.faulty) note_hindrance(place, "faulty");
  }

  void note_hindrance(std::uint32_t place, std::string note) {
    CatalogGraph::Behavior& behavior = graph_.behaviors[place];
    behavior.notes.push_back(std::move(note));
    if (behavior.mark == Mark::faint) behavior.mark = Mark::unavailable;
  }

  void mark_links() {
    for (CatalogGraph::Performance& link : graph_.performances) {
      link.mark = mark_of_use(before_.behavior_of_task[link.task] == link.behavior,
                              now_.behavior_of_task[link.task] == link.behavior);
    }
    for (CatalogGraph::Requirement& link : graph_.requirements) {
      link.mark = mark_of_behavior(link.behavior);
    }
  }

  /// Lines to tasks that have no part in the state are faint.
  void mark_exclusions() {
    for (std::size_t place = 0; place < graph_.exclusions.items.size(); ++place) {
      const bool is_idle = mark_of_task(graph_.exclusions.items[place]) == Mark::faint;
      graph_.exclusion_marks.items[place] = is_idle ? Mark::faint : Mark::plain;
    }
  }

  CatalogGraph& graph_;
  const RunState& state_;
  const Use before_;
  const Use now_;
};

}  // namespace

void mark_state(CatalogGraph& graph, const RunState& state) { StateMarker(graph, state).run(); }

namespace {

using Tasks = std::vector<std::uint32_t>;  // ascending

/// Tasks of a list, each with a mark.
using List = std::vector<std::pair<std::uint32_t, Mark>>;

/// Marks what has changed in the lists of exclusive tasks of a graph, which are those of the newer
/// catalog, and adds what the older one alone excludes. `tasks` finds the tasks of both catalogs in
/// the graph by name.
///
/// Of a list with a pair that is new or gone, the tasks that it shares with a list of the other
/// catalog, the one with which it shares most, are unmarked, and the others are added or removed.
class ExclusionMarker {
 public:
  ExclusionMarker(const CompiledCatalog& before,
                  const std::unordered_map<std::string_view, std::uint32_t>& tasks,
                  const CatalogDiff& diff, CatalogGraph& graph)
      : graph_(graph) {
    for (const CatalogChange& change : diff.changes) {
      if (change.subject != CatalogChange::Subject::exclusion) continue;
      auto& pairs = change.kind == CatalogChange::Kind::added ? added_ : removed_;
      pairs.insert(std::minmax(tasks.at(change.task), tasks.at(change.other_task)));
    }
    for (std::size_t list = 0; list < graph.exclusions.size(); ++list) {
      const auto row = graph.exclusions[list];
      if (graph.at_most[list] > 1) {
        limits_.emplace_back(Tasks(row.begin(), row.end()), graph.at_most[list]);
      } else {
        new_lists_.emplace_back(row.begin(), row.end());
      }
    }
    for (std::size_t clique = 0; clique < before.cliques.size(); ++clique) {
      Tasks& list = old_lists_.emplace_back();
      for (const TaskId task : before.cliques[clique]) {
        list.push_back(tasks.at(before.name_of_task(task)));
      }
      std::sort(list.begin(), list.end());
    }
  }

  void run() {
    if (added_.empty() && removed_.empty()) return;
    for (const Tasks& list : new_lists_) {
      const Nearest old = has_any_of(added_, list) ? nearest(list, old_lists_) : Nearest{0, list};
      List& marked = lists_.emplace_back();
      for (const std::uint32_t task : list) {
        const bool is_kept = std::binary_search(old.shared.begin(), old.shared.end(), task);
        marked.emplace_back(task, is_kept ? Mark::plain : Mark::added);
      }
    }
    for (const Tasks& list : old_lists_) {
      if (has_any_of(removed_, list)) add_removed(list);
    }
    write();
  }

 private:
  using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;  // of tasks, ascending

  /// A list, and the tasks that it shares with another one.
  struct Nearest {
    std::size_t place = 0;
    Tasks shared;
  };

  [[nodiscard]] static bool has_any_of(const Pairs& pairs, const Tasks& tasks) {
    return std::any_of(tasks.begin(), tasks.end(), [&](std::uint32_t task) {
      auto pair = pairs.lower_bound({task, 0});
      for (; pair != pairs.end() && pair->first == task; ++pair) {
        if (std::binary_search(tasks.begin(), tasks.end(), pair->second)) return true;
      }
      return false;
    });
  }

  /// The list that shares most tasks, at least two, with these; none is shared if there is none.
  [[nodiscard]] static Nearest nearest(const Tasks& tasks, const std::vector<Tasks>& lists) {
    Nearest best;
    for (std::size_t place = 0; place < lists.size(); ++place) {
      Tasks shared;
      std::set_intersection(tasks.begin(), tasks.end(), lists[place].begin(), lists[place].end(),
                            std::back_inserter(shared));
      if (shared.size() > std::max<std::size_t>(best.shared.size(), 1)) {
        best = {place, std::move(shared)};
      }
    }
    return best;
  }

  void add_removed(const Tasks& tasks) {
    const Nearest now = nearest(tasks, new_lists_);
    List& list = now.shared.empty() ? lists_.emplace_back() : lists_[now.place];
    for (const std::uint32_t task : tasks) {
      const auto is_it = [task](const auto& member) { return member.first == task; };
      if (std::none_of(list.begin(), list.end(), is_it)) list.emplace_back(task, Mark::removed);
    }
  }

  void write() {
    GrowingRows<std::uint32_t> tasks;
    GrowingRows<Mark> marks;
    for (List& list : lists_) {
      std::sort(list.begin(), list.end());
      for (const auto& [task, mark] : list) {
        tasks.items.push_back(task);
        marks.items.push_back(mark);
      }
      tasks.close_row();
      marks.close_row();
    }
    graph_.at_most.assign(lists_.size(), 1);
    for (const auto& [members, at_most] : limits_) {
      tasks.add_row(members);
      marks.add_row(std::vector<Mark>(members.size(), Mark::plain));
      graph_.at_most.push_back(at_most);
    }
    graph_.exclusions = std::move(tasks);
    graph_.exclusion_marks = std::move(marks);
  }

  CatalogGraph& graph_;
  Pairs added_;
  Pairs removed_;
  std::vector<Tasks> new_lists_;
  std::vector<std::pair<Tasks, std::uint32_t>> limits_;  ///< lists of which several may run
  std::vector<Tasks> old_lists_;
  std::vector<List> lists_;  ///< first those of the newer catalog, then those that are added
};

using ChangeKind = CatalogChange::Kind;
using PlaceByName = std::unordered_map<std::string_view, std::uint32_t>;

Mark mark_of(ChangeKind kind) {
  constexpr Mark marks[] = {Mark::removed, Mark::added, Mark::changed};
  return marks[static_cast<std::size_t>(kind)];
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
        case ChangeSubject::variable:
          mark_variable(change);
          break;
        case ChangeSubject::limit:
          break;  // the lists of the newer catalog are drawn
        case ChangeSubject::exclusion:
          break;  // marked together, by ExclusionMarker
      }
    }
    sort(graph_.performances);
    sort(graph_.requirements);
    ExclusionMarker(before_, tasks_, diff_, graph_).run();
    find_groups();
    connect(graph_);
    return std::move(graph_);
  }

 private:
  /// What the newer catalog no longer has gets the first group of what it was connected with.
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

  /// What has changed; for what only one catalog has, the word "added" or "removed".
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
      const std::uint32_t index = before_.find_behavior(change.behavior).value();
      removed.situation = conditions_of(before_, before_.behavior_ids[index]);
    }
    CatalogGraph::Behavior& behavior = graph_.behaviors[behaviors_.at(change.behavior)];
    behavior.mark = mark_of(change.kind);
    behavior.notes = notes_of(change);
  }

  /// Variables have no node: the change of one is noted at the behaviors that name it. (Where it
  /// was added or removed, their conditions have changed.)
  void mark_variable(const CatalogChange& change) {
    if (change.kind != ChangeKind::changed) return;
    for (CatalogGraph::Behavior& behavior : graph_.behaviors) {
      const bool names_it = std::any_of(
          behavior.situation.begin(), behavior.situation.end(),
          [&](const NamedCondition& condition) { return condition.variable == change.variable; });
      if (!names_it || behavior.mark == Mark::removed || behavior.mark == Mark::added) continue;
      behavior.mark = Mark::changed;
      for (std::string& note : notes_of(change)) {
        behavior.notes.push_back(printable(change.variable) + ": " + std::move(note));
      }
    }
  }

  /// The link of a change, a new one if the newer catalog does not have it. The first `known` links
  /// are sorted.
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
  PlaceByName tasks_;
  PlaceByName behaviors_;
  std::size_t performances_;  ///< of the newer catalog
  std::size_t requirements_;
};

}  // namespace

CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                      const CatalogDiff& diff) {
  return Union(before, after, diff).run();
}

}  // namespace cbc::draw
