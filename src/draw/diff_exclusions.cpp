#include "draw/diff_exclusions.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace cbc::draw {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;  // ascending
using Tasks = std::vector<std::uint32_t>;              // ascending

/// Tasks of a list, each with a mark.
using List = std::vector<std::pair<std::uint32_t, Mark>>;

/// The pairs of one kind.
class Pairs {
 public:
  void add(std::uint32_t a, std::uint32_t b) {
    pairs_.insert(std::minmax(a, b));
    tasks_.insert({a, b});
  }

  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const {
    return pairs_.contains(std::minmax(a, b));
  }

  [[nodiscard]] bool has_any_of(std::span<const std::uint32_t> tasks) const {
    return std::any_of(tasks.begin(), tasks.end(), [&](std::uint32_t task) {
      return tasks_.contains(task) && std::any_of(tasks.begin(), tasks.end(), [&](std::uint32_t b) {
               return contains(task, b);
             });
    });
  }

  /// Those of the tasks that are in a pair with each of the others.
  [[nodiscard]] Tasks with_all_of(std::span<const std::uint32_t> tasks) const {
    Tasks found;
    for (const std::uint32_t task : tasks) {
      const bool has_all = std::all_of(tasks.begin(), tasks.end(), [&](std::uint32_t other) {
        return other == task || contains(task, other);
      });
      if (has_all) found.push_back(task);
    }
    return found;
  }

 private:
  std::set<Pair> pairs_;
  std::set<std::uint32_t> tasks_;
};

Tasks without(std::span<const std::uint32_t> tasks, const Tasks& others) {
  Tasks rest;
  std::set_difference(tasks.begin(), tasks.end(), others.begin(), others.end(),
                      std::back_inserter(rest));
  return rest;
}

class Marker {
 public:
  Marker(const CompiledCatalog& before,
         const std::unordered_map<std::string_view, std::uint32_t>& tasks, const CatalogDiff& diff,
         CatalogGraph& graph)
      : before_(before), tasks_(tasks), graph_(graph) {
    for (const CatalogChange& change : diff.changes) {
      if (change.subject != CatalogChange::Subject::exclusion) continue;
      Pairs& pairs = change.kind == CatalogChange::Kind::added ? added_ : removed_;
      pairs.add(tasks_.at(change.task), tasks_.at(change.other_task));
    }
  }

  void run() {
    std::vector<std::size_t> joined;
    for (std::size_t list = 0; list < graph_.exclusions.size(); ++list) {
      if (!mark_added(graph_.exclusions[list])) joined.push_back(list);
    }
    for (std::size_t clique = 0; clique < before_.cliques.size(); ++clique) {
      mark_removed(tasks_of(clique));
    }
    for (const std::size_t list : joined) add_kept(graph_.exclusions[list]);
    write();
  }

 private:
  [[nodiscard]] Tasks tasks_of(std::size_t clique) const {
    Tasks tasks;
    for (const TaskId task : before_.cliques[clique]) {
      tasks.push_back(tasks_.at(before_.name_of_task(task)));
    }
    std::sort(tasks.begin(), tasks.end());
    return tasks;
  }

  /// False if the list is new as a whole, but some of its tasks excluded one another before.
  bool mark_added(std::span<const std::uint32_t> tasks) {
    const Tasks since = added_.with_all_of(tasks);
    const bool is_joined = added_.has_any_of(without(tasks, since));
    List& marked = lists_.emplace_back();
    for (const std::uint32_t task : tasks) {
      const bool is_new = is_joined || std::binary_search(since.begin(), since.end(), task);
      marked.emplace_back(task, is_new ? Mark::added : Mark::plain);
    }
    return !is_joined;
  }

  /// What tasks of an older list still exclude one another in a list that is new as a whole.
  void add_kept(std::span<const std::uint32_t> joined) {
    std::set<std::uint32_t> cliques;
    for (const std::uint32_t task : joined) {
      const auto known = before_.find_task(graph_.tasks[task].name);
      if (!known) continue;
      const auto of_task = before_.task_cliques[before_.task_ids[*known]];
      cliques.insert(of_task.begin(), of_task.end());
    }
    for (const std::uint32_t clique : cliques) {
      const Tasks before = tasks_of(clique);
      Tasks kept;
      std::set_intersection(before.begin(), before.end(), joined.begin(), joined.end(),
                            std::back_inserter(kept));
      if (kept.size() > 1 && find_list(kept, {}) == nullptr) add_list(kept, Mark::plain);
    }
  }

  void mark_removed(const Tasks& tasks) {
    if (!removed_.has_any_of(tasks)) return;
    const Tasks gone = removed_.with_all_of(tasks);
    const Tasks rest = without(tasks, gone);
    const bool is_split = removed_.has_any_of(rest);
    List* const list = is_split || rest.empty() ? nullptr : find_list(rest, gone);
    if (list == nullptr) {
      add_list(tasks, Mark::removed);  // where tasks still exclude one another, other lists say so
    } else {
      for (const std::uint32_t task : gone) list->emplace_back(task, Mark::removed);
    }
  }

  void add_list(const Tasks& tasks, Mark mark) {
    List& list = lists_.emplace_back();
    for (const std::uint32_t task : tasks) list.emplace_back(task, mark);
  }

  [[nodiscard]] bool was_in_pairs_with(std::uint32_t task, const Tasks& others) const {
    return std::all_of(others.begin(), others.end(),
                       [&](std::uint32_t other) { return removed_.contains(task, other); });
  }

  /// The list that has just these tasks and what came to them, if those that are gone from it may
  /// stand there side by side.
  [[nodiscard]] List* find_list(const Tasks& tasks, const Tasks& gone) {
    for (const std::uint32_t place : graph_.exclusions_of_task[tasks.front()]) {
      Tasks present;
      bool is_fit = true;
      for (const auto& [task, mark] : lists_[place]) {
        if (mark == Mark::plain) present.push_back(task);
        if (mark == Mark::removed) is_fit = is_fit && was_in_pairs_with(task, gone);
      }
      if (is_fit && present == tasks) return &lists_[place];
    }
    return nullptr;
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
    graph_.exclusions = std::move(tasks);
    graph_.exclusion_marks = std::move(marks);
  }

  const CompiledCatalog& before_;
  const std::unordered_map<std::string_view, std::uint32_t>& tasks_;
  CatalogGraph& graph_;
  Pairs added_;
  Pairs removed_;
  std::vector<List> lists_;  ///< first those of the graph, then those that are added
};

}  // namespace

void mark_exclusions(const CompiledCatalog& before,
                     const std::unordered_map<std::string_view, std::uint32_t>& tasks,
                     const CatalogDiff& diff, CatalogGraph& graph) {
  Marker(before, tasks, diff, graph).run();
}

}  // namespace cbc::draw
