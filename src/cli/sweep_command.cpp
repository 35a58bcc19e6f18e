#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <utility>
#include <variant>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/solve.h"
#include "report/sweep_report.h"
#include "sweep/sweep.h"

namespace cbc::cli {
namespace {

constexpr std::int64_t most_sequences = 1'000'000'000;
constexpr std::int64_t most_events = 1'000'000;

Decimal parse_probability(const std::string& text) {
  return parse_decimal(text, 6, 0, one_million);
}

CLI::Validator probability() {
  const auto check = [](const std::string& text) -> std::string {
    if (parse_probability(text).error == DecimalError::no_error) return {};
    return fmt::format("expected a number from 0 to 1, with at most 6 decimals, found {}",
                       quote(text));
  };
  return {check, ""};
}

/// "2/8"; empty if it is none.
std::optional<SweepShard> parse_shard(const std::string& text) {
  SweepShard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec != std::errc() || index.ptr == end || *index.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(index.ptr + 1, end, shard.count);
  if (count.ec != std::errc() || count.ptr != end) return std::nullopt;
  if (shard.index < 1 || shard.index > shard.count || shard.count > most_shards) {
    return std::nullopt;
  }
  return shard;
}

CLI::Validator shard_of_sweep() {
  const auto check = [](const std::string& text) -> std::string {
    if (parse_shard(text)) return {};
    return fmt::format("expected I/N, such as 3/8, with I from 1 to N and N at most {}, found {}",
                       most_shards, quote(text));
  };
  return {check, ""};
}

}  // namespace

void add_sweep_options(CLI::App& command, SweepOptions& options) {
  CLI::Option* const sweep =
      command
          .add_option("--sweep", options.sequences,
                      "Run N random event sequences on the catalog instead of scripts, and report "
                      "what happened in them")
          ->option_text("N")
          ->check(whole_number(1, most_sequences));
  const auto add = [&](const char* name, auto& value, const char* text, const char* help) {
    return command.add_option(name, value, help)->option_text(text)->needs(sweep);
  };
  add("--seed", options.seed, "S", "Draw other sequences (default: 1)")->check(whole_number(0));
  add("--events", options.events, "E", "Events in each sequence (default: 100)")
      ->check(whole_number(1, most_events));
  add("--priorities", options.priorities, "P", "Requests have priorities from 1 to P (default: 3)")
      ->check(whole_number(1, 1'000'000));
  add("--failures", options.failures, "SHARE",
      "Of the finished behaviors, from 0 to 1, how many have failed (default: 0.3)")
      ->check(probability());
  add("--faults", options.faults, "SHARE",
      "Of the events, from 0 to 1, how many are faults, repairs and changes of the situation "
      "(default: 0.1)")
      ->check(probability());
  add("--shard", options.shard, "I/N", "Run the I-th of N shares of the sweep only")
      ->check(shard_of_sweep());
  CLI::Option* const merge = command
                                 .add_flag("--merge", options.merge,
                                           "Merge the files: the results of all shards, as JSON, "
                                           "become that of one run")
                                 ->option_text(" ")
                                 ->check(stands_for(ValueKind::shard));
  command
      .add_option("--slowest", options.slowest,
                  "Write the event with the most nodes to FILE, as a script that ends with it")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--slowest-by-time", options.slowest_by_time,
                  "The same for the event that took longest")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  sweep->excludes(merge);
}

SweepSettings settings_of(const SweepOptions& options) {
  SweepSettings settings;
  settings.sequences = options.sequences.value_or(1);
  settings.seed = options.seed;
  settings.shape.events = options.events;
  settings.shape.priorities = options.priorities;
  settings.shape.failures = static_cast<Millionths>(parse_probability(options.failures).value);
  settings.shape.faults = static_cast<Millionths>(parse_probability(options.faults).value);
  settings.shard = parse_shard(options.shard).value_or(SweepShard{});
  return settings;
}

namespace {

/// The result of a catalog of 300,000 behaviors is as large. Larger ones are refused, as a text of
/// JSON takes many times its size in memory.
constexpr std::size_t largest_shard = std::size_t{64} << 20U;

SweepSettings to_settings(const SolveOptions& options) {
  SweepSettings settings = settings_of(options.sweep);
  settings.search = {options.max_solutions, options.max_nodes, options.tie_seed,
                     options.max_clock_events};
  return settings;
}

std::shared_ptr<const CompiledCatalog> load_swept(const std::vector<std::string>& paths) {
  if (paths.size() != 1) {
    complain(fmt::format("a sweep takes one catalog and no script, found {} files", paths.size()));
    return nullptr;
  }
  std::shared_ptr<const CompiledCatalog> catalog = load_catalog(paths.front());
  if (catalog != nullptr && catalog->tasks.empty()) {
    complain(fmt::format("catalog {} has no tasks to sweep", quote(display_name(paths.front()))));
    return nullptr;
  }
  return catalog;
}

int report_failure(const SweepFailure& failure, const SweepSettings& settings) {
  if (failure.status == Coordinator::Status::refused_answer) {
    complain(fmt::format("sequence {}: the checker refuses an answer of the solver: {}",
                         failure.sequence, failure.internal_error));
    complain(
        "this is a fault of cbc, not of the catalog; please report it with the catalog and "
        "this script:");
    fmt::print(stderr, "{}", failure.script);
    return exit_internal;
  }
  complain(
      fmt::format("sequence {}: the clock made more than {} events (--max-clock-events) in "
                  "this script:",
                  failure.sequence, settings.search.max_clock_events));
  fmt::print(stderr, "{}", failure.script);
  return exit_unusable;
}

int write_slowest(const std::optional<std::string>& path,
                  const std::optional<SlowestEvent>& slowest) {
  if (!path) return exit_ok;
  if (!slowest) {
    complain(fmt::format("there is no script for {}: no event took a search", quote(*path)));
    return exit_unusable;
  }
  return write_output(*path, slowest->script);
}

int report(SweepResult result, const SolveOptions& options) {
  const SweepOptions& of_sweep = options.sweep;
  int status = write_slowest(of_sweep.slowest, result.slowest);
  if (of_sweep.slowest_by_time && !result.times) {
    complain("--slowest-by-time: the shards were made without '--stats'");
    status = exit_unusable;
  } else if (result.times) {
    status = std::max(status, write_slowest(of_sweep.slowest_by_time, result.times->slowest));
  }
  if (!options.stats && !of_sweep.merge) result.times.reset();
  const std::string text =
      options.format == "json" ? sweep_to_json(result) : sweep_to_text(result, style_for(stdout));
  fmt::print("{}", text);
  return status;
}

int merge(const SolveOptions& options) {
  SweepMerger merger;
  for (const std::string& path : options.paths) {
    const std::optional<std::string> text = read_input(path);
    if (!text) return exit_unusable;
    const std::string name = display_name(path);
    if (text->size() > largest_shard) {
      complain(fmt::format("cannot merge {}: it is larger than {} MiB", quote(name),
                           largest_shard >> 20U));
      return exit_unusable;
    }
    auto shard = sweep_from_json(*text);
    if (const auto* const fault = std::get_if<std::string>(&shard)) {
      complain(fmt::format("cannot merge {}: {}", quote(name), *fault));
      return exit_unusable;
    }
    if (const auto error = merger.add(std::get<SweepResult>(std::move(shard)), name)) {
      complain("cannot merge: " + *error);
      return exit_unusable;
    }
  }
  if (const auto missing = merger.find_missing()) {
    complain("cannot merge: " + *missing);
    return exit_unusable;
  }
  return report(merger.take(), options);
}

}  // namespace

int run_sweep(const SolveOptions& options) {
  if (options.sweep.merge) return merge(options);
  const std::shared_ptr<const CompiledCatalog> catalog = load_swept(options.paths);
  if (catalog == nullptr) return exit_unusable;
  const SweepSettings settings = to_settings(options);
  const SequenceRange range = sequences_of(settings);
  Progress progress("sweeping", 1);
  progress.begin(std::string(catalog->file));
  SweepOutcome outcome = sweep(*catalog, settings, thread_count(options), [&](std::uint64_t done) {
    progress.show(fmt::format(" ({} %)", done * 100 / (range.end - range.first)));
  });
  progress.clear();
  if (outcome.failure) return report_failure(*outcome.failure, settings);
  return report(std::move(outcome.result), options);
}

}  // namespace cbc::cli
