#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goal_watch.h"
#include "coverage/engine/state_replay.h"
#include "coverage/engine/timeout_race.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/explore.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

struct GroupWalkOptions {
  std::uint64_t max_states = 1'000'000;                ///< of each group
  std::uint64_t max_memory = std::uint64_t{4} << 30U;  ///< bytes that its states may take
  /// Called for each state, and now and then within one that has many moves; false ends the walk as
  /// a limit does. May be empty.
  std::function<bool(std::uint32_t group, std::uint64_t states)> on_progress;
};

/// What a walk visited.
struct GroupWalkResult {
  std::uint64_t states = 0;
  std::uint64_t moves = 0;
  bool is_complete = false;  ///< false: a limit came first, and nothing is proven
};

/// Visits the reachable states of a group (docs/verify.md, "States"), numbered by the least number
/// of moves to them, and makes each move from each of them on a coordinator that is watched for
/// goals.
class GroupWalk {
 public:
  using Number = std::uint32_t;

  /// Sees the moves of the states, one state after the other.
  class Listener {
   public:
    virtual ~Listener() = default;

    /// Before the watched coordinator makes a move.
    virtual void before_move() {}
    /// After it. What the replay tells is that of this move.
    virtual void on_move(Number from, Number to, const Move& move, const StateReplay& replay) = 0;
  };

  /// All must outlive this object.
  GroupWalk(const CompiledCatalog& catalog, std::uint32_t group, const Assumptions& assumptions,
            GoalWatch& watch, const GroupWalkOptions& options);

  /// Why there is nothing to visit, if so.
  [[nodiscard]] std::optional<std::string> find_obstacle() const { return model_.find_obstacle(); }
  /// Unless there is an obstacle, once. A complete run also tells the watch which timeouts always
  /// come before others.
  [[nodiscard]] GroupWalkResult run(Listener& listener);

 private:
  [[nodiscard]] bool may_go_on() const;
  Number find(const std::vector<std::uint32_t>& packed);
  void leave(Number state, Listener& listener);

  const std::uint32_t group_;
  const GroupWalkOptions& options_;
  const Model model_;
  Stepper stepper_;
  StateReplay replay_;
  GoalWatch& watch_;
  TimeoutRace race_;
  GroupWalkResult result_;
  std::unordered_map<std::string, Number> numbers_;
  std::vector<std::vector<std::uint32_t>> states_;  ///< packed
  std::vector<std::uint32_t> packed_;               ///< kept for its memory
};

}  // namespace cbc
