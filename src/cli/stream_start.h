#pragma once

#include <optional>
#include <string>

#include "cli/solve_stream.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/snapshot.h"
#include "script/runner.h"

/// What streams and replays begin and end with. Problems go to standard error.
namespace cbc::cli {

/// Whether the files that the options name can be used together, and the state can be written.
[[nodiscard]] bool can_use_files(const SolveOptions& options);

/// The state of --state-in. False if it cannot be used; without the option all is well.
[[nodiscard]] bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              std::optional<Snapshot>& state);

/// Writes --state-out, if it is asked for and the run has not broken off. False after an error.
[[nodiscard]] bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              const Runner& runner);

/// Says why a run ended early, if it did. Returns the exit status of the run.
[[nodiscard]] int report_end(const Runner& runner, const CoordinatorOptions& options);

}  // namespace cbc::cli
