#include "cli/solve_missions.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/mission.h"
#include "cli/output.h"
#include "cli/run_end.h"
#include "cli/solve_runs.h"
#include "cli/terminal.h"
#include "report/solve_github.h"
#include "report/solve_html.h"
#include "report/solve_json.h"
#include "report/solve_junit.h"
#include "report/solve_report.h"
#include "report/solve_text.h"
#include "script/runner.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// Says on standard error why a run ended early.
void complain_of_run(const Mission& mission, const RunResult& result, const std::string& reason) {
  fmt::print(stderr, "cbc: {}: {}\n", quote(mission.script.file), reason);
  if (result.status == Coordinator::Status::refused_answer) {
    fmt::print(stderr,
               "cbc: this is a fault of cbc, not of the catalog {}; please report it with the "
               "catalog and the script\n",
               quote(mission.catalog->file));
  }
}

int run_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                 SolveReport& report) {
  const auto run = [&](const Mission& mission, SolveReport& report_of_run) {
    const CoordinatorOptions coordination = coordinator_options(options, *mission.catalog);
    report_of_run.begin_run(*mission.catalog, mission.script);
    RunResult result = run_script(*mission.catalog, mission.script, coordination, report_of_run);
    report_of_run.end_run(result, describe_end(result, coordination));
    return result;
  };
  int status = exit_ok;
  const auto after_run = [&](const Mission& mission, const RunResult& result) {
    const std::string reason = describe_end(result, coordinator_options(options, *mission.catalog));
    if (!reason.empty()) complain_of_run(mission, result, reason);
    status = std::max(status, status_of(result));
  };
  run_all(missions, thread_count(options), report, run, after_run);
  return status;
}

/// Runs with a picture beside the report.
int draw_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                  SolveReport& report) {
  HtmlReport picture;
  ReportPair both(report, picture);
  const int status = run_missions(missions, options, both);
  return std::max(status, write_output(*options.html, picture.page()));
}

std::unique_ptr<SolveReport> make_report(const SolveOptions& options) {
  if (options.format == "json") {
    return std::make_unique<JsonReport>(stdout, event_additions(options));
  }
  if (options.format == "junit") return std::make_unique<JunitReport>(stdout);
  if (options.format == "github") return std::make_unique<GithubReport>(stdout);
  return std::make_unique<TextReport>(wants_color(stdout) ? color_style() : plain_style(), stdout);
}

/// CI collects what it is given: a report that is missing could be taken for one without failures.
void report_unreadable(const SolveOptions& options, const MissionLoader& loader) {
  if (options.format == "github") GithubReport(stdout).add_unreadable(loader.findings());
  if (options.format != "junit") return;
  JunitReport report(stdout);
  report.add_unreadable(loader.findings());
  report.end();
}

/// Whether all catalogs have the names that are asked for.
bool know_names(const std::vector<Mission>& missions, const ExplainOptions& options) {
  return std::all_of(missions.begin(), missions.end(), [&](const Mission& mission) {
    return knows_names(*mission.catalog, options);
  });
}

/// What the command line does not name itself, but reads: catalogs that scripts name, scripts of
/// folders.
bool is_read(const std::string& path, const std::vector<Mission>& missions) {
  return std::any_of(missions.begin(), missions.end(), [&](const Mission& mission) {
    return is_same_file(mission.script.file, path) ||
           (mission.named_catalog && is_same_file(*mission.named_catalog, path));
  });
}

}  // namespace

int solve_missions(const SolveOptions& options) {
  MissionLoader loader;
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) {
    report_unreadable(options, loader);
    return exit_unusable;
  }
  if (!know_names(*missions, options.explain)) return exit_unusable;
  if (options.html && is_read(*options.html, *missions)) {
    complain(fmt::format("the output {} is a script of a folder, or a catalog that a script names",
                         quote(*options.html)));
    return exit_unusable;
  }
  const std::unique_ptr<SolveReport> report = make_report(options);
  return options.html ? draw_missions(*missions, options, *report)
                      : run_missions(*missions, options, *report);
}

}  // namespace cbc::cli
