#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "coverage/engine/goal_watch.h"
#include "coverage/engine/state_replay.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/explore.h"

namespace cbc {

/// Finds timeouts before which another one always comes, from all moves between the reachable
/// states of a group, although these have no times.
///
/// Take a task x with behavior b, and a task y with c, whose timeout is shorter, or the same and y
/// comes first in the catalog. Where x begins to run with b, y runs with c; and as long as the one
/// goes on, so does the other. So c has been there for as long as b at least, and its timeout comes
/// first. It is a failure of c, and as after no failure of c x goes on with b, the timeout of b
/// does not come.
class TimeoutRace {
 public:
  /// The catalog must outlive this object.
  TimeoutRace(const CompiledCatalog& catalog, std::uint32_t group)
      : catalog_(catalog), group_(group) {}

  /// Notes a move, which the replay has just made.
  void note(const StateReplay& replay, const Move& move);

  /// After all moves of the group: tells of each value one that always times out before it, if
  /// there is any.
  void tell(GoalWatch& watch) const;

 private:
  const CompiledCatalog& catalog_;
  const std::uint32_t group_;
  /// By value that ran and has a timeout: those that have always come first so far, ascending.
  std::map<ValueId, std::vector<ValueId>> sooner_;
  std::vector<ValueId> running_;  ///< after the move; kept for its memory
};

}  // namespace cbc
