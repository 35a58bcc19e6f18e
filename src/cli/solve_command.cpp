#include "cli/solve_command.h"

#include <algorithm>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/help_format.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/solve_missions.h"
#include "cli/solve_options.h"
#include "cli/solve_stream.h"
#include "cli/sweep_command.h"
#include "cli/validators.h"
#include "cli/value_kind.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr const char* solve_examples =
    "  cbc solve robot.yaml mission.yaml         one script, for a person to read\n"
    "  cbc solve robot.yaml mission.yaml --html mission.html\n"
    "                                            a picture, too, for a browser\n"
    "  cbc solve robot.yaml mission.yaml --why HOVER --alternatives 3\n"
    "                                            why HOVER is as it is, and the three\n"
    "                                            best configurations, of each event\n";

constexpr const char* solve_footer =
    "More examples:\n"
    "  cbc solve robot.yaml missions/ --format json\n"
    "                                            all scripts of a folder, as JSON\n"
    "  echo '[{start: TAKE_OFF}]' | cbc solve robot.yaml -\n"
    "                                            a script from standard input\n"
    "  cbc solve robot.yaml missions/ --format junit > results.xml\n"
    "                                            for CI, a test suite per script\n"
    "  robot | cbc solve robot.cbc - --format jsonl > log.jsonl\n"
    "                                            events as they come, one on a line\n"
    "  cbc solve --replay log.jsonl robot.cbc    the same again: is it still so?\n"
    "  cbc solve robot.yaml mission.yaml --max-solutions 5\n"
    "                                            best of the first 5 solutions\n"
    "  cbc solve robot.yaml --sweep 1000         random events and faults\n"
    "\n"
    "In the text, P is the priority of the request behind a change, T is + for an activation and "
    "- for a deactivation, S says whether it succeeded (Y) or failed (N).\n"
    "\n"
    "Exit status: 0 all expectations hold, 1 one does not, 2 the input or the usage is wrong, 3 "
    "an internal error (please report it).\n"
    "\n"
    "Read more: man cbc-solve, man cbc-events (how to write a script)";

bool is_one_of(const std::string& format, std::initializer_list<std::string_view> formats) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

/// Which options do not go together, or empty. What is not refused here has its effect.
std::string find_clash(const SolveOptions& options) {
  const bool is_sweep = options.sweep.is_wanted();
  const bool is_replay = options.stream.replay.has_value();
  const bool is_stream = is_replay || options.format == "jsonl";
  const bool has_reasons = !options.explain.why.empty() || options.explain.alternatives > 0;
  const bool has_state = options.stream.state_in || options.stream.state_out;
  for (const auto& [name, file] :
       {std::pair("--html", options.html), std::pair("--state-out", options.stream.state_out),
        std::pair("--slowest", options.sweep.slowest),
        std::pair("--slowest-by-time", options.sweep.slowest_by_time)}) {
    if (file == "") return fmt::format("expected the name of a file after {}", name);
    if (file == "-") return fmt::format("{} needs a file, as standard output has the report", name);
  }
  const auto& [slowest, by_time] = std::tie(options.sweep.slowest, options.sweep.slowest_by_time);
  if (slowest && by_time && (*slowest == *by_time || is_same_file(*slowest, *by_time))) {
    return "--slowest and --slowest-by-time need a file each";
  }
  if (is_sweep) {
    if (!is_one_of(options.format, {"text", "json"})) {
      return fmt::format("a sweep has the formats text and json, not {}", options.format);
    }
    if (options.html) return "--html draws scripts, not a sweep";
    if (has_reasons) return "--why and --alternatives are for scripts, not for a sweep";
    if (is_replay || has_state)
      return "--replay, --state-in and --state-out do not go with a sweep";
    const bool has_search_options = options.max_solutions > 0 || options.max_nodes > 0 ||
                                    options.tie_seed ||
                                    options.max_clock_events != SolveOptions{}.max_clock_events;
    if (options.sweep.merge && has_search_options) {
      return "--merge takes the options of the search from the shards";
    }
    if (!options.time_limit.empty()) {
      return "a sweep has no --time-limit, as its result must not depend on the machine; "
             "--max-nodes is such a limit";
    }
    return {};
  }
  if (options.sweep.slowest || options.sweep.slowest_by_time) {
    return "--slowest and --slowest-by-time are for a sweep (--sweep or --merge)";
  }
  if (is_replay && !is_one_of(options.format, {"text", "jsonl"})) {
    return fmt::format("--replay writes the format jsonl, not {}", options.format);
  }
  if (is_replay && options.stats) return "--replay cannot repeat times; leave out --stats";
  if (is_stream && options.html) return "--html goes with a script, not with jsonl or --replay";
  if (!is_stream && has_state)
    return "--state-in and --state-out go with --format jsonl or --replay";
  if (is_one_of(options.format, {"junit", "github"})) {
    if (options.stats) return fmt::format("--stats has no place in the format {}", options.format);
    if (has_reasons) {
      return fmt::format("--why and --alternatives have no place in the format {}", options.format);
    }
  }
  return {};
}

/// An output that would overwrite an input; empty if none does.
std::string find_overwritten(const SolveOptions& options) {
  std::vector<std::string> inputs = options.paths;
  if (options.stream.replay) inputs.push_back(*options.stream.replay);
  for (const auto& output : {options.html, options.stream.state_out, options.sweep.slowest,
                             options.sweep.slowest_by_time}) {
    if (!output) continue;
    for (const std::string& input : inputs) {
      if (!is_same_file(input, *output)) continue;
      return fmt::format("the output {} is an input, too", quote(*output));
    }
  }
  return {};
}

/// What is missing on the command line; empty if nothing is.
std::string find_missing(const SolveOptions& options) {
  if (!options.paths.empty()) return {};
  if (options.sweep.merge) return "expected the files of the shards to merge";
  if (options.sweep.is_wanted()) return "expected the catalog of the sweep";
  if (options.stream.replay) return "expected the catalog of the log";
  return "expected a catalog and a script";
}

int solve(const SolveOptions& options) {
  if (const std::string missing = find_missing(options); !missing.empty()) {
    return usage_error("solve", missing);
  }
  if (const std::string clash = find_clash(options); !clash.empty()) {
    return usage_error("solve", clash);
  }
  if (const std::string output = find_overwritten(options); !output.empty()) {
    return usage_error("solve", output);
  }
  if (options.sweep.is_wanted()) return run_sweep(options);
  if (options.stream.replay) return replay_stream(options);
  if (options.format == "jsonl") return solve_stream(options);
  return solve_missions(options);
}

}  // namespace

void add_solve_command(CLI::App& program, int& status) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* const command = program.add_subcommand(
      "solve", "Runs scripted events through the coordinator, with the proven best answers.");
  set_help(*command,
           {{"[OPTION...] [CATALOG] SCRIPT...", "--format jsonl [OPTION...] CATALOG SCRIPT|-",
             "--replay LOG [OPTION...] CATALOG", "--sweep N [OPTION...] CATALOG",
             "--merge [OPTION...] SHARD..."},
            solve_examples,
            solve_footer});
  command
      ->add_option("CATALOG SCRIPT", options->paths,
                   "The catalog (YAML or compiled), then event scripts: files, folders, or - for "
                   "standard input. Without a catalog each script names its own (catalog: FILE).")
      ->option_text("...")
      ->check(stands_for(ValueKind::catalog_or_script));
  command
      ->add_option("--format", options->format,
                   "text (the default), json, junit, github; or jsonl: each event as a line, as "
                   "soon as it is solved; - is then a stream of events, one on a line (JSON, or a "
                   "mapping in braces)")
      ->option_text("FORMAT")
      ->check(one_of({"text", "json", "junit", "github", "jsonl"}));
  command
      ->add_option("--html", options->html,
                   "Write a page with a timeline of all runs to FILE, too: to step through in a "
                   "browser, or to print")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      ->add_option("-j,--jobs", options->jobs,
                   "Run up to N scripts, or sequences of a sweep, at once (default: the number of "
                   "processors); the output is the same for any N")
      ->option_text("N")
      ->check(whole_number(1));
  command->add_flag("--stats", options->stats,
                    "Show what each search took, and mean, least and greatest of all, with the "
                    "memory and the time of the process; of a sweep, report times, too");
  command->option_defaults()->group("Reasons");
  add_explain_options(*command, options->explain);
  command->option_defaults()->group("Search");
  command
      ->add_option("--max-solutions", options->max_solutions,
                   "Take the best of the first M solutions, in the order of the paper, instead of "
                   "the proven optimum")
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
                   "Order behaviors of equal suitability at random, by the seed N, instead of as "
                   "in the catalog")
      ->option_text("N")
      ->check(whole_number(0));
  command
      ->add_option("--max-clock-events", options->max_clock_events,
                   "Give up when timeouts and reactive starts have made more than N events "
                   "(default: 1000000)")
      ->option_text("N")
      ->check(whole_number(1));
  command->option_defaults()->group("Streams");
  add_stream_options(*command, options->stream);
  command->option_defaults()->group("Sweeps");
  add_sweep_options(*command, options->sweep);
  command->callback([options, &status] { status = solve(*options); });
}

}  // namespace cbc::cli
