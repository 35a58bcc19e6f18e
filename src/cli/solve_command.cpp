#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/solve.h"
#include "support/wording.h"

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

namespace {

constexpr std::uint32_t most_alternatives = 1000;

/// The name that an unknown one may stand for.
std::string suggest(const CompiledCatalog& catalog, const std::string& name) {
  std::vector<std::string_view> names;
  for (const std::string_view task : catalog.task_names) names.push_back(task);
  for (const std::string_view behavior : catalog.behavior_names) names.push_back(behavior);
  return did_you_mean(nearest(name, names));
}

}  // namespace

void add_explain_options(CLI::App& command, ExplainOptions& options) {
  command
      .add_option("--why", options.why,
                  "Say of each accepted event why this task or behavior is as it is: where the "
                  "best alternative loses. Repeatable")
      ->option_text("NAME")
      ->check(stands_for(ValueKind::task_or_behavior))
      ->allow_extra_args(false);
  command
      .add_option("--alternatives", options.alternatives,
                  fmt::format("List the K best configurations of each accepted event (at most {})",
                              most_alternatives))
      ->option_text("K")
      ->check(whole_number(1, most_alternatives));
}

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

bool knows_names(const CompiledCatalog& catalog, const ExplainOptions& options) {
  for (const std::string& name : options.why) {
    if (catalog.find_task(name) || catalog.find_behavior(name)) continue;
    complain(fmt::format("--why: catalog {} has no task or behavior {}{}", quote(catalog.file),
                         quote(name), suggest(catalog, name)));
    return false;
  }
  return true;
}

void add_stream_options(CLI::App& command, StreamOptions& options) {
  command
      .add_option("--state-out", options.state_out,
                  "Save the state at the end of a stream (jsonl) to FILE; what is due at its last "
                  "instant is left to what goes on")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--state-in", options.state_in,
                  "Go on from a saved state of the same catalog, with its clock, its situation and "
                  "its reactive delay")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--replay", options.replay,
                  "Run the scripted events of LOG, which --format jsonl wrote, again, and compare, "
                  "byte for byte; with the same options")
      ->option_text("LOG")
      ->check(stands_for(ValueKind::file));
}

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
