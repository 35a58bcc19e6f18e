#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/command_line/limits.h"
#include "core/files/file_set.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "runtime/base/text.h"
#include "sweep/engine/sweep.h"
#include "sweep/report/sweep_report.h"

namespace cbc::cli {
namespace {

struct SweepOptions {
  std::vector<std::string> paths;
  std::string sequences = "1000";
  std::uint64_t seed = 1;
  std::uint32_t events = SweepShape{}.events;
  std::int32_t priorities = SweepShape{}.priorities;
  std::string failures = "0.3";
  std::string faults = "0.1";
  std::optional<std::string> slowest;
  std::optional<std::string> slowest_by_time;
  std::string format = "text";
  std::optional<std::string> against;
  std::vector<std::string> renamed;
  bool allow_missing = false;
  std::optional<std::string> scripts;
  std::optional<std::uint64_t> jobs;
  bool stats = false;
  SearchLimits search;
};

Decimal parse_probability(const std::string& text) {
  return parse_decimal(text, 6, 0, one_million);
}

Values probability() {
  return {"SHARE", "a number from 0 to 1", [](const std::string& text) -> std::string {
            if (parse_probability(text).error == DecimalError::no_error) return {};
            return fmt::format("expected a number from 0 to 1, with at most 6 decimals, found {}",
                               quote(text));
          }};
}

/// Sets the sequences by "1000" or "1001-2000". False: it is neither.
bool parse_sequences(std::string_view text, SweepSettings& settings) {
  constexpr std::uint64_t most = 1'000'000'000;
  const auto read = [&](std::string_view part, std::uint64_t& number) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    return error == std::errc() && end == part.data() + part.size() && number >= 1 &&
           number <= most;
  };
  const std::size_t dash = text.find('-');
  std::uint64_t first = 1;
  std::uint64_t last = 0;
  if (dash != std::string_view::npos && !read(text.substr(0, dash), first)) return false;
  if (!read(dash == std::string_view::npos ? text : text.substr(dash + 1), last)) return false;
  if (first > last) return false;
  settings.first = first - 1;
  settings.sequences = last - settings.first;
  return true;
}

Values sequence_range() {
  return {"N", "a number of sequences", [](const std::string& text) -> std::string {
            SweepSettings settings;
            if (parse_sequences(text, settings)) return {};
            return fmt::format(
                "expected a number from 1 to 1000000000, or a range of them such as 1001-2000, "
                "found {}",
                quote(text));
          }};
}

SweepSettings settings_of(const SweepOptions& options) {
  SweepSettings settings;
  parse_sequences(options.sequences, settings);
  settings.seed = options.seed;
  settings.shape.events = options.events;
  settings.shape.priorities = options.priorities;
  settings.shape.failures = static_cast<Millionths>(parse_probability(options.failures).value);
  settings.shape.faults = static_cast<Millionths>(parse_probability(options.faults).value);
  settings.search = {options.search.max_solutions, options.search.max_nodes,
                     options.search.max_clock_events};
  return settings;
}

std::shared_ptr<const CompiledCatalog> load_swept(const std::vector<std::string>& paths) {
  if (paths.size() != 1) {
    complain("a sweep takes one catalog and no script, found {} files", paths.size());
    return nullptr;
  }
  std::shared_ptr<const CompiledCatalog> catalog = load_catalog(paths.front());
  if (catalog != nullptr && catalog->tasks.empty()) {
    complain("catalog {} has no tasks to sweep", quote(display_name(paths.front())));
    return nullptr;
  }
  return catalog;
}

int report_failure(const SweepFailure& failure, const SweepSettings& settings) {
  if (failure.status == Coordinator::Status::refused_answer) {
    complain("sequence {}: the checker rejects an answer of the solver: {}", failure.sequence,
             failure.internal_error);
    complain(
        "this is a bug in cbc, not in the catalog; please report it with the catalog and "
        "this script:");
    fmt::print(stderr, "{}", failure.script);
    return exit_internal;
  }
  complain(
      "sequence {}: the clock made more than {} events (--max-clock-events) in "
      "this script:",
      failure.sequence, settings.search.max_clock_events);
  fmt::print(stderr, "{}", failure.script);
  return exit_unusable;
}

int write_slowest(const std::optional<std::string>& path,
                  const std::optional<SlowestEvent>& slowest) {
  if (!path) return exit_ok;
  if (!slowest) {
    return complain("there is no script for {}: no event needed a search", quote(*path));
  }
  return write_output(*path, slowest->script);
}

bool can_write_slowest(const SweepOptions& options) {
  return (!options.slowest || can_write_output(*options.slowest)) &&
         (!options.slowest_by_time || can_write_output(*options.slowest_by_time));
}

/// Writes the script of each difference. Returns the exit status.
int write_scripts(const SweptComparison& comparison, const SweepOptions& options) {
  if (!options.scripts) return exit_ok;
  int status = make_folder(*options.scripts);
  if (status != exit_ok) return status;
  for (std::size_t place = 0; place < comparison.differences.size(); ++place) {
    const std::filesystem::path file = std::filesystem::path(*options.scripts) /
                                       fmt::format("difference-{}.mission.yaml", place + 1);
    status = std::max(status, write_output(file.string(), comparison.differences[place].script));
  }
  return status;
}

/// The exit status of a comparison.
int judge(const SweptComparison& comparison, const SweepOptions& options) {
  const CatalogNames& names = comparison.names;
  const bool is_missing = !names.only_old.empty() || !names.only_new.empty();
  const bool is_alike = comparison.sequences == 0 && comparison.events > 0;
  return is_alike && (!is_missing || options.allow_missing) ? exit_ok : exit_no;
}

int report(SweepResult result, const SweepOptions& options) {
  int status = std::max(write_slowest(options.slowest, result.slowest),
                        write_slowest(options.slowest_by_time, result.times->slowest));
  if (result.against) {
    status = std::max(
        {status, write_scripts(*result.against, options), judge(*result.against, options)});
  }
  if (!options.stats) result.times.reset();
  return std::max(status, write_report(sweep_formats(), options.format, result, "-"));
}

int run_sweep(const SweepOptions& options) {
  if (options.paths.empty()) return usage_error("sweep", "expected the catalog of the sweep");
  const std::shared_ptr<const CompiledCatalog> catalog = load_swept(options.paths);
  if (catalog == nullptr || !can_write_slowest(options)) return exit_unusable;
  std::shared_ptr<const CompiledCatalog> old_catalog;
  std::optional<OldVersion> old_version;
  if (options.against) {
    old_catalog = load_catalog(*options.against);
    if (old_catalog == nullptr) return exit_unusable;
    old_version.emplace(OldVersion{*old_catalog, {}});
    const std::string fault =
        add_renames(*old_catalog, *catalog, options.renamed, old_version->renames);
    if (!fault.empty()) return usage_error("sweep", "--renamed: {}", fault);
  }
  const SweepSettings settings = settings_of(options);
  Progress progress("sweeping", 1);
  progress.begin(std::string(catalog->file));
  SweepOutcome outcome = sweep(
      *catalog, settings, thread_count(options.jobs),
      [&](std::uint64_t done) {
        progress.show(fmt::format(" ({} %)", done * 100 / settings.sequences));
      },
      old_version);
  progress.clear();
  if (outcome.failure) return report_failure(*outcome.failure, settings);
  return report(std::move(outcome.result), options);
}

constexpr const char* sweep_examples =
    "  cbc sweep robot.yaml                      random events and faults\n"
    "  cbc sweep robot.yaml --sequences 1001-2000   a part of a longer sweep\n"
    "  cbc sweep new.yaml --against old.yaml     what do they decide differently?\n";

constexpr const char* sweep_footer =
    "Exit status: 0 success, 1 --against found a difference, 2 the input or the usage is wrong, 3 "
    "an internal error (please report "
    "it).\n"
    "\n"
    "Read more: man cbc-sweep";

}  // namespace

void add_sweep_command(Program& program) {
  constexpr std::int64_t most_events = 1'000'000;
  const auto options = std::make_shared<SweepOptions>();
  const std::vector<std::string> formats = names_in(sweep_formats());
  Command& command = program.add_command(
      "sweep", "Runs random events and faults on a catalog, and reports what happened in them.",
      {{"[OPTION...] CATALOG"}, sweep_examples, sweep_footer});
  command.argument("CATALOG", options->paths, input("", ValueKind::catalog),
                   "The catalog: YAML or compiled, or - for standard input");
  command.format_option(options->format, formats);
  command.jobs_option(options->jobs, "Run N sequences at once");
  command.flag("--stats", options->stats, "Also report times");
  command.option("--slowest", options->slowest, further_output("FILE"),
                 "Write the event with the most nodes as a script");
  command.option("--slowest-by-time", options->slowest_by_time, further_output("FILE"),
                 "Write the slowest event as a script");
  command.add_confinement();

  command.group("Comparison");
  command.option("--against", options->against, input("OLD", ValueKind::catalog),
                 "Report what CATALOG and OLD decide differently");
  command.option("--renamed", options->renamed, old_and_new_name(), "OLD is called NEW in CATALOG")
      .only_with({"--against"});
  command
      .flag("--allow-missing", options->allow_missing, "What only one of them has does not count")
      .only_with({"--against"});
  command
      .option("--scripts", options->scripts, folder(), "Write a script for each difference to DIR")
      .only_with({"--against"});

  command.group("Sequences");
  command.option("--sequences", options->sequences, sequence_range(),
                 "Run N sequences, or those from FIRST-LAST");
  command.option("--seed", options->seed, whole_number("S", 0), "Seed of the sequences");
  command.option("--events", options->events, whole_number("E", 1, most_events),
                 "Events in each sequence");
  command.option("--priorities", options->priorities, whole_number("P", 1, 1'000'000),
                 "Priorities of requests, from 1 to P");
  command.option("--failures", options->failures, probability(),
                 "Share of finishes that are failures");
  command.option("--faults", options->faults, probability(), "Share of faults and situations");

  command.group("Search");
  add_search_limits(command, options->search);
  command.action([options] { return run_sweep(*options); });
}

}  // namespace cbc::cli
