#pragma once

#include <optional>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "plain_model.h"
#include "runtime/coordinator/state.h"
#include "verify/engine/explore.h"

namespace cbc::plain {

struct Replay {
  Snapshot end;                    ///< a state of the model
  std::optional<Outcome> outcome;  ///< of the last move, if it is a start, stop or finish
};

/// Instants of the moves, increasing, at which the sets of the queue come due exactly where the
/// script has it. Throws std::runtime_error if a move is impossible.
[[nodiscard]] std::vector<Microseconds> times_of(const PlainModel& model,
                                                 const std::vector<Move>& script);

/// Runs a script through one coordinator from begin() on, as `cbc solve` does: its clock goes on,
/// and states are neither saved nor restored. Throws std::runtime_error if the script does not fit.
[[nodiscard]] Replay replay(const PlainModel& model, const std::vector<Move>& script);

}  // namespace cbc::plain
