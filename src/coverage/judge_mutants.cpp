#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/signals.h"
#include "core/script/script.h"
#include "core/yaml/source.h"
#include "coverage/coverage.h"
#include "coverage/engine/mutants/mutants.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

/// False if missions do not pass on the catalog itself; which ones is printed.
bool all_pass(const CompiledCatalog& catalog, const std::vector<Script>& missions) {
  constexpr std::size_t most_named = 20;
  std::size_t failing = 0;
  for (const Script& mission : missions) {
    const std::optional<Notice> notice = find_notice(catalog, mission);
    if (!notice) continue;
    if (++failing > most_named) continue;
    std::string place = printable(mission.file);
    if (notice->line > 0) place += fmt::format(":{}", notice->line);
    complain("{}: {}", place, notice->message);
  }
  if (failing == 0) return true;
  if (failing > most_named) complain("and {} more", failing - most_named);
  complain(
      "--mutants: expected missions that pass on {}, but {} of {} {}; one that fails tells nothing "
      "of a mutant (see 'cbc solve')",
      quote(catalog.file), failing, missions.size(), failing == 1 ? "fails" : "fail");
  return false;
}

/// Writes the scripts of survivors, which name the catalog by its path from the folder, if it has
/// one. The name says what each is about: "robot.320.exclusion_removed.mission.yaml".
int write_scripts(const std::string& folder, const std::string& path_of_catalog,
                  const MutantsResult& result) {
  const std::string first_key = path_of_catalog.empty()
                                    ? "# Run it with: cbc solve CATALOG FILE"
                                    : fmt::format("catalog: {}", yaml::in_quotes(path_of_catalog));
  const fs::path catalog = result.catalog->file;
  const std::string stem =
      result.catalog->file == display_name("-") ? "stdin" : catalog.stem().string();
  std::set<std::string> taken;
  for (std::size_t place = 0; place < result.mutants.size(); ++place) {
    if (!result.verdicts[place].script) continue;
    const Mutant& mutant = result.mutants[place];
    const std::string first =
        fmt::format("{}.{}.{}", stem, mutant.lines.front(), name_of(mutant.kind));
    std::string name = first;
    for (int number = 2; !taken.insert(name).second; ++number) {
      name = fmt::format("{}-{}", first, number);
    }
    const std::string text =
        fmt::format("# Notices this change in line {}: {}\n{}\n{}", mutant.lines.front(),
                    describe(*result.catalog, mutant), first_key, *result.verdicts[place].script);
    const int status = write_output((fs::path(folder) / (name + ".mission.yaml")).string(), text);
    if (status != exit_ok) return status;
  }
  return exit_ok;
}

int status_of(const CoverageOptions& options, const MutantCount& count) {
  const int status = count.is_complete() ? exit_ok : exit_no;
  if (options.fail_under.empty() || count.score().tenths() >= tenths_in(options.fail_under)) {
    return status;
  }
  complain("the missions notice {} of the mutants, less than {} (--fail-under)",
           cbc::describe_percent(count.score()), describe_percent(options.fail_under));
  return exit_no;
}

}  // namespace

int judge_mutants(const CoverageOptions& options, const CoverageQuestion& question) {
  const CompiledCatalog& catalog = *question.catalog;
  if (question.missions.empty()) {
    return complain("--mutants: expected a script, found none in {}", quote(options.paths.back()));
  }
  const CheckedCatalog& source = *question.missions.front().source;
  if (source.text == nullptr) {
    return complain("--mutants: the catalog {} was compiled; expected the YAML, whose lines count",
                    quote(catalog.file));
  }
  if (!can_write_output(options.output)) return exit_unusable;
  if (options.scripts) {
    if (const int status = make_folder(*options.scripts); status != exit_ok) return status;
  }
  std::vector<Script> missions;
  MutantsResult result;
  for (const Mission& mission : question.missions) {
    missions.push_back(mission.script);
    result.missions.push_back(mission.script.file);
  }
  if (!all_pass(catalog, missions)) return exit_unusable;
  result.catalog = &source.reading.catalog;
  result.compiled = &catalog;
  result.assumptions = question.assumptions;
  result.writes_scripts = options.scripts.has_value();
  result.mutants = find_mutants(*result.catalog);

  // States of one mutant; the largest groups of catalogs have far more, and nobody would wait.
  constexpr std::uint64_t most_states = 1'000'000;
  const double seconds = options.limits.seconds();
  const StopSignals signals;
  const Budget budget = budget_of(options, signals);
  const Budget::Clock::time_point begin = Budget::Clock::now();
  Progress progress("judging", 1);
  progress.begin(std::string(catalog.file));
  JudgingOptions of_judging;
  of_judging.max_states = options.limits.max_states > 0 ? options.limits.max_states : most_states;
  of_judging.max_memory = budget.max_memory;
  of_judging.jobs = thread_count(options.jobs);
  of_judging.is_stopped = [&] { return budget.find_end().has_value(); };
  if (seconds > 0) {
    of_judging.seconds_left = [&] {
      return seconds - std::chrono::duration<double>(Budget::Clock::now() - begin).count();
    };
  }
  of_judging.on_progress = [&](bool is_compared, std::size_t done, std::size_t count) {
    progress.show(fmt::format(" ({} of {} {})", done, count,
                              is_compared ? "compared with it" : "mutants by the missions"));
  };
  const MutantJudge judge(*result.catalog, catalog, missions, question.assumptions.assumptions);
  result.verdicts = judge_all(judge, result.mutants, of_judging);
  progress.clear();

  if (options.scripts) {
    const int status = write_scripts(
        *options.scripts, path_in_script(options.paths.front(), *options.scripts), result);
    if (status != exit_ok) return status;
  }
  const int status = write_report(mutants_formats(), options.format, result, options.output);
  return status == exit_ok ? status_of(options, result.count()) : status;
}

}  // namespace cbc::cli
