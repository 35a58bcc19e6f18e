#include "cli/solve_options.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "text/decimal.h"

namespace cbc::cli {

CoordinatorOptions coordinator_options(const SolveOptions& options,
                                       const CompiledCatalog& catalog) {
  CoordinatorOptions result;
  result.search.max_solutions = options.max_solutions;
  result.search.max_nodes = options.max_nodes;
  if (!options.time_limit.empty()) {
    result.search.time_limit = std::chrono::microseconds(parse_seconds(options.time_limit).value);
  }
  result.tie_seed = options.tie_seed;
  result.max_clock_events = options.max_clock_events;
  result.explain = explanation_for(catalog, options.explain);
  // The others are for programs, which ask for it.
  result.explain.displaced =
      options.format == "text" || options.format == "junit" || options.format == "github";
  result.measure_time = options.stats;
  return result;
}

EventAdditions event_additions(const SolveOptions& options) {
  return {!options.explain.why.empty(), options.explain.alternatives > 0};
}

std::size_t thread_count(const SolveOptions& options) {
  constexpr std::uint64_t most_threads = 256;  // more would only take memory
  if (options.jobs) return std::min(*options.jobs, most_threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace cbc::cli
