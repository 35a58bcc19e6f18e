#include "cli/sweep_command.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "cli/catalog_loader.h"
#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "report/sweep_json.h"
#include "report/sweep_text.h"
#include "sweep/merge.h"
#include "sweep/sweep.h"
#include "text/quote.h"

namespace cbc::cli {
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
