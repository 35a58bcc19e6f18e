#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/read.h"
#include "core/files/signals.h"
#include "core/support/wording.h"
#include "coverage/coverage.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/missing_missions.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark =
    "# Written by 'cbc coverage --write-missing', which replaces this file unless it was changed: ";

/// The line after it in scripts of a call that a limit or an interrupt ended.
constexpr std::string_view incomplete_mark =
    "# Incomplete: a limit or an interrupt ended that call, and other scripts are missing.\n";

std::string sign(const std::string& text) {
  return fmt::format("{}{}\n{}", mark, to_hex(digest_of(text)), text);
}

/// The text that this program wrote, if nobody has changed it.
std::optional<std::string> read_signed(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::size_t end = content.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string text = content.substr(end + 1);
  if (content != sign(text)) return std::nullopt;
  return text;
}

/// A folder of scripts that `cbc coverage` writes, and replaces when it is called again. Each says
/// so in a comment with a digest of the rest, so that none that anybody has changed is replaced.
class MissionFolder {
 public:
  struct File {
    std::string name;
    std::string text;
  };

  explicit MissionFolder(std::string path) : path_(std::move(path)) {}

  /// Looks at the files of the folder, if it exists. False if there is one that is not ours, or the
  /// folder cannot be made or written to; the reason is printed. Changes nothing.
  [[nodiscard]] bool open();
  /// Replaces all scripts by these; makes the folder if there are any. Returns the exit status.
  /// After an error, no script is new.
  [[nodiscard]] int replace(const std::vector<File>& files);

  /// Whether it had scripts of a call that nothing ended when it was opened.
  [[nodiscard]] bool was_complete() const { return was_complete_; }
  [[nodiscard]] std::string path_of(const std::string& name) const;

 private:
  std::string path_;
  std::vector<std::string> names_;  ///< of our files
  bool was_complete_ = false;
};

std::string MissionFolder::path_of(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

bool MissionFolder::open() {
  std::error_code error;
  fs::path lowest = fs::absolute(path_, error).lexically_normal();
  if (!lowest.has_filename()) lowest = lowest.parent_path();  // "tests/"
  const fs::path folder = lowest;
  while (!error && !fs::exists(lowest, error) && !error) lowest = lowest.parent_path();
  if (!error && !fs::is_directory(lowest, error) && !error) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (!error && ::access(lowest.c_str(), W_OK | X_OK) != 0) {
    error = std::error_code(errno, std::generic_category());
  }
  if (error) {
    complain("cannot write to the folder {}: {}", quote(path_), error.message());
    return false;
  }
  if (lowest != folder) return true;
  std::vector<std::string> foreign;
  fs::directory_iterator entry(path_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const bool is_file = fs::is_regular_file(entry->symlink_status(ignored));
    const std::string name = entry->path().filename().string();
    std::optional<std::string> text;
    if (is_file && name.ends_with(".yaml")) text = read_signed(entry->path());
    (text ? names_ : foreign).push_back(name);
    if (text && !text->starts_with(incomplete_mark)) was_complete_ = true;
    if (const auto refusal = find_read_file(path_of(name))) {
      complain(*refusal);
      return false;
    }
  }
  if (error) {
    complain("cannot read the folder {}: {}", quote(path_), error.message());
    return false;
  }
  if (!foreign.empty()) {
    const std::string& first = *std::min_element(foreign.begin(), foreign.end());
    complain(
        "the folder {} has {}, which --write-missing did not write, or which was changed since; "
        "expected a folder for its scripts alone",
        quote(path_), quote(first));
    return false;
  }
  return true;
}

int MissionFolder::replace(const std::vector<File>& files) {
  std::vector<std::string> made;
  if (!files.empty()) {
    if (const int status = make_folder(path_); status != exit_ok) return status;
  }
  for (const File& file : files) {
    const int status = write_output(path_of(file.name), sign(file.text));
    if (status == exit_ok) {
      made.push_back(file.name);
      continue;
    }
    std::error_code ignored;
    for (const std::string& name : made) {
      const bool was_there = std::find(names_.begin(), names_.end(), name) != names_.end();
      if (!was_there) fs::remove(path_of(name), ignored);
    }
    return status;
  }
  for (const std::string& name : names_) {
    if (std::find(made.begin(), made.end(), name) != made.end()) continue;
    std::error_code error;
    fs::remove(path_of(name), error);
    if (error) return complain("cannot remove {}: {}", quote(path_of(name)), error.message());
  }
  return exit_ok;
}

/// By goal: whether the missions meet it, as far as they ran before the end. Empty if one of
/// them ends early; the reason is printed.
std::optional<std::vector<std::uint8_t>> goals_met_by(const std::vector<Mission>& missions,
                                                      const std::vector<Goal>& goals,
                                                      const CoverageOptions& options,
                                                      const Budget& budget) {
  std::vector<std::uint8_t> met(goals.size(), 0);
  CoordinatorOptions coordination;
  coordination.is_stopped = [&] { return budget.find_end().has_value(); };
  bool has_ended = false;
  watch_missions(
      missions, options.jobs, coordination,
      [&](const Mission&) -> const std::vector<Goal>& { return goals; },
      [&](const Mission& mission, const MonitoredResult& watched) {
        const std::string reason = describe_end(watched.result, coordination);
        has_ended = !reason.empty() && !budget.find_end();
        if (has_ended) complain("{}: {}", quote(mission.script.file), reason);
        for (std::size_t goal = 0; goal < goals.size(); ++goal) met[goal] |= watched.met[goal];
        return !has_ended && !budget.find_end();
      });
  if (has_ended) return std::nullopt;
  return met;
}

/// Finds the scripts, and shows the progress.
MissingMissions find_missing(const CoverageOptions& options, const CoverageQuestion& question,
                             const std::vector<Goal>& goals, const std::vector<std::uint8_t>& met,
                             const Budget& budget) {
  constexpr double for_planning = 0.2;
  const CompiledCatalog& catalog = *question.catalog;
  Progress progress("exploring", catalog.group_count());
  MissingMissionOptions of_search;
  of_search.catalog = path_in_script(options.paths.front(), *options.write_missing);
  of_search.exploration = {budget, thread_count(options.jobs), for_planning};
  of_search.exploration.budget.tell = progress.listener();
  of_search.on_mission = [&](std::size_t number) {
    progress.show(fmt::format(" ({})", quantity(number, "test")));
  };
  // The end came so long ago that whoever set it waits.
  std::optional<Budget::Clock::time_point> end;
  of_search.is_over = [&] {
    constexpr std::chrono::seconds patience(2);
    const auto now = Budget::Clock::now();
    if (!end && budget.find_end()) end = now;
    return end && now - *end > patience;
  };
  return find_missing_missions(catalog, goals, met, question.assumptions.assumptions, of_search);
}

/// What ended the work, and how far it had come. Empty if nothing did.
std::string describe_end_of(const MissingMissions& missing, bool were_all_run, std::size_t groups,
                            const CoverageOptions& options, const Budget& budget) {
  if (missing.is_complete()) return {};
  if (missing.reached == MissingMissions::Phase::done) return "a limit ended the exploration";
  const std::string limit = format_decimal(parse_seconds(options.limits.time_limit).value, 6);
  const std::string states = quantity(missing.states, "state");
  std::string place;
  if (!were_all_run) {
    place = "in the missions that exist";
  } else if (missing.reached == MissingMissions::Phase::exploration) {
    place = "in the exploration, after " + states;
  } else if (missing.reached == MissingMissions::Phase::planning) {
    place = fmt::format("in the planning, after the exploration of {} with {}",
                        quantity(groups, "group"), states);
  } else {
    place = fmt::format("after {} had been found", quantity(missing.missions.size(), "test"));
  }
  return fmt::format("{} {}",
                     budget.find_end() == Budget::End::time_limit
                         ? fmt::format("--time-limit {} ended it", limit)
                         : "interrupted",
                     place);
}

/// Which command looks at what these scripts leave.
std::string command_for_mutants(const CoverageOptions& options, const MissingMissions& missing) {
  std::vector<std::string> paths = options.paths;
  std::erase_if(
      paths, [&](const std::string& path) { return is_same_file(path, *options.write_missing); });
  if (!missing.missions.empty()) paths.push_back(*options.write_missing);
  if (paths.size() < 2) return {};
  std::string command = "cbc coverage";
  for (const std::string& path : paths) command += " " + in_shell(path);
  if (options.assume) command += " --assume " + in_shell(*options.assume);
  return command + " --mutants --scripts DIR";
}

}  // namespace

int write_missing(const CoverageOptions& options, const CoverageQuestion& question) {
  if (!can_write_output(options.output)) return exit_unusable;
  MissionFolder folder(*options.write_missing);
  if (!folder.open()) return exit_unusable;
  const CompiledCatalog& catalog = *question.catalog;
  const std::vector<Goal> goals = find_goals(catalog);
  const StopSignals signals;
  const Budget budget = budget_of(options, signals);
  const auto met = goals_met_by(question.missions, goals, options, budget);
  if (!met) return exit_unusable;
  const bool were_all_run = question.missions.empty() || !budget.find_end();
  const MissingMissions missing = find_missing(options, question, goals, *met, budget);
  if (missing.error) return complain("--write-missing: {}", *missing.error);
  if (!missing.fault.empty()) {
    complain("--write-missing: {}", missing.fault);
    complain("this is a fault of cbc, not of the catalog {}; please report it with the catalog",
             quote(catalog.file));
    return exit_internal;
  }
  WrittenMissions written;
  written.catalog = &catalog;
  written.assumptions = question.assumptions;
  written.goals = goals;
  if (options.paths.size() > 1) written.missions = question.missions.size();
  written.missing = &missing;
  written.incomplete =
      describe_end_of(missing, were_all_run, catalog.group_count(), options, budget);
  const bool is_kept = !missing.is_complete() && folder.was_complete();
  const bool is_written = missing.is_complete() || (!is_kept && !missing.missions.empty());
  if (is_written) {
    written.next = command_for_mutants(options, missing);
    std::vector<MissionFolder::File> files;
    for (const MissingMissions::Mission& mission : missing.missions) {
      const std::string_view head = missing.is_complete() ? std::string_view() : incomplete_mark;
      files.push_back({mission.name + ".yaml", std::string(head) + mission.text});
      written.paths.push_back(folder.path_of(files.back().name));
    }
    if (const int status = folder.replace(files); status != exit_ok) return status;
  }
  const int status =
      write_output(options.output, written_missions_to_text(written, columns_for(options.output)));
  if (status != exit_ok) return status;
  if (is_kept) {
    complain("{}; the folder {} is as it was", written.incomplete, quote(*options.write_missing));
  }
  return missing.unmet.empty() && missing.is_complete() ? exit_ok : exit_no;
}

}  // namespace cbc::cli
