#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/explain_options.h"
#include "cli/stream_options.h"
#include "cli/sweep_options.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "report/event_json.h"

namespace cbc::cli {

/// The options of `cbc solve`, as the command line has them.
struct SolveOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::optional<std::string> html;
  std::optional<std::uint64_t> jobs;
  bool stats = false;
  ExplainOptions explain;
  std::uint64_t max_solutions = 0;
  std::string time_limit;
  std::uint64_t max_nodes = 0;
  std::optional<std::uint64_t> tie_seed;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;
  StreamOptions stream;
  SweepOptions sweep;
};

/// What they say to the coordinator of a run on this catalog, whose names they know.
[[nodiscard]] CoordinatorOptions coordinator_options(const SolveOptions& options,
                                                     const CompiledCatalog& catalog);

/// What events have in JSON beside what they always have.
[[nodiscard]] EventAdditions event_additions(const SolveOptions& options);

/// How many threads may work at once; at least 1.
[[nodiscard]] std::size_t thread_count(const SolveOptions& options);

}  // namespace cbc::cli
