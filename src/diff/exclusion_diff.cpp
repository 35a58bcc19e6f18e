#include "diff/exclusion_diff.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace cbc {
namespace {

/// Place of a task among the names of both catalogs, in their order.
using Place = std::uint32_t;

/// One of the two catalogs, by places.
struct Side {
  const CompiledCatalog* catalog;
  std::vector<TaskId> tasks;         ///< by place; `none`: the catalog has no such task
  std::vector<Place> places;         ///< by TaskId
  std::vector<std::uint32_t> marks;  ///< by place: the class whose tasks exclude it

  [[nodiscard]] std::span<const std::uint32_t> cliques_of(Place place) const {
    return tasks[place] == none ? std::span<const std::uint32_t>()
                                : catalog->task_cliques[tasks[place]];
  }
};

std::vector<std::string_view> names_of_both(const CompiledCatalog& before,
                                            const CompiledCatalog& after) {
  std::vector<std::string_view> names;
  for (const CompiledCatalog* catalog : {&before, &after}) {
    for (const std::string_view name : catalog->task_names) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

class ExclusionDiff {
 public:
  ExclusionDiff(const CompiledCatalog& before, const CompiledCatalog& after)
      : names_(names_of_both(before, after)), sides_{side_of(before), side_of(after)} {}

  void run(CatalogDiff& diff) {
    std::vector<Place> order(names_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](Place a, Place b) { return precedes(a, b); });
    std::vector<std::span<const Place>> classes;
    for (auto first = order.begin(); first != order.end();) {
      const auto end = std::find_if(first, order.end(),
                                    [&](Place place) { return precedes(*first, place, false); });
      classes.emplace_back(first, end);
      first = end;
    }
    // By names, so that the order of lists does not decide which pairs are listed.
    std::sort(classes.begin(), classes.end(),
              [](const auto& a, const auto& b) { return a.front() < b.front(); });
    for (const auto alike : classes) compare_class(alike);
    std::sort(pairs_.begin(), pairs_.end());
    for (const auto& [task, other, kind] : pairs_) {
      CatalogChange& change = diff.changes.emplace_back();
      change.kind = kind;
      change.subject = CatalogChange::Subject::exclusion;
      change.task = names_[task];
      change.other_task = names_[other];
    }
    diff.further_exclusions = ends_of_pairs_ / 2 - pairs_.size();
  }

 private:
  [[nodiscard]] Side side_of(const CompiledCatalog& catalog) const {
    Side side{&catalog,
              {},
              std::vector<Place>(catalog.tasks.size()),
              std::vector<std::uint32_t>(names_.size(), none)};
    for (Place place = 0; place < names_.size(); ++place) {
      const auto index = catalog.find_task(names_[place]);
      side.tasks.push_back(index ? catalog.task_ids[*index] : none);
      if (index) side.places[side.tasks.back()] = place;
    }
    return side;
  }

  /// Orders by the lists that a task is in, so that those which are in the same ones lie side by
  /// side, and among them by name.
  [[nodiscard]] bool precedes(Place a, Place b, bool by_name = true) const {
    for (const Side& side : sides_) {
      const auto [first, second] = std::pair(side.cliques_of(a), side.cliques_of(b));
      const auto order = std::lexicographical_compare_three_way(first.begin(), first.end(),
                                                                second.begin(), second.end());
      if (order != 0) return order < 0;
    }
    return by_name && a < b;
  }

  /// Tasks that are in the same lists, before as after, exclude the same tasks (and each other), so
  /// that these are found once for all of them.
  void compare_class(std::span<const Place> alike) {
    for (Side& side : sides_) mark_excluded(side, alike.front());
    constexpr std::array kinds{CatalogChange::Kind::removed, CatalogChange::Kind::added};
    for (std::size_t side = 0; side < sides_.size(); ++side) {
      find_only(sides_[side], sides_[1 - side], alike.front());
      for (const Place task : alike) add_pairs(task, kinds[side]);
    }
  }

  void mark_excluded(Side& side, Place task) const {
    for (const std::uint32_t clique : side.cliques_of(task)) {
      for (const TaskId other : side.catalog->cliques[clique]) {
        side.marks[side.places[other]] = task;
      }
    }
  }

  /// Those that `task` excludes in `side` but not in `other`.
  void find_only(Side& side, const Side& other, Place task) {
    only_.clear();
    has_itself_ = false;
    for (const std::uint32_t clique : side.cliques_of(task)) {
      for (const TaskId excluded : side.catalog->cliques[clique]) {
        const Place place = side.places[excluded];
        if (side.marks[place] != task || other.marks[place] == task) continue;
        side.marks[place] = none;  // not twice
        only_.push_back(place);
        has_itself_ = has_itself_ || place == task;
      }
    }
    std::sort(only_.begin(), only_.end());
  }

  void add_pairs(Place task, CatalogChange::Kind kind) {
    ends_of_pairs_ += only_.size() - (has_itself_ ? 1 : 0);
    for (const Place other : only_) {
      if (pairs_.size() == most_listed_exclusions) return;
      if (task < other) pairs_.emplace_back(task, other, kind);
    }
  }

  const std::vector<std::string_view> names_;
  std::array<Side, 2> sides_;
  std::vector<Place> only_;  ///< what the tasks of a class exclude in one of the catalogs only
  bool has_itself_ = false;  ///< whether these tasks stand there themselves
  std::vector<std::tuple<Place, Place, CatalogChange::Kind>> pairs_;
  std::uint64_t ends_of_pairs_ = 0;
};

}  // namespace

void compare_exclusions(const CompiledCatalog& before, const CompiledCatalog& after,
                        CatalogDiff& diff) {
  ExclusionDiff(before, after).run(diff);
}

}  // namespace cbc
