#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/command_line/limits.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/property/properties.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goal_search.h"
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

/// When to stop: a signal has come, or the time is over.
class Deadline {
 public:
  /// Begins now. `seconds`: 0 for no limit.
  explicit Deadline(double seconds) : seconds_(seconds) {}

  [[nodiscard]] bool has_come() const { return signals_.have_come() || is_late(); }
  [[nodiscard]] bool is_late() const { return seconds_ > 0 && seconds_left() <= 0; }
  /// It came so long ago that whoever set it waits.
  [[nodiscard]] bool is_over() const {
    constexpr std::chrono::seconds patience(2);
    const auto now = std::chrono::steady_clock::now();
    if (!came_ && has_come()) came_ = now;
    return came_ && now - *came_ > patience;
  }
  /// Of a limit.
  [[nodiscard]] double seconds_left() const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    return seconds_ - elapsed.count();
  }
  /// Whether there is time for a group, of several that are visited one after the other. A tenth of
  /// the limit is shared by those after it, which may be small, and `kept` is the part of the limit
  /// that is for what comes after all of them.
  [[nodiscard]] bool has_time_for(GroupId group, std::size_t groups, double kept = 0) const {
    if (has_come() || seconds_ == 0) return !has_come();
    const std::size_t after = groups - 1 - group;
    kept += 0.1 * static_cast<double>(after) / static_cast<double>(groups);
    return seconds_left() > kept * seconds_;
  }

 private:
  const StopSignals signals_;
  const double seconds_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  /// When it was seen to have come.
  mutable std::optional<std::chrono::steady_clock::time_point> came_;
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

/// Of the walks of proofs and plans; what is not given is as they have it.
[[nodiscard]] GoalSearchOptions search_options(const StateLimits& limits);

/// Writes the scripts that are missing beside the missions, and reports them. Returns the exit
/// status.
[[nodiscard]] int write_missing(const CoverageOptions& options, const CoverageQuestion& question);

/// Judges mutants of the catalog, of which the missions have the source, and writes the report.
/// Returns the exit status.
[[nodiscard]] int judge_mutants(const CoverageOptions& options, const CoverageQuestion& question);

}  // namespace cbc::cli
