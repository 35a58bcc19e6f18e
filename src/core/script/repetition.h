#pragma once

#include <functional>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"
#include "why/explanation.h"

// Calls of a program, which may be done once more. A coordinator does the same whenever it is asked
// from the same state, unless a limit of time ends a search, so all that anybody may ask later
// about an event can be found in this way. To a call that nobody asks about the state before it is
// all that is kept.

namespace cbc {

/// What is asked of a run at once.
struct Call {
  Step step;
  bool is_clock = false;  ///< moves the clock to the time of the step, with all that is due then
};

/// The clock moves to a time.
[[nodiscard]] Call clock_call(Microseconds time);

/// Does a call, with the full number of clock events. False if the run ends early: see Runner.
[[nodiscard]] bool make_call(Runner& runner, const Call& call);

/// As RunListener::on_event.
using TakeEvent =
    std::function<void(const ExplainedRecord& record, const Step* step, const State& state)>;

/// Does a call once more from the state before it, asks these questions, and passes on its events.
void repeat(const CompiledCatalog& catalog, const CoordinatorOptions& options,
            const Snapshot& before, const Call& call, const Questions& questions,
            const TakeEvent& take);

}  // namespace cbc
