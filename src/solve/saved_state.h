#pragma once

#include <optional>

#include "core/script/runner.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"
#include "solve/solve.h"

// The beginning and the end of streams and replays. Problems go to standard error.
namespace cbc::cli {

/// Whether the file of --state-out, if the option is given, can be written. All has been read.
[[nodiscard]] bool can_save_state(const StreamOptions& options);
/// Loads the state of --state-in, if the option is given. False if it cannot be used.
[[nodiscard]] bool load_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              std::optional<Snapshot>& state);
/// Writes the state of --state-out, if the option is given, however the run ended: only after a
/// fault of cbc there is none. False after an error.
[[nodiscard]] bool save_state(const StreamOptions& options, const CompiledCatalog& catalog,
                              const Runner& runner);
/// Reports why a run ended early, if it did. Returns the exit status of the run.
[[nodiscard]] int report_end(const Runner& runner, const CoordinatorOptions& options);

}  // namespace cbc::cli
