#include "verify/found_scripts.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/property/properties.h"
#include "core/support/system.h"
#include "core/words/move_words.h"
#include "runtime/base/text.h"

namespace cbc::cli {

namespace {

namespace fs = std::filesystem;

Style style_of_replays(const VerifyOptions& options) {
  return options.format == "text" ? style_for(options.output) : plain_style();
}

/// How the names of the scripts that are about a file begin: "robot" for robot.properties.yaml.
std::string stem_of(std::string_view file) {
  if (file == display_name("-")) return "stdin";
  fs::path stem = fs::path(file).stem();
  if (stem.extension() == ".properties") stem = stem.stem();
  return stem.string();
}

/// The name of a script: "robot.12" for line 12 of robot.properties.yaml.
std::string script_name(const Property& property, const PropertyFile& file,
                        std::set<std::string>& taken) {
  const std::string first = fmt::format("{}.{}", stem_of(file.path), property.line);
  std::string name = first;
  for (int number = 2; !taken.insert(name).second; ++number) {
    name = fmt::format("{}-{}", first, number);
  }
  return name;
}

/// `folder`: of --scripts. `path`: where it was written.
int write_script_of(const std::string& folder, const std::string& name, std::string_view text,
                    std::optional<std::string>& path) {
  path = (fs::path(folder) / (name + ".mission.yaml")).string();
  return write_output(*path, text);
}

int check_replay(const Witness& witness, const RunResult& replayed) {
  if (replayed.failed == 0 && replayed.status == Coordinator::Status::ok) return exit_ok;
  complain("{}: this script does not end as it should", printable(witness.script.file));
  complain(
      "this is a bug in cbc, not in the catalog; please report it with the catalog and "
      "this script:");
  fmt::print(stderr, "{}", witness.text);
  return exit_internal;
}

/// No event of the script is at or after the time of a last move that the clock makes.
Microseconds time_of_last_move(const EventDifference& difference) {
  const auto& steps = difference.old_script.steps;
  const bool is_due = difference.moves.back().kind == Move::Kind::due;
  if (steps.empty()) return 0;
  return steps.back().time.value_or(0) + (is_due ? 1 : 0);
}

/// `groups`: of the exploration, which is one.
int replay_one_outcome(const VerifyOptions& options, const CompiledCatalog& catalog,
                       const std::vector<GroupId>& groups, const StatedAssumptions& stated,
                       ReportedOutcome& reported) {
  const std::string_view file = stated.file.empty() ? catalog.file : stated.file;
  const Property property = property_of(catalog, groups.front(), *reported.outcome);
  Witness& witness = reported.witness;
  witness = make_witness(catalog, groups, stated.assumptions, reported.outcome->script, &property,
                         fmt::format("Outcome {} of {}\nRun it with: cbc solve CATALOG FILE\n",
                                     reported.number, printable(file)));
  witness.script.file = fmt::format("{}: outcome {}", file, reported.number);
  const RunResult run = describe_moves(catalog, witness.script, witness.due, reported.moves);
  if (const int status = check_replay(witness, run); status != exit_ok) return status;
  if (!options.scripts) return exit_ok;
  return write_script_of(*options.scripts,
                         fmt::format("{}.outcome-{}", stem_of(file), reported.number), witness.text,
                         reported.script_path);
}

int replay_one_difference(const VerifyOptions& options, const CompiledCatalog& catalog,
                          const GroupComparison& groups, EventDifference& difference,
                          ReportedComparison& reported) {
  const Style style = style_of_replays(options);
  ReportedDifference& added = reported.differences.emplace_back();
  added.difference = &difference;
  Script& of_new = difference.witness.script;
  Script& of_old = difference.old_script;
  of_new.file = "difference";
  of_old.file = of_new.file;
  const Microseconds last_move = time_of_last_move(difference);
  added.with_new =
      replay_difference(seen_from(catalog, groups.new_groups), of_new, style, last_move);
  added.with_old = replay_difference(seen_from(*reported.old_catalog, groups.old_groups), of_old,
                                     style, last_move);
  if (!options.scripts) return exit_ok;
  const std::size_t number = reported.differences.size();
  const std::string name = number == 1 ? "difference" : fmt::format("difference-{}", number);
  int status = write_script_of(*options.scripts, name, difference.witness.text, added.script_path);
  if (status == exit_ok && difference.old_text) {
    status = write_script_of(*options.scripts, name + ".old", *difference.old_text,
                             added.old_script_path);
  }
  return status;
}

}  // namespace

int replay_answers(const VerifyOptions& options, VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  const Style style = style_of_replays(options);
  std::set<std::string> taken;
  for (VerifyPart& part : result.parts) {
    for (PropertyAnswer& answer : part.verification.answers) {
      ReportedAnswer& reported = part.answers.emplace_back();
      reported.answer = &answer;
      if (!answer.witness) continue;
      answer.witness->script.file = fmt::format("{}:{}: {}", part.file->path, answer.property->line,
                                                title_of(catalog, *answer.property));
      const Exploration& exploration = part.verification.explorations[*answer.exploration];
      reported.replay = replay_witness(seen_from(catalog, exploration.groups), *answer.witness,
                                       *answer.property, style);
      int status = check_replay(*answer.witness, reported.replay->result);
      if (status == exit_ok && options.scripts) {
        const std::string name = script_name(*answer.property, *part.file, taken);
        status =
            write_script_of(*options.scripts, name, answer.witness->text, reported.script_path);
      }
      if (status != exit_ok) return status;
    }
  }
  return exit_ok;
}

int replay_outcomes(const VerifyOptions& options, VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  std::size_t number = 0;
  for (VerifyPart& part : result.parts) {
    const StatedAssumptions stated =
        part.file ? StatedAssumptions{part.file->assumptions, part.file->path}
                  : StatedAssumptions{default_assumptions(catalog), {}};
    for (const Exploration& exploration : part.verification.explorations) {
      auto& outcomes = part.outcomes.emplace_back();
      for (const ReachableOutcome& outcome : *exploration.outcomes) {
        ReportedOutcome& reported = outcomes.emplace_back();
        reported.outcome = &outcome;
        reported.number = ++number;
        const int status =
            replay_one_outcome(options, catalog, exploration.groups, stated, reported);
        if (status != exit_ok) return status;
      }
    }
  }
  return exit_ok;
}

int replay_differences(const VerifyOptions& options, VerifyResult& result) {
  ReportedComparison& reported = *result.same_as;
  for (GroupComparison& group : reported.comparison.groups) {
    for (EventDifference& difference : group.differences) {
      const int status =
          replay_one_difference(options, *result.catalog, group, difference, reported);
      if (status != exit_ok) return status;
    }
  }
  return exit_ok;
}

}  // namespace cbc::cli
