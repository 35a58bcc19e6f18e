#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/missing_missions.h"
#include "coverage/report/missing_missions_report.h"
#include "coverage/test_folder.h"
#include "runtime/base/text.h"
#include "verify/engine/explore.h"
#include "verify/verify.h"

namespace cbc::cli {
namespace {

/// When to stop: a signal has come, or the time is over.
class Deadline {
 public:
  /// Begins now. `seconds`: 0 for no limit.
  explicit Deadline(double seconds) : seconds_(seconds) {}

  [[nodiscard]] bool has_come() const { return signals_.have_come() || is_late(); }
  [[nodiscard]] bool is_late() const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
    return seconds_ > 0 && elapsed.count() >= seconds_;
  }

 private:
  const StopSignals signals_;
  const double seconds_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// By goal: whether the missions meet it. Empty if one of them ends early; the reason is printed,
/// unless it is the deadline.
std::optional<std::vector<std::uint8_t>> goals_met_by(const std::vector<Mission>& missions,
                                                      const std::vector<Goal>& goals,
                                                      const Deadline& deadline) {
  std::vector<std::uint8_t> met(goals.size(), 0);
  Progress progress("solving", missions.size());
  for (const Mission& mission : missions) {
    progress.begin(mission.script.file);
    progress.show();
    SilentRun silent;
    CoordinatorOptions options;
    options.is_stopped = [&] { return deadline.has_come(); };
    const MonitoredResult watched =
        run_monitored(*mission.catalog, goals, mission.script, options, silent);
    if (deadline.has_come()) return std::nullopt;
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

/// Finds the scripts, and shows the progress.
MissingMissions find_tests(const VerifyOptions& options, const VerifyQuestions& questions,
                           const std::vector<Goal>& goals, const std::vector<std::uint8_t>& met,
                           const Assumptions& assumptions, const Deadline& deadline) {
  const CompiledCatalog& catalog = *questions.catalog;
  GroupProgress progress("exploring", catalog.group_count());
  MissingMissionOptions of_search;
  of_search.catalog = catalog_from(*options.write_tests, options, questions);
  if (options.max_states > 0) of_search.exploration.max_states = options.max_states;
  of_search.exploration.on_progress = [&](std::uint32_t group, std::uint64_t states) {
    progress.show(group, states);
    return true;
  };
  of_search.on_mission = [&](std::size_t number) {
    progress.line().show(fmt::format(" ({})", quantity(number, "test")));
  };
  of_search.is_stopped = [&] { return deadline.has_come(); };
  return find_missing_missions(catalog, goals, met, assumptions, of_search);
}

/// How far the work had come when it was stopped.
std::string describe_progress(const MissingMissions& missing, std::size_t groups) {
  const std::string states = quantity(missing.states, "state");
  switch (missing.reached) {
    case MissingMissions::Phase::exploration:
      return fmt::format("in the exploration, after {}", states);
    case MissingMissions::Phase::planning:
      return fmt::format("in the planning, after the exploration of {} with {}",
                         quantity(groups, "group"), states);
    default:
      return fmt::format("after {} had been found", quantity(missing.missions.size(), "test"));
  }
}

/// A path for a shell.
std::string in_shell(const std::string& path) {
  const bool is_plain = std::all_of(path.begin(), path.end(), [](char character) {
    return std::isalnum(static_cast<unsigned char>(character)) != 0 ||
           std::string_view("_./-+").find(character) != std::string_view::npos;
  });
  if (is_plain) return path;
  std::string quoted = "'";
  for (const char character : printable(path)) {
    if (character == '\'') {
      quoted += "'\\''";
    } else {
      quoted += character;
    }
  }
  return quoted + "'";
}

/// Which command looks at what these tests leave.
std::string command_for_mutants(const VerifyOptions& options, const MissingMissions& missing) {
  std::vector<std::string> missions = options.beside;
  std::erase_if(missions, [&](const std::string& mission) {
    return is_same_file(mission, *options.write_tests);
  });
  if (!missing.missions.empty()) missions.push_back(*options.write_tests);
  if (missions.empty()) return {};
  std::string command = "cbc verify";
  for (const std::string& path : options.paths) command += " " + in_shell(path);
  command += " --mutants";
  for (const std::string& mission : missions) command += " --beside " + in_shell(mission);
  return command + " --scripts DIR";
}

/// Says that nothing is written. Returns the exit status.
int complain_of_end(const VerifyOptions& options, const Deadline& deadline,
                    const std::string& progress) {
  const std::string limit = format_decimal(parse_seconds(options.time_limit).value, 6);
  const std::string reason =
      deadline.is_late() ? fmt::format("--time-limit {} ended it", limit) : "interrupted";
  complain("--write-tests: {} {}; nothing was written", reason, progress);
  return exit_no;
}

}  // namespace

int write_tests(const VerifyOptions& options, const VerifyQuestions& questions) {
  if (questions.files.size() > 1) {
    return usage_error("verify", "--write-tests takes at most one property file, found {}",
                       questions.files.size());
  }
  if (const auto too_many = find_too_many_pairs(*questions.catalog)) {
    return complain("--write-tests: {}", *too_many);
  }
  if (!can_write_output(options.output)) return exit_unusable;
  TestFolder folder(*options.write_tests);
  if (!folder.open()) return exit_unusable;
  const CompiledCatalog& catalog = *questions.catalog;
  const std::vector<Goal> goals = find_goals(catalog);
  const Deadline deadline(limits_of(options).seconds);
  const auto met = goals_met_by(questions.beside, goals, deadline);
  if (!met) {
    return deadline.has_come() ? complain_of_end(options, deadline, "in the missions that exist")
                               : exit_unusable;
  }
  const StatedAssumptions stated = goal_assumptions(questions);
  const MissingMissions missing =
      find_tests(options, questions, goals, *met, stated.assumptions, deadline);
  if (missing.error) return complain("--write-tests: {}", *missing.error);
  if (missing.reached != MissingMissions::Phase::done) {
    return complain_of_end(options, deadline, describe_progress(missing, catalog.group_count()));
  }
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
  WrittenTests tests;
  tests.catalog = &catalog;
  tests.assumptions = stated;
  tests.goals = goals;
  if (!options.beside.empty()) tests.missions = questions.beside.size();
  tests.missing = &missing;
  tests.next = command_for_mutants(options, missing);
  std::vector<TestFolder::File> files;
  for (const MissingMissions::Mission& mission : missing.missions) {
    files.push_back({mission.name + ".yaml", mission.text});
    tests.paths.push_back(folder.path_of(files.back().name));
  }
  if (const int status = folder.replace(files); status != exit_ok) return status;
  const std::size_t columns = options.output == "-" ? columns_for(stdout) : 0;
  const int status = write_output(options.output, written_tests_to_text(tests, columns));
  if (status != exit_ok) return status;
  return missing.unmet.empty() && missing.partial.empty() ? exit_ok : exit_no;
}

}  // namespace cbc::cli
