#pragma once

#include "cli/solve_options.h"

namespace cbc::cli {

/// Runs scripts to their ends, and reports them in one of the formats for whole runs. Returns the
/// exit status.
[[nodiscard]] int solve_missions(const SolveOptions& options);

}  // namespace cbc::cli
