#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "compiled/compiled_catalog.h"
#include "coordinator/snapshot.h"

/// The state of a coordinator as a JSON document (see `cbc solve --state-out`):
///
///     {"schema": "cbc.state/1",
///      "digest": "…",                       of the catalog, see identity_of
///      "time_us": 4080000, "events": 12,    the clock, and the number of the last event
///      "reactive_delay_us": 80000,
///      "running": [{"task": "HOVER", "behavior": "HOVER_WITH_MPC", "since_us": 4000000,
///                   "waits_for_timeout": false,
///                   "request": {"priority": 2, "event": 9, "parameters": "…"}}],   or null
///      "active": {"HOVER_WITH_MPC": 4000000},    and when it was activated
///      "unavailable": ["GPS"], "faulty": [],
///      "queue": {"LAND": 4160000}}               reactive tasks, and when they are due
///
/// Parameters are in canonical form (see Event::parameters).
namespace cbc {

[[nodiscard]] std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot);

/// A snapshot that a coordinator on the catalog can go on from, or why there is none.
struct StateReading {
  std::optional<Snapshot> snapshot;
  std::string error;
};
[[nodiscard]] StateReading read_state(std::string_view text, const CompiledCatalog& catalog);

}  // namespace cbc
