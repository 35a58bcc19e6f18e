#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/report/catalog_words.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// Events and expectations in words.

namespace cbc {

/// What happened: "start HOVER, priority 2". `step` is the scripted one, or null.
[[nodiscard]] std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                                         const Step* step);

/// The same with its outcome, if it has one: "start HOVER, priority 2: accepted".
[[nodiscard]] std::string event_and_outcome(const CompiledCatalog& catalog,
                                            const EventRecord& record, const Step* step);

/// Why a task stopped, in the words for changes of behaviors where it was not by the finish of its
/// own behavior: "requested" by this event, "displaced" or "released".
[[nodiscard]] std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped);

/// That a behavior, which is active, became faulty only after it was activated.
[[nodiscard]] std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior);

/// What may surprise about an event: a fault of an active behavior, a finish of an inactive one, or
/// a stop of a task that does not run. Empty for most. `state`: after the event.
[[nodiscard]] std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                                        const State& state);

/// "outcome accepted, HOVER runs with HOVER_WITH_MPC, LAND does not run"
[[nodiscard]] std::string describe_expectation(const CompiledCatalog& catalog,
                                               const Expectation& expectation);

/// The reactive tasks in the queue and those that wait, in catalog order, with their due times;
/// those that only wait have none.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state);

}  // namespace cbc
