#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc {

/// A run of a script, and the goals that it met.
struct WatchedResult {
  RunResult result;
  std::vector<std::uint8_t> met;  ///< by goal
};

/// Runs a script as run_script does, and watches it. `goals` are those of find_goals.
[[nodiscard]] WatchedResult run_watched(const CompiledCatalog& catalog, std::span<const Goal> goals,
                                        const Script& script, const CoordinatorOptions& options,
                                        RunListener& listener);

}  // namespace cbc
