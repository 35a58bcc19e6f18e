#include "cli/solve_command.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/explain_options.h"
#include "cli/input.h"
#include "cli/mission.h"
#include "cli/terminal.h"
#include "cli/validators.h"
#include "coordinator/coordinator.h"
#include "file/atomic_file.h"
#include "report/solve_html.h"
#include "report/solve_json.h"
#include "report/solve_report.h"
#include "report/solve_text.h"
#include "script/runner.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr const char* footer =
    "Examples:\n"
    "  cbc solve quadrotor.yaml mission.yaml          one script, for a person to read\n"
    "  cbc solve quadrotor.yaml missions/ --format json\n"
    "                                                 all scripts of a folder, as JSON\n"
    "  echo '[{start: TAKE_OFF}]' | cbc solve quadrotor.yaml -\n"
    "                                                 a script from standard input\n"
    "  cbc solve quadrotor.yaml mission.yaml --html mission.html\n"
    "                                                 a picture, too, for a browser\n"
    "  cbc solve quadrotor.yaml mission.yaml --why HOVER --alternatives 3\n"
    "                                                 why HOVER is as it is, and the three\n"
    "                                                 best configurations, of each event\n"
    "  cbc solve quadrotor.yaml mission.yaml --max-solutions 5\n"
    "                                                 the best of the first 5 solutions only\n"
    "\n"
    "In the text, P is the priority of the request behind a change, T is + for an activation and "
    "-\n"
    "for a deactivation, S says whether it succeeded (Y) or failed (N).\n"
    "\n"
    "Exit status: 0 all expectations hold, 1 one does not, 2 the input or the usage is wrong,\n"
    "3 an internal error (please report it).";

struct SolveOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::optional<std::string> html;
  std::uint64_t max_solutions = 0;
  std::string time_limit;
  std::uint64_t max_nodes = 0;
  std::optional<std::uint64_t> tie_seed;
  std::uint64_t max_clock_events = CoordinatorOptions{}.max_clock_events;
  ExplainOptions explain;
};

CoordinatorOptions to_coordinator_options(const SolveOptions& options,
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
  result.explain.displaced = options.format == "text";
  return result;
}

/// Why a run ended early, or empty.
std::string describe_end(const RunResult& result, const SolveOptions& options) {
  switch (result.status) {
    case Coordinator::Status::ok:
      return {};
    case Coordinator::Status::too_many_clock_events:
      return fmt::format("the clock made more than {} events (--max-clock-events)",
                         options.max_clock_events);
    case Coordinator::Status::refused_answer:
      return "the checker refuses an answer of the solver: " + result.internal_error;
  }
  return {};
}

int status_of(const RunResult& result) {
  if (result.status == Coordinator::Status::refused_answer) return exit_internal;
  if (result.status == Coordinator::Status::too_many_clock_events) return exit_unusable;
  return result.failed > 0 ? exit_no : exit_ok;
}

/// Says on standard error why a run ended early.
void complain(const Mission& mission, const RunResult& result, const std::string& reason) {
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
  int status = exit_ok;
  for (const Mission& mission : missions) {
    report.begin_run(*mission.catalog, mission.script);
    const RunResult result = run_script(*mission.catalog, mission.script,
                                        to_coordinator_options(options, *mission.catalog), report);
    const std::string reason = describe_end(result, options);
    report.end_run(result, reason);
    if (!reason.empty()) complain(mission, result, reason);
    status = std::max(status, status_of(result));
  }
  report.end();
  return status;
}

/// Runs with a picture beside the report.
int draw_missions(const std::vector<Mission>& missions, const SolveOptions& options,
                  SolveReport& report) {
  HtmlReport picture;
  ReportPair both(report, picture);
  const int status = run_missions(missions, options, both);
  if (const auto error = write_atomically(*options.html, picture.page())) {
    cli::complain(fmt::format("cannot write {}: {}", quote(*options.html), *error));
    return std::max<int>(status, exit_unusable);
  }
  return status;
}

std::unique_ptr<SolveReport> make_report(const SolveOptions& options) {
  if (options.format == "json") {
    const JsonAdditions adds{!options.explain.why.empty(), options.explain.alternatives > 0};
    return std::make_unique<JsonReport>(stdout, adds);
  }
  return std::make_unique<TextReport>(wants_color(stdout) ? color_style() : plain_style(), stdout);
}

int solve(const SolveOptions& options) {
  const std::optional<std::vector<Mission>> missions = MissionLoader().load(options.paths);
  if (!missions || !knows_all_names(*missions, options.explain)) return exit_unusable;
  const std::unique_ptr<SolveReport> report = make_report(options);
  return options.html ? draw_missions(*missions, options, *report)
                      : run_missions(*missions, options, *report);
}

}  // namespace

void add_solve_command(CLI::App& program, int& status) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* const command = program.add_subcommand(
      "solve", "Runs scripted events through the coordinator, with the proven best answers.");
  command->footer(footer);
  command
      ->add_option("CATALOG SCRIPT", options->paths,
                   "The catalog (YAML or compiled), then event scripts: files,\n"
                   "folders, or - for standard input. Without a catalog each\n"
                   "script names its own (catalog: FILE).")
      ->option_text("...")
      ->required();
  command->add_option("--format", options->format, "text (the default) or json")
      ->option_text("FORMAT")
      ->check(CLI::IsMember({"text", "json"}));
  command
      ->add_option("--html", options->html,
                   "Write a page with a timeline of all runs to FILE, too: to\n"
                   "step through in a browser, or to print")
      ->option_text("FILE");
  add_explain_options(*command, options->explain);
  command
      ->add_option("--max-solutions", options->max_solutions,
                   "Take the best of the first M solutions, in the order of\n"
                   "the paper, instead of the proven optimum")
      ->option_text("M")
      ->check(whole_number(1));
  command
      ->add_option("--time-limit", options->time_limit,
                   "Stop each search after this time, take the best so far")
      ->option_text("SECONDS")
      ->check(seconds());
  command
      ->add_option("--max-nodes", options->max_nodes,
                   "Stop each search after N decisions, take the best so far")
      ->option_text("N")
      ->check(whole_number(1));
  command
      ->add_option("--tie-seed", options->tie_seed,
                   "Order behaviors of equal suitability at random, by the\n"
                   "seed N, instead of as in the catalog")
      ->option_text("N")
      ->check(whole_number(0));
  command
      ->add_option("--max-clock-events", options->max_clock_events,
                   "Give up when timeouts and reactive starts have made more\n"
                   "than N events (default: 1000000)")
      ->option_text("N")
      ->check(whole_number(1));
  command->callback([options, &status] { status = solve(*options); });
}

}  // namespace cbc::cli
