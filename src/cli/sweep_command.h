#pragma once

#include "cli/solve_options.h"

namespace cbc::cli {

/// Runs a sweep on the catalog of the path, or merges the shards there. Returns the exit status.
[[nodiscard]] int run_sweep(const SolveOptions& options);

}  // namespace cbc::cli
