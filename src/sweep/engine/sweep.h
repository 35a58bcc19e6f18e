#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "sweep/engine/against.h"
#include "sweep/engine/sequence.h"

// What happens how often in random event sequences: estimates for catalogs of any size, where
// `cbc verify` would have to visit all states.

namespace cbc {

/// The most expensive event of a sweep, in nodes or in time.
struct SlowestEvent {
  std::uint64_t sequence = 0;  ///< counts from 1
  std::uint64_t event = 0;     ///< index in its sequence
  std::uint64_t cost = 0;      ///< nodes, or nanoseconds
  std::string what;            ///< "start ROTATE"
  std::string script;          ///< ends with this event, or soon after it
};

/// The results that depend on the machine. Times are those of whole events that took a search: the
/// problem, the searches, the checks and the changes.
struct SweepTimes {
  std::uint64_t elapsed = 0;  ///< microseconds
  Histogram events;           ///< nanoseconds
  std::optional<SlowestEvent> slowest;
};

/// The result of a sweep.
struct SweepResult {
  std::string catalog;  ///< path of the source, as the user gave it
  std::string digest;   ///< of the content of the catalog without its path; hexadecimal
  std::string version;  ///< of cbc: other versions may draw other events
  SweepSettings settings;
  std::vector<std::string> task_names;      ///< in catalog order
  std::vector<std::string> behavior_names;  ///< in catalog order
  SweepCounts counts;
  Histogram nodes;                      ///< of the events that took a search
  std::optional<SlowestEvent> slowest;  ///< by nodes, the first of equal ones; empty: no search
  std::optional<SweepTimes> times;
  std::optional<SweptComparison> against;  ///< with an older version
};

/// The largest number that JSON has of them.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;

/// The first sequence that ended early.
struct SweepFailure {
  std::uint64_t sequence = 0;  ///< counts from 1
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
  std::string script;          ///< the whole sequence
};

struct SweepOutcome {
  SweepResult result;  ///< means nothing after a failure
  std::optional<SweepFailure> failure;
};

/// What to compare a sweep with.
struct OldVersion {
  const CompiledCatalog& catalog;
  Renames renames;
};

/// Runs random event sequences on a catalog that has tasks; with an old version on both, with
/// events about what both have. The result, except for its times, does
/// not depend on the number of jobs (at least 1), and memory does not grow with the number of
/// sequences. `progress` is called repeatedly, in this thread, with the number of sequences done.
[[nodiscard]] SweepOutcome sweep(const CompiledCatalog& catalog, const SweepSettings& settings,
                                 std::size_t jobs,
                                 const std::function<void(std::uint64_t)>& progress,
                                 const std::optional<OldVersion>& old_version = std::nullopt);

}  // namespace cbc
