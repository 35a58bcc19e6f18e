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

/// Pairs of one kind, and which of them are drawn.
struct Pairs {
  std::set<Pair> all;
  std::set<Pair> drawn;

  [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const {
    return all.contains(std::minmax(a, b));
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

  void draw(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others) {
    for (const std::uint32_t a : some) {
      for (const std::uint32_t b : others) {
        if (contains(a, b)) drawn.insert(std::minmax(a, b));
      }
    }
  }
};

class Marker {
 public:
  Marker(const CompiledCatalog& before,
         const std::unordered_map<std::string_view, std::uint32_t>& tasks, const CatalogDiff& diff,
         CatalogGraph& graph)
      : before_(before), tasks_(tasks), graph_(graph) {
    for (const CatalogChange& change : diff.changes) {
      if (change.subject != CatalogChange::Subject::exclusion) continue;
      Pairs& pairs = change.kind == CatalogChange::Kind::added ? added_ : removed_;
      pairs.all.insert(std::minmax(tasks_.at(change.task), tasks_.at(change.other_task)));
    }
  }

  void run() {
    for (std::size_t list = 0; list < graph_.exclusions.size(); ++list) mark_added(list);
    for (std::size_t clique = 0; clique < before_.cliques.size(); ++clique) {
      mark_removed(tasks_of(clique));
    }
    add_rest(added_, Mark::added);
    add_rest(removed_, Mark::removed);
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

  void mark_added(std::size_t list) {
    const auto tasks = graph_.exclusions[list];
    const Tasks since = added_.with_all_of(tasks);
    added_.draw(since, tasks);
    List& marked = lists_.emplace_back();
    for (const std::uint32_t task : tasks) {
      const bool is_new = std::binary_search(since.begin(), since.end(), task);
      marked.emplace_back(task, is_new ? Mark::added : Mark::plain);
    }
  }

  void mark_removed(const Tasks& tasks) {
    const Tasks gone = removed_.with_all_of(tasks);
    if (gone.empty()) return;
    if (gone.size() == tasks.size()) {
      add_list(gone, Mark::removed);
    } else {
      Tasks rest;
      std::set_difference(tasks.begin(), tasks.end(), gone.begin(), gone.end(),
                          std::back_inserter(rest));
      List* const list = find_list(rest, gone);
      if (list == nullptr) return;
      for (const std::uint32_t task : gone) list->emplace_back(task, Mark::removed);
    }
    removed_.draw(gone, tasks);
  }

  void add_list(const Tasks& tasks, Mark mark) {
    List& list = lists_.emplace_back();
    for (const std::uint32_t task : tasks) list.emplace_back(task, mark);
  }

  /// The list that has just these tasks and what came to them, if those that are gone from it may
  /// stand there side by side.
  [[nodiscard]] List* find_list(const Tasks& tasks, const Tasks& gone) {
    for (const std::uint32_t place : graph_.exclusions_of_task[tasks.front()]) {
      Tasks present;
      bool is_fit = true;
      for (const auto& [task, mark] : lists_[place]) {
        if (mark == Mark::plain) present.push_back(task);
        if (mark != Mark::removed) continue;
        is_fit = is_fit && std::all_of(gone.begin(), gone.end(), [&](std::uint32_t other) {
                   return removed_.contains(task, other);
                 });
      }
      if (is_fit && present == tasks) return &lists_[place];
    }
    return nullptr;
  }

  void add_rest(const Pairs& pairs, Mark mark) {
    for (const Pair& pair : pairs.all) {
      if (!pairs.drawn.contains(pair)) add_list({pair.first, pair.second}, mark);
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
