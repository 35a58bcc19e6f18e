#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "sweep/result.h"

namespace cbc {

/// A sequence that ended early, the first one that did.
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

/// Runs random event sequences on a catalog that has tasks. The result, but for its times, is the
/// same for any number of jobs (at least 1), and memory does not grow with the number of sequences.
/// `progress` is called now and then, in this thread, with the number of sequences done.
[[nodiscard]] SweepOutcome sweep(const CompiledCatalog& catalog, const SweepSettings& settings,
                                 std::size_t jobs,
                                 const std::function<void(std::uint64_t)>& progress);

}  // namespace cbc
