#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/input.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "coverage/report/coverage_report.h"
#include "page/serve/server.h"
#include "runtime/base/text.h"
#include "solve/solve.h"
#include "sweep/report/sweep_report.h"

namespace cbc::cli {
namespace {

/// The explanations that are wanted for a catalog, which must know all names.
ExplanationOptions explanation_for(const CompiledCatalog& catalog, const ExplainOptions& options) {
  ExplanationOptions result;
  result.alternatives = options.alternatives;
  for (const std::string& name : options.why) {
    // A task and a behavior may have the same name.
    if (const auto task = catalog.find_task(name)) result.why.push_back({true, *task});
    if (const auto behavior = catalog.find_behavior(name)) result.why.push_back({false, *behavior});
  }
  return result;
}

/// A hint at the name that may have been meant.
std::string suggest(const CompiledCatalog& catalog, const std::string& name) {
  std::vector<std::string_view> names;
  for (const std::string_view task : catalog.task_names) names.push_back(task);
  for (const std::string_view behavior : catalog.behavior_names) names.push_back(behavior);
  return did_you_mean(nearest(name, names));
}

}  // namespace

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
  // Formats for programs have it on request only.
  result.explain.displaced =
      options.format == "text" || options.format == "junit" || options.format == "github";
  result.measure_time = options.stats;
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
    "  cbc solve robot.yaml mission.yaml         one script, for a person to read\n"
    "  cbc solve robot.yaml mission.yaml --html mission.html\n"
    "                                            also a timeline for a browser\n"
    "  cbc solve robot.yaml mission.yaml --why DRIVE --alternatives 3\n"
    "                                            explain DRIVE and list the three\n"
    "                                            best configurations at each event\n";

constexpr const char* solve_footer =
    "More examples:\n"
    "  cbc solve robot.yaml missions/ --format json\n"
    "                                            all scripts of a folder, as JSON\n"
    "  echo '[{start: DRIVE}]' | cbc solve robot.yaml -\n"
    "                                            a script from standard input\n"
    "  cbc solve robot.yaml missions/ --format junit > results.xml\n"
    "                                            for CI, a test suite per script\n"
    "  robot | cbc solve robot.cbc - --format jsonl > log.jsonl\n"
    "                                            a live stream, one event per line\n"
    "  robot | cbc solve robot.cbc - --format jsonl --serve > log.jsonl\n"
    "                                            the same, shown in a browser\n"
    "  cbc solve --replay log.jsonl robot.cbc    run the log again and compare\n"
    "  cbc solve robot.yaml mission.yaml --max-solutions 5\n"
    "                                            best of the first 5 solutions\n"
    "  cbc solve robot.yaml --sweep 1000         random events and faults\n"
    "  cbc solve robot.yaml missions/ --coverage\n"
    "                                            what the scripts test, and miss\n"
    "\n"
    "How an answer is chosen: of all consistent sets of behaviors, the best one serves the most "
    "requests (if equally many, the more important ones); then it has the highest product of the "
    "suitabilities of all that runs. Where these are equal, as few supporting tasks run as "
    "possible, and then as few behaviors change as possible.\n"
    "\n"
    "In the text, the lines below an event are what changes: the priority of the request behind "
    "it (. for none), + for an activation or - for a deactivation, and whether that is ok (Y or "
    "N).\n"
    "\n"
    "Exit status: 0 all expectations hold, 1 one does not, a replay differs, or the coverage is "
    "below --fail-under, 2 the input or the usage is wrong, 3 an internal error (please report "
    "it).\n"
    "\n"
    "Read more: man cbc-solve, man cbc-events (how to write a script)";

constexpr const char* default_address = "127.0.0.1:8227";

Values page_address() {
  Values values;
  values.placeholder = "[ADDRESS:PORT]";
  values.expected = "ADDRESS:PORT";
  values.names = [] {
    return std::vector<NameWithHelp>{{default_address, "this machine only"},
                                     {"127.0.0.1:0", "a free port"},
                                     {"0.0.0.0:8227", "also for other machines"}};
  };
  values.check = [](const std::string& text) -> std::string {
    if (serve::read_address(text)) return {};
    return fmt::format(
        "expected a numeric ADDRESS:PORT (such as {}, [::1]:0, or 0.0.0.0:8080 for all networks), "
        "found {}; without a value, --serve stands last or before another option",
        default_address, quote(text));
  };
  return values;
}

/// Those of --format where runs are reported.
std::vector<std::string> formats_of_runs() {
  std::vector<std::string> formats = names_in(solve_formats());
  formats.emplace_back("jsonl");
  return formats;
}

/// Those of --format in all.
std::vector<std::string> all_formats() {
  std::vector<std::string> formats = formats_of_runs();
  for (const std::string& format : names_in(coverage_formats())) {
    if (std::find(formats.begin(), formats.end(), format) == formats.end()) {
      formats.push_back(format);
    }
  }
  return formats;
}

/// Says what is missing on the command line; empty if nothing is.
std::string find_missing(const SolveOptions& options) {
  if (!options.paths.empty()) return {};
  if (options.sweep.merge) {
    return options.coverage.file ? "expected the catalog, and JSON results of --coverage to merge"
                                 : "expected the JSON results of the shards to merge";
  }
  if (options.sweep.is_wanted()) return "expected the catalog of the sweep";
  if (options.stream.replay) return "expected the catalog of the log";
  return "expected a catalog and a script";
}

/// About a format that what is reported does not have; empty if it has it.
std::string find_bad_format(const SolveOptions& options) {
  const bool is_of_sweep = options.sweep.is_wanted() && !options.coverage.file;
  const std::vector<std::string> formats = options.coverage.replaces_runs()
                                               ? names_in(coverage_formats())
                                           : is_of_sweep ? names_in(sweep_formats())
                                                         : formats_of_runs();
  if (std::find(formats.begin(), formats.end(), options.format) != formats.end()) return {};
  const char* const what = options.coverage.replaces_runs() ? "--coverage"
                           : options.sweep.merge            ? "--merge"
                           : is_of_sweep                    ? "--sweep"
                                                            : nullptr;
  if (what == nullptr) {
    return fmt::format("--format {} can only be used with --coverage", options.format);
  }
  return fmt::format("{} can only be used with --format {}, not {}", what, join_with_or(formats),
                     options.format);
}

int solve(const SolveOptions& options) {
  if (const std::string missing = find_missing(options); !missing.empty()) {
    return usage_error("solve", missing);
  }
  if (const std::string fault = find_bad_format(options); !fault.empty()) {
    return usage_error("solve", fault);
  }
  if (options.html && options.format == "jsonl" && !options.stream.replay) {
    return usage_error("solve",
                       "--html cannot be used with '--format jsonl': it draws whole runs; --serve "
                       "shows a stream, and --replay LOG --html FILE draws a recorded one");
  }
  if (options.sweep.merge && options.coverage.file) return merge_coverage(options);
  if (options.sweep.is_wanted()) return run_sweep(options);
  if (options.stream.replay) return replay_stream(options);
  if (options.format == "jsonl") return solve_stream(options);
  return solve_missions(options);
}

}  // namespace

void add_solve_command(Program& program) {
  constexpr const char* reports_no_runs =
      "without a FILE, --coverage stands in place of the runs; --coverage FILE writes it beside "
      "them";
  constexpr std::uint32_t most_alternatives = 1000;
  const auto options = std::make_shared<SolveOptions>();
  const std::vector<std::string> formats = all_formats();
  Command& command = program.add_command(
      "solve", "Runs event scripts on a catalog and computes proven best answers.",
      {{"[OPTION...] [CATALOG] SCRIPT...", "--format jsonl [OPTION...] CATALOG SCRIPT|-",
        "--replay LOG [OPTION...] CATALOG", "--sweep N [OPTION...] CATALOG",
        "--merge [OPTION...] SHARD...", "--coverage --merge [OPTION...] CATALOG RESULT..."},
       solve_examples,
       solve_footer});
  command.argument("CATALOG SCRIPT", options->paths, input("...", ValueKind::catalog_or_script),
                   "The catalog (YAML or compiled), then event scripts: files, folders, or - for "
                   "standard input. Without a catalog each script names its own (catalog: FILE).");
  command.option("--format", options->format, one_of("FORMAT", formats),
                 fmt::format("{} (default: {}); jsonl writes each event as a line, as soon as it "
                             "is solved, and takes - for a stream of events, one per line (JSON, "
                             "or a mapping in braces); html and lcov only with --coverage",
                             join_with_or(formats), formats.front()));
  command
      .option(
          "--html", options->html, further_output("FILE"),
          "Also write an HTML page with a timeline of all runs, or of a replay, to FILE, to step "
          "through in a browser, or to print")
      .not_with({"--sweep", "--merge"}, "it draws whole runs");
  command.option("-j,--jobs", options->jobs, whole_number("N", 1),
                 "Run up to N scripts, or sequences of a sweep, at once (default: the number of "
                 "processors); the output is the same for any N");
  command
      .flag("--brief", options->brief,
            "Write one line for each event, with its changes, instead of a table of them")
      .not_with({"--sweep", "--merge"}, "a sweep does not report single events")
      .not_with({"--replay"}, "a replay reports no events, only a difference")
      .not_with({"--why", "--alternatives"}, "one line has no room for reasons")
      .not_with({"--coverage -"}, reports_no_runs)
      .only_with_values("--format", {"text"});
  command
      .flag("--stats", options->stats,
            "Show the cost of each search, the mean, minimum and maximum, and the memory and time "
            "of the process; with a sweep, also report times")
      .not_with({"--replay"}, "times cannot be repeated")
      .not_with({"--coverage -"}, reports_no_runs)
      .not_with({"--format junit", "--format github"}, "it has no place for times");
  command.add_confinement();

  command.group("Reasons");
  for (Option* const option :
       {&command.option("--why", options->explain.why, name_of("NAME", ValueKind::task_or_behavior),
                        "Explain for each accepted event why this task or behavior is as it is: "
                        "where the best alternative is worse. May be repeated"),
        &command.option(
            "--alternatives", options->explain.alternatives,
            whole_number("K", 1, most_alternatives),
            fmt::format("List the K best configurations of each accepted event (at most {})",
                        most_alternatives))}) {
    option->not_with({"--sweep", "--merge"}, "a sweep does not report single events")
        .not_with({"--coverage -"}, reports_no_runs)
        .not_with({"--format junit", "--format github"}, "it has no place for reasons");
  }

  command.group("Search");
  const std::string of_shards = "the shards were solved already";
  command
      .option("--max-solutions", options->max_solutions, whole_number("M", 1),
              "Take the best of the first M solutions, in the order of the paper, instead of "
              "the proven optimum")
      .not_with({"--merge"}, of_shards);
  command
      .option("--time-limit", options->time_limit, seconds(),
              "Stop the search of each event after this time and take the best answer so far")
      .not_with({"--sweep", "--merge"},
                "the result must not depend on the machine; use --max-nodes");
  command
      .option("--max-nodes", options->max_nodes, whole_number("N", 1),
              "Stop the search of each event after N decisions and take the best answer so far")
      .not_with({"--merge"}, of_shards);
  command
      .option("--tie-seed", options->tie_seed, whole_number("N", 0),
              "Order behaviors of equal suitability at random, with the seed N, instead of as in "
              "the catalog")
      .not_with({"--merge"}, of_shards);
  command
      .option("--max-clock-events", options->max_clock_events, whole_number("N", 1),
              "Give up after more than N timeouts and reactive starts, attempts included "
              "(default: 1000000)")
      .not_with({"--merge"}, of_shards);

  command.group("Streams");
  command
      .option("--state-out", options->stream.state_out, further_output("FILE"),
              "Save the state at the end of a stream (jsonl) to FILE; timeouts and starts due at "
              "its last instant are left to the stream that continues")
      .only_with({"--format jsonl", "--replay"});
  Values state = input("FILE", ValueKind::file);
  state.replaced_by = "--state-out";
  command
      .option("--state-in", options->stream.state_in, state,
              "Continue from a saved state of the same catalog, with its time, situation and "
              "reactive delay, and without timeouts if the saved run had none")
      .only_with({"--format jsonl", "--replay"});
  command
      .option(
          "--clock", options->stream.clock, one_of("CLOCK", {"events", "real"}),
          "Time of lines without at or wait: that of the event before (events, the default), or "
          "since the start (real); then timeouts and reactive starts happen between lines")
      .only_with({"--format jsonl"})
      .not_with({"--replay"}, "a replay takes its times from the log");
  command
      .option("--serve", options->stream.serve, page_address(),
              fmt::format("Show the stream in a browser while it runs, at this address (default: "
                          "{}; port 0: a free one), which is printed to standard error",
                          default_address))
      .value_or(default_address)
      .only_with({"--format jsonl"})
      .not_with({"--replay"}, "a log is complete, so --html draws it");
  command
      .option("--replay", options->stream.replay, input("LOG", ValueKind::file),
              "Run the events of LOG (from --format jsonl) again with the same options, and "
              "compare byte for byte")
      .not_with({"--sweep", "--merge"})
      .only_with_values("--format", {"jsonl", "text"});

  command.group("Coverage");
  add_coverage_options(command, options->coverage);

  command.group("Sweeps");
  add_sweep_options(command, options->sweep);
  command.action([options] { return solve(*options); });
}

}  // namespace cbc::cli
