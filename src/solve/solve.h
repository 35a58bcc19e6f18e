#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/check/check.h"
#include "core/command_line/limits.h"
#include "core/report/event_json.h"
#include "core/script/runner.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"

namespace cbc::cli {

/// What to explain, as given on the command line.
struct ExplainOptions {
  std::vector<std::string> why;  ///< names of tasks and behaviors
  std::uint32_t alternatives = 0;
};

/// Whether the catalog has all names. Prints the first one that it lacks to standard error.
[[nodiscard]] bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options);

/// The options for streams of events, and for missions that continue.
struct StreamOptions {
  std::optional<std::string> state_in;
  std::optional<std::string> state_out;
  std::optional<std::string> replay;
  std::optional<std::string> to_script;
  std::string clock = "events";      ///< or "real"
  std::optional<std::string> serve;  ///< where a page shows the stream
};

/// What could happen next in a mission.
struct WhatIfOptions {
  bool is_wanted = false;
  std::optional<std::uint64_t> after;  ///< number of an event; 0: before the first one
};

/// The options of `cbc solve`.
struct SolveOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::optional<std::string> html;
  std::optional<std::uint64_t> jobs;
  bool stats = false;
  bool brief = false;
  ExplainOptions explain;
  SearchLimits search;
  std::string time_limit;
  StreamOptions stream;
  WhatIfOptions what_if;
};

[[nodiscard]] CoordinatorOptions coordinator_options(const SolveOptions& options);
/// What to ask about the events of a run on this catalog, which must know all names.
[[nodiscard]] Questions questions_of(const SolveOptions& options, const CompiledCatalog& catalog);

/// The optional members of events in JSON.
[[nodiscard]] EventAdditions event_additions(const SolveOptions& options);

/// Says that a page lacks the last events, if it lacks any.
void tell_left_out(const std::string& page, std::uint64_t events);

// The beginning and the end of streams and replays. Problems go to standard error.

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

/// Runs scripts, and reports them in one of the formats for whole runs. Returns the exit status.
[[nodiscard]] int solve_missions(const SolveOptions& options);

/// Runs the only script to one of its events, and reports what could happen then. Returns the exit
/// status.
[[nodiscard]] int solve_what_if(const SolveOptions& options);

/// Runs one script, or events from standard input, and writes each event as a line. The paths are
/// a catalog and a script, "-" for a stream; or a script that names its catalog. Returns the exit
/// status.
[[nodiscard]] int solve_stream(const SolveOptions& options);

/// Runs the events from outside of a log on the catalog that is the path, its own or another one,
/// and reports what is decided differently. With --to-script, then writes them as a script.
[[nodiscard]] int replay(const SolveOptions& options);

}  // namespace cbc::cli
