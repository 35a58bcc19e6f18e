#pragma once

#include "cli/solve_options.h"

/// `cbc solve` as a part of a pipe: `--format jsonl`, with states saved and restored.
namespace cbc::cli {

/// Runs one script, or events from standard input, and writes each event as a line. The paths are
/// a catalog and a script, "-" for a stream; or a script that names its catalog. Returns the exit
/// status.
[[nodiscard]] int solve_stream(const SolveOptions& options);

/// Runs the events of a recorded stream again, and compares. The path is that of the catalog.
[[nodiscard]] int replay_stream(const SolveOptions& options);

}  // namespace cbc::cli
