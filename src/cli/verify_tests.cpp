#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/output.h"
#include "cli/test_folder.h"
#include "cli/verify.h"
#include "coverage/goals.h"
#include "coverage/missing_missions.h"
#include "coverage/watched_run.h"
#include "report/missing_missions_report.h"

namespace cbc::cli {
namespace {

/// By goal: whether the missions meet it. Empty if one of them ends early; the reason is printed.
std::optional<std::vector<std::uint8_t>> goals_met_by(const std::vector<Mission>& missions,
                                                      const std::vector<Goal>& goals) {
  std::vector<std::uint8_t> met(goals.size(), 0);
  Progress progress("solving", missions.size());
  for (const Mission& mission : missions) {
    progress.begin(mission.script.file);
    progress.show();
    SilentRun silent;
    const CoordinatorOptions options;
    const WatchedResult watched =
        run_watched(*mission.catalog, goals, mission.script, options, silent);
    const std::string reason = describe_end(watched.result, options);
    if (!reason.empty()) {
      progress.clear();
      complain("{}: {}", quote(mission.script.file), reason);
      return std::nullopt;
    }
    for (std::size_t goal = 0; goal < goals.size(); ++goal) met[goal] |= watched.met[goal];
  }
  return met;
}

/// The path by which a script in the folder names the catalog. Empty if it has none.
std::string path_from(const std::string& folder, const std::string& catalog) {
  if (catalog == "-") return {};
  std::error_code error;
  const std::filesystem::path path = std::filesystem::proximate(catalog, folder, error);
  return error ? std::string{} : path.generic_string();
}

/// Finds the scripts, and shows the progress. Empty if a signal ends it.
std::optional<MissingMissions> find_tests(const VerifyOptions& options,
                                          const VerifyQuestions& questions,
                                          const std::vector<Goal>& goals,
                                          const std::vector<std::uint8_t>& met,
                                          const Assumptions& assumptions) {
  const CompiledCatalog& catalog = *questions.catalog;
  const StopSignals signals;
  const ExplorationLimits limits = limits_of(options);
  Progress progress("exploring", catalog.group_count());
  MissingMissionOptions of_search;
  of_search.catalog =
      path_from(*options.write_tests, questions.named_catalog.value_or(options.paths.front()));
  if (limits.max_states > 0) of_search.exploration.max_states = limits.max_states;
  std::optional<std::uint32_t> begun;
  std::chrono::steady_clock::time_point begin;
  of_search.exploration.on_progress = [&](std::uint32_t group, std::uint64_t states) {
    const auto now = std::chrono::steady_clock::now();
    if (begun != group) {
      progress.begin(fmt::format("group {}", group));
      begin = now;
    }
    begun = group;
    progress.show(fmt::format(" ({} states)", states));
    const std::chrono::duration<double> elapsed = now - begin;
    return !signals.have_come() && (limits.seconds <= 0 || elapsed.count() < limits.seconds);
  };
  of_search.on_mission = [&](std::size_t number) {
    progress.show(fmt::format(" ({} tests)", number));
    return !signals.have_come();
  };
  MissingMissions missing = find_missing_missions(catalog, goals, met, assumptions, of_search);
  if (signals.have_come()) return std::nullopt;
  return missing;
}

}  // namespace

int write_tests(const VerifyOptions& options, const VerifyQuestions& questions) {
  if (questions.files.size() > 1) {
    return usage_error("verify", "--write-tests takes at most one property file, found {}",
                       questions.files.size());
  }
  if (!can_write_output(options.output)) return exit_unusable;
  TestFolder folder(*options.write_tests);
  if (!folder.open()) return exit_unusable;
  const CompiledCatalog& catalog = *questions.catalog;
  const std::vector<Goal> goals = find_goals(catalog);
  const auto met = goals_met_by(questions.beside, goals);
  if (!met) return exit_unusable;
  const Assumptions assumptions = goal_assumptions(questions);
  const std::optional<MissingMissions> found =
      find_tests(options, questions, goals, *met, assumptions);
  if (!found) {
    complain("interrupted; the folder {} is as it was", quote(*options.write_tests));
    return exit_no;
  }
  const MissingMissions& missing = *found;
  if (missing.error) return complain("--write-tests: {}", *missing.error);
  if (!missing.fault.empty()) {
    complain("--write-tests: {}", missing.fault);
    complain("this is a fault of cbc, not of the catalog {}; please report it with the catalog",
             quote(catalog.file));
    return exit_internal;
  }
  if (!missing.partial.empty() && !folder.was_empty()) {
    complain("a limit ended the exploration; the folder {} is as it was",
             quote(*options.write_tests));
    return exit_no;
  }
  WrittenTests tests{&catalog, goals, questions.beside.size(), &missing, {}};
  std::vector<TestFolder::File> files;
  for (const MissingMissions::Mission& mission : missing.missions) {
    files.push_back({mission.name + ".yaml", mission.text});
    tests.paths.push_back(folder.path_of(files.back().name));
  }
  if (const int status = folder.replace(files); status != exit_ok) return status;
  const int status = write_output(options.output, written_tests_to_text(tests));
  if (status != exit_ok) return status;
  return missing.unmet.empty() && missing.partial.empty() ? exit_ok : exit_no;
}

}  // namespace cbc::cli
