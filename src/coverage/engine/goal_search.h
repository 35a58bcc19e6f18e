#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "core/support/budget.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goals.h"
#include "explore/model/model.h"
#include "explore/sets/state_store.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

struct GoalSearchOptions {
  std::uint64_t max_states = 1'000'000;                ///< of each group
  std::uint64_t max_memory = std::uint64_t{4} << 30U;  ///< bytes that its states may take
  /// Called for each state, and now and then within one that has many moves; false ends the search
  /// as a limit does. May be empty.
  std::function<bool(GroupId group, std::uint64_t states)> on_progress;
};

/// What a search visited.
struct GoalSearchResult {
  std::uint64_t states = 0;
  std::uint64_t moves = 0;
  bool is_complete = false;        ///< false: a limit came first, and nothing is proven
  std::optional<Budget::End> end;  ///< which one; if not complete
  /// See Model::find_obstacle(); then nothing was visited.
  std::optional<std::string> error;
};

/// A move between two reachable states, and what it did.
struct SeenMove {
  StateStore::Number from = 0;
  StateStore::Number to = 0;
  Move move;
  const std::vector<TaskId>& started;   ///< reactive tasks that started by themselves
  const std::vector<TaskId>& gave_way;  ///< reactive tasks
};

/// What a search is about.
struct GoalScope {
  std::optional<GroupId> group;
  /// Without a group: a variable that no behavior names, with what `never` ties to it.
  std::uint32_t variable = none;
};

/// The variables that may change, that no behavior names, and that `never` binds to others or to
/// some of their values. In catalog order.
[[nodiscard]] std::vector<std::uint32_t> bound_variables(const CompiledCatalog& catalog,
                                                         const Assumptions& assumptions);

/// Visits the reachable states of the scope (docs/verify.md, "States"), numbered by the least
/// number of moves to them, and makes each move from each of them on a coordinator that is
/// monitored for goals. `on_move` sees the moves of the states, one state after the other.
/// `unwanted`: null, or what GoalMonitor::restart() gets before each move. A complete search also
/// tells the monitor which timeouts always come before others.
[[nodiscard]] GoalSearchResult search_goals(const CompiledCatalog& catalog, GoalScope scope,
                                            const Assumptions& assumptions, GoalMonitor& monitor,
                                            const std::vector<std::uint8_t>* unwanted,
                                            const GoalSearchOptions& options,
                                            const std::function<void(const SeenMove&)>& on_move);

/// The reachable states of groups, and the goals that each move meets. A path from the first state
/// of a group is a mission.
struct GoalGraph {
  struct Edge {
    std::uint32_t to = 0;
    std::uint32_t first_item = 0;  ///< in `items`
    std::uint32_t item_count = 0;
    Move move;
  };
  /// The states of a group are numbered from its first state on, by the least number of moves to
  /// them.
  struct Part {
    GroupId group;  ///< of a part that is about a variable: the first one
    std::uint32_t first_state = 0;
    bool is_complete = false;  ///< false: a limit came first
    std::uint32_t variable = none;
  };

  std::size_t goal_count = 0;
  std::vector<std::uint32_t> begin{0};  ///< by state: its first edge; then the end
  std::vector<Edge> edges;              ///< by state, then in the order of moves
  /// The goals of edges. A return (Goal::Kind::reactive_returned) counts only if the task has given
  /// way before on the path: a number from `goal_count` on says that of goal number - goal_count.
  std::vector<std::uint32_t> items;
  std::vector<std::uint8_t> is_return;  ///< by goal
  /// By group, without those after a stop; then of variables that no behavior names.
  std::vector<Part> parts;
  GoalFacts facts;
  std::optional<std::string> error;  ///< see Model::find_obstacle()

  [[nodiscard]] std::size_t explored_groups() const {
    return static_cast<std::size_t>(std::count_if(
        parts.begin(), parts.end(), [](const Part& part) { return part.variable == none; }));
  }
  [[nodiscard]] std::size_t state_count() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const std::uint32_t> items_of(const Edge& edge) const {
    return {items.data() + edge.first_item, edge.item_count};
  }
};

/// Visits all reachable states of each group, and notes for each move which of the wanted goals it
/// meets. Failures meet the goals of timeouts, too. `wanted`: by goal. Catalog, goals and
/// assumptions need not outlive the graph.
[[nodiscard]] GoalGraph explore_goals(const CompiledCatalog& catalog, std::span<const Goal> goals,
                                      const std::vector<std::uint8_t>& wanted,
                                      const Assumptions& assumptions,
                                      const GoalSearchOptions& options);

}  // namespace cbc
