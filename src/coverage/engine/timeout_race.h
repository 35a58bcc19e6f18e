#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "coverage/engine/goal_notes.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"
#include "runtime/compiled/compiled_catalog.h"

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
  /// The model must outlive this object.
  explicit TimeoutRace(const Model& model);

  /// What has changed in a move.
  struct Changes {
    std::vector<std::uint8_t> taken;      ///< by task: it took another behavior, or none
    std::vector<std::uint8_t> activated;  ///< by behavior
  };
  /// Notes a move, which the stepper has just made.
  void note(const Stepper& stepper, const Move& move, const Changes& changes);
  /// Adds the moves of another part of the states.
  void add(const TimeoutRace& other);
  /// After all moves of the group: tells of each value one that always times out before it, if
  /// there is any.
  void tell(GoalFacts& facts) const;

 private:
  using Values = std::vector<std::uint32_t>;

  const Model& model_;
  /// By value: its timeout and the place of its task in the catalog, by which two come at the same
  /// time; 0: none.
  std::vector<std::pair<Microseconds, std::uint32_t>> timeouts_;
  /// By value that ran and has a timeout: those that have always come first so far, ascending.
  std::map<std::uint32_t, Values> sooner_;
  Values running_;  ///< after the move; kept for its memory
};

}  // namespace cbc
