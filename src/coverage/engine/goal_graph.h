#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goal_search.h"
#include "coverage/engine/goals.h"
#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// The reachable states of groups, one by one, and the goals that each move meets. A path from the
/// first state of a group is a mission, so a planner of missions needs them as a graph.
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
  /// What edges meet, see is_goal(). A return (Goal::Kind::reactive_returned) counts only if its
  /// task has given way before on the path.
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
  /// Whether an item is a goal, by its number. Another one says that the task of a return gives
  /// way.
  [[nodiscard]] bool is_goal(std::uint32_t item) const { return item < goal_count; }
  /// The item that says so of a return.
  [[nodiscard]] std::uint32_t way_given_for(std::uint32_t goal) const {
    return goal + static_cast<std::uint32_t>(goal_count);
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
