#pragma once

#include <string>

#include "python/module/session.h"
#include "runtime/coordinator/record.h"

// Answers to questions about events that have happened, found by repeating them: see PastCall. They
// mean nothing once `is_stopped` has ended the repetition.

namespace cbc::python {

/// What can be said of an event while it happens. `state`: after it.
[[nodiscard]] Told tell(const PastCall& past, const ExplainedRecord& record, const State& state);

/// Why an event was rejected, or what it displaced and why, in the words of `cbc solve`. The first
/// line says what happened; reasons follow, indented.
[[nodiscard]] std::string explain_event(const HandledEvent& event, const IsStopped& is_stopped);

/// The event as `cbc solve --format json` writes it.
[[nodiscard]] std::string event_to_json(const HandledEvent& event, const IsStopped& is_stopped);

/// Why a task or behavior is as it is now, in the words of `cbc solve --why`.
[[nodiscard]] std::string explain_present(const Session& session, const Subject& subject,
                                          const IsStopped& is_stopped);

}  // namespace cbc::python
