#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/command_line/limits.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/signals.h"
#include "core/property/properties.h"
#include "core/support/budget.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::cli {

/// The options of `cbc coverage`.
struct CoverageOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string output = "-";
  std::string fail_under;             ///< percent; empty: whatever it is
  bool prove = false;                 ///< set goals apart that are proven unreachable
  std::optional<std::string> assume;  ///< the property file with the assumptions of proofs
  std::optional<std::string> write_missing;
  bool mutants = false;
  std::optional<std::string> scripts;
  std::optional<std::uint64_t> jobs;
  SearchLimits search;
  StateLimits limits;
};

/// Runs missions, up to `jobs` at once, and hands out the results in their order until `take`
/// returns false. A terminal shows the progress.
void watch_missions(const std::vector<Mission>& missions, std::optional<std::uint64_t> jobs,
                    const CoordinatorOptions& options,
                    const std::function<const std::vector<Goal>&(const Mission&)>& goals_of,
                    const std::function<bool(const Mission&, MonitoredResult)>& take);

/// What is assumed of each catalog in proofs: what --assume says, or what holds without it. Empty
/// if that cannot be known; the reason is printed.
[[nodiscard]] std::optional<std::vector<StatedAssumptions>> find_assumptions(
    const std::vector<const CompiledCatalog*>& catalogs, const CoverageOptions& options);

/// Runs the missions, and reports which goals they meet. Returns the exit status.
[[nodiscard]] int measure_coverage(const CoverageOptions& options,
                                   const std::vector<Mission>& missions);

/// Missions on one catalog, and what else may happen.
struct CoverageQuestion {
  std::shared_ptr<const CompiledCatalog> catalog;
  std::vector<Mission> missions;
  StatedAssumptions assumptions;
};

/// Until a signal comes, or the time is over, which begins now. `signals` must outlive it.
[[nodiscard]] Budget budget_of(const CoverageOptions& options, const StopSignals& signals);

/// Writes the scripts that are missing beside the missions, and reports them. Returns the exit
/// status.
[[nodiscard]] int write_missing(const CoverageOptions& options, const CoverageQuestion& question);

/// Judges mutants of the catalog, of which the missions have the source, and writes the report.
/// Returns the exit status.
[[nodiscard]] int judge_mutants(const CoverageOptions& options, const CoverageQuestion& question);

}  // namespace cbc::cli
