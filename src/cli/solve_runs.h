#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "cli/mission.h"
#include "report/solve_report.h"
#include "script/runner.h"

namespace cbc::cli {

/// Runs a mission, and tells the report of it from its begin to its end. May be called on several
/// threads at once, with a report for each.
using RunMission = std::function<RunResult(const Mission& mission, SolveReport& report)>;

/// Is told of each run that is in the report.
using AfterRun = std::function<void(const Mission& mission, const RunResult& result)>;

/// Runs all missions, up to `jobs` at once if the report allows for it. The report, and
/// `after_run`, are told of them in their order, and what comes of it does not depend on `jobs`. On
/// a terminal a line tells how far it is, if it takes long.
void run_all(const std::vector<Mission>& missions, std::size_t jobs, SolveReport& report,
             const RunMission& run, const AfterRun& after_run);

}  // namespace cbc::cli
