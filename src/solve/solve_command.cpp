#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "page/serve/server.h"
#include "runtime/base/text.h"
#include "solve/report/solve_report.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// A hint at the name that may have been meant.
std::string suggest(const CompiledCatalog& catalog, const std::string& name) {
  std::vector<std::string_view> names;
  for (const std::string_view task : catalog.task_names) names.push_back(task);
  for (const std::string_view behavior : catalog.behavior_names) names.push_back(behavior);
  return did_you_mean(nearest(name, names));
}

}  // namespace

CoordinatorOptions coordinator_options(const SolveOptions& options) {
  CoordinatorOptions result = coordinator_options(options.search);
  if (!options.time_limit.empty()) {
    result.search.time_limit = std::chrono::microseconds(parse_seconds(options.time_limit).value);
  }
  result.measure_time = options.stats;
  return result;
}

Questions questions_of(const SolveOptions& options, const CompiledCatalog& catalog) {
  Questions result{
      .rejections = true, .displaced = true, .alternatives = options.explain.alternatives};
  for (const std::string& name : options.explain.why) {
    // A task and a behavior may have the same name.
    if (const auto task = catalog.find_task(name)) result.why.push_back({true, *task});
    if (const auto behavior = catalog.find_behavior(name)) result.why.push_back({false, *behavior});
  }
  return result;
}

EventAdditions event_additions(const SolveOptions& options) {
  return {!options.explain.why.empty(), options.explain.alternatives > 0};
}

bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options) {
  for (const std::string& name : options.why) {
    if (catalog.find_task(name) || catalog.find_behavior(name)) continue;
    complain("--why: catalog {} has no task or behavior {}{}", quote(catalog.file), quote(name),
             suggest(catalog, name));
    return false;
  }
  return true;
}

namespace {

constexpr const char* solve_examples =
    "  cbc solve robot.yaml mission.yaml                     for a person to read\n"
    "  cbc solve robot.yaml mission.yaml --html page.html    also as a timeline\n"
    "  cbc solve robot.yaml missions/ --format junit         for CI\n"
    "  robot | cbc solve robot.cbc - --format jsonl          a live stream\n";

constexpr const char* solve_footer =
    "Exit status: 0 all expectations hold, 1 one does not, or a replay differs, 2 the input or the "
    "usage is wrong, 3 an internal error (please report it).\n"
    "\n"
    "Read more: man cbc-solve, man cbc-events (how to write a script)";

Values page_address() {
  return {"[ADDRESS:PORT]", "ADDRESS:PORT",
          [](const std::string& text) -> std::string {
            if (serve::read_address(text)) return {};
            return fmt::format(
                "expected a numeric ADDRESS:PORT (such as {}, [::1]:0, or 0.0.0.0:8080 for all "
                "networks), "
                "found {}; without a value, --serve stands last or before another option",
                serve::default_address, quote(text));
          },
          [] {
            return std::vector<NameWithHelp>{{serve::default_address, "this machine only"},
                                             {"127.0.0.1:0", "a free port"},
                                             {"0.0.0.0:8227", "also for other machines"}};
          }};
}

int solve(const SolveOptions& options) {
  if (options.paths.empty()) {
    return usage_error("solve", options.stream.replay ? "expected the catalog of the log"
                                                      : "expected a catalog and a script");
  }
  if (options.html && options.format == "jsonl") {
    return usage_error("solve",
                       "--html cannot be used with '--format jsonl': it draws whole runs; --serve "
                       "shows a stream, and 'cbc solve CATALOG LOG --html FILE' draws a recorded "
                       "one");
  }
  if (options.what_if.is_wanted) return solve_what_if(options);
  if (options.stream.replay) return replay(options);
  if (options.format == "jsonl") return solve_stream(options);
  return solve_missions(options);
}

void add_reasons(Command& command, ExplainOptions& options) {
  constexpr std::uint32_t most_alternatives = 1000;
  command.group("Reasons");
  for (Option* const option :
       {&command.option("--why", options.why, name_of("NAME", ValueKind::task_or_behavior),
                        "Why a task or behavior is as it is"),
        &command.option("--alternatives", options.alternatives,
                        whole_number("K", 1, most_alternatives),
                        "The K best configurations at each event")}) {
    option->not_with({"--format junit", "--format github"}, "it has no place for reasons");
  }
}

void add_what_if(Command& command, WhatIfOptions& options) {
  command.flag("--what-if", options.is_wanted, "List what could happen next in one mission")
      .only_with_values("--format", {"text", "json"})
      .not_with({"--html", "--brief", "--stats", "--jobs", "--why", "--alternatives"},
                "it reports moves from one state, not a run");
  command.option("--after", options.after, whole_number("N", 0), "After its event N")
      .without("the last one")
      .only_with({"--what-if"});
}

void add_stream_options(Command& command, StreamOptions& options) {
  command.group("Streams");
  command
      .option("--state-out", options.state_out, further_output("FILE"),
              "Save the state at the end of a stream (jsonl)")
      .only_with({"--format jsonl"});
  Values state = input("FILE", ValueKind::file);
  state.replaced_by = "--state-out";
  command
      .option("--state-in", options.state_in, state, "Continue from a saved state of the catalog")
      .only_with({"--format jsonl", "--replay"});
  command
      .option("--clock", options.clock, one_of("CLOCK", {"events", "real"}),
              "What moves time: events or real")
      .only_with({"--format jsonl"});
  command.option("--serve", options.serve, page_address(), "Show the stream in a browser")
      .value_or(serve::default_address)
      .only_with({"--format jsonl"});
  command
      .option("--replay", options.replay, input("LOG", ValueKind::file),
              "Run the events of a jsonl output again, and compare")
      .not_with({"--why", "--alternatives", "--brief", "--stats", "--what-if", "--jobs"},
                "it reports differences alone; without '--replay', a log runs as a script")
      .only_with_values("--format", {"text"});
  command
      .option("--to-script", options.to_script, further_output("FILE"),
              "Write these events as a script")
      .only_with({"--replay"});
}

}  // namespace

void add_solve_command(Program& program) {
  const auto options = std::make_shared<SolveOptions>();
  std::vector<std::string> formats = names_in(solve_formats());
  formats.emplace_back("jsonl");
  Command& command = program.add_command(
      "solve", "Runs event scripts on a catalog and computes proven best answers.",
      {{"[OPTION...] [CATALOG] SCRIPT...", "--format jsonl [OPTION...] CATALOG SCRIPT|-",
        "--replay LOG [OPTION...] CATALOG"},
       solve_examples,
       solve_footer});
  command.argument("CATALOG SCRIPT", options->paths, input("...", ValueKind::catalog_or_script),
                   "Catalog, unless scripts name it; scripts, folders or -");
  command.format_option(options->format, formats);
  command.option("--html", options->html, further_output("FILE"),
                 "Also write a page with a timeline");
  command.jobs_option(options->jobs, "Run N scripts at once");
  command.flag("--brief", options->brief, "Write one line for each event, no table")
      .only_with_values("--format", {"text", "github"});
  command.flag("--stats", options->stats, "Show the cost of searches, memory and time")
      .not_with({"--format junit", "--format github"}, "it has no place for times");
  command.add_confinement();
  add_reasons(command, options->explain);
  add_what_if(command, options->what_if);

  command.group("Search");
  add_search_limits(command, options->search);
  command.option("--time-limit", options->time_limit, seconds(),
                 "End the search of an event after this time");
  add_stream_options(command, options->stream);

  command.action([options] { return solve(*options); });
}

}  // namespace cbc::cli
