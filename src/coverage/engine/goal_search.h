#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goal_monitor.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/breadth_first.h"
#include "verify/engine/model.h"

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
  bool is_complete = false;  ///< false: a limit came first, and nothing is proven
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

/// Visits the reachable states of a group (docs/verify.md, "States"), numbered by the least number
/// of moves to them, and makes each move from each of them on a coordinator that is monitored for
/// goals. `on_move` sees the moves of the states, one state after the other. `unwanted`: null, or
/// what GoalMonitor::restart() gets before each move. A complete search also tells the monitor
/// which timeouts always come before others.
[[nodiscard]] GoalSearchResult search_goals(const CompiledCatalog& catalog, GroupId group,
                                            const Assumptions& assumptions, GoalMonitor& monitor,
                                            const std::vector<std::uint8_t>* unwanted,
                                            const GoalSearchOptions& options,
                                            const std::function<void(const SeenMove&)>& on_move);

}  // namespace cbc
