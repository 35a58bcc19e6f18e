#pragma once

#include <span>
#include <string>

#include "core/report/blocks.h"
#include "sweep/engine/sweep.h"

// The reports of `cbc sweep`.

namespace cbc {

/// The result of a sweep as JSON; "stats" is there if the result has times.
[[nodiscard]] std::string sweep_to_json(const SweepResult& result);
[[nodiscard]] std::string sweep_schema();

/// Adds the result of a sweep against an older version.
void add_against(const SweepResult& result, Blocks& report);

/// "1000 sequences of 100 events, seed 1"
[[nodiscard]] std::string describe(const SweepSettings& settings);

/// The first one is the default.
[[nodiscard]] std::span<const ReportFormat<SweepResult>> sweep_formats();

}  // namespace cbc
