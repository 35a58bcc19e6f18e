// Random small catalogs and assumptions: the scripts that are written, read back from their text,
// must pass, and together meet every goal that is not proven unreachable, which
// goal_proof_property_test.cpp compares with a plain enumeration. CBC_SEED and CBC_PROPERTY_CASES
// are as in property_test.cpp.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/missing_missions.h"
#include "demand.h"
#include "random_cases.h"
#include "verify_case.h"

namespace cbc::plain::missing_missions_property_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 100;
constexpr std::uint64_t most_states = 400;

/// By goal: whether the script of the text meets it.
std::vector<std::uint8_t> run_text(const CompiledCatalog& catalog, const std::vector<Goal>& goals,
                                   const std::string& text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "script.yaml", diagnostics);
  demand(document != nullptr, "it is no YAML: " + text);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  demand(script.has_value(), "the script is refused: " + text);
  MonitoredResult watched = run_monitored(catalog, goals, *script, {});
  demand(watched.result.status == Coordinator::Status::ok, "it ends: " + text);
  demand(watched.result.failed == 0, "an expectation fails: " + text);
  return std::move(watched.met);
}

/// By goal: whether the scripts meet it, which have to pass. Counts are checked.
std::vector<std::uint8_t> run_all(const CompiledCatalog& catalog, const std::vector<Goal>& goals,
                                  const MissingMissions& found) {
  std::vector<std::uint8_t> met(goals.size(), 0);
  std::set<std::string> names;
  std::set<std::uint32_t> counted;
  for (const MissingMissions::Mission& mission : found.missions) {
    demand(names.insert(mission.name).second, "two scripts of one name");
    const std::vector<std::uint8_t> by_script = run_text(catalog, goals, mission.text);
    for (const std::uint32_t goal : mission.goals) {
      demand(by_script[goal] != 0, "not met: " + describe(catalog, goals[goal]) + mission.text);
      demand(counted.insert(goal).second, "counted twice: " + describe(catalog, goals[goal]));
    }
    demand(!mission.goals.empty(), "a script for nothing");
    for (std::size_t goal = 0; goal < goals.size(); ++goal) met[goal] |= by_script[goal];
  }
  return met;
}

/// However early it is stopped, it ends soon, says that it was, and what is known by then is right.
void check_stop(const VerifyCase& sample, const std::vector<Goal>& goals, const GoalProof& proof,
                const MissingMissions& whole, oracle::Statistics& statistics) {
  const std::vector<std::uint8_t> none_met(goals.size(), 0);
  std::uint64_t asked = 0;
  std::uint64_t most = UINT64_MAX;
  MissingMissionOptions options;
  options.exploration.budget.is_stopped = [&] { return ++asked > most; };
  std::uint64_t until_over = UINT64_MAX;
  options.is_over = [&] { return asked > most && (until_over == 0 || --until_over == 0); };
  const auto find = [&] {
    asked = 0;
    return find_missing_missions(sample.catalog, goals, none_met, sample.question.assumptions,
                                 options);
  };
  demand(find().missions.size() == whole.missions.size(), "being asked changes something");
  std::set<std::uint32_t> can_be_met;
  for (const MissingMissions::Mission& mission : whole.missions) {
    can_be_met.insert(mission.goals.begin(), mission.goals.end());
  }
  const std::uint64_t all = asked;
  for (std::uint64_t part = 0; part < 8; ++part) {
    most = all * (part / 2) / 4;
    const bool is_cut = part % 2 != 0;
    until_over = is_cut ? 10 : UINT64_MAX;
    const MissingMissions found = find();
    demand(found.reached != MissingMissions::Phase::done, "it was not stopped");
    constexpr std::uint64_t soon = 300;
    demand(asked <= most + soon, "it goes on for long");
    static constexpr std::array<const char*, 3> phases = {
        "stopped in the exploration", "stopped in the planning", "stopped in the simulation"};
    statistics.count(phases.at(static_cast<std::size_t>(found.reached)));
    demand(found.fault.empty(), "a fault: " + found.fault);
    const std::vector<std::uint8_t> met = run_all(sample.catalog, goals, found);
    std::map<std::uint32_t, std::string> left;
    for (const MissingMissions::Unmet& one : found.unreachable) {
      demand(one.reason == proof.unreachable[one.goal], "another reason: " + one.reason);
      left[one.goal] = one.reason;
    }
    for (const MissingMissions::Unmet& one : found.unmet) {
      demand(left.emplace(one.goal, "").second, "unreachable and not met");
    }
    for (std::uint32_t goal = 0; goal < goals.size(); ++goal) {
      const std::string text = describe(sample.catalog, goals[goal]);
      demand(left.contains(goal) || met[goal] != 0, "neither met nor listed: " + text);
      if (met[goal] != 0) statistics.count(is_cut ? "met before the cut" : "met by then");
      if (!left.contains(goal) || !left[goal].empty()) continue;
      // After the exploration simple scripts meet the rest.
      const bool is_simple = goals[goal].kind != Goal::Kind::timeout_fired &&
                             goals[goal].kind != Goal::Kind::reactive_returned;
      demand(is_cut || found.reached == MissingMissions::Phase::exploration || !is_simple ||
                 !can_be_met.contains(goal),
             "no script meets it: " + text);
    }
  }
}

void check(const VerifyCase& sample, oracle::Statistics& statistics) {
  const CompiledCatalog& catalog = sample.catalog;
  const Assumptions& assumptions = sample.question.assumptions;
  const std::vector<Goal> goals = find_goals(catalog);
  GoalSearchOptions of_proof;
  of_proof.budget.max_states = most_states;
  const GoalProof proof = prove_unreachable(catalog, goals, assumptions, of_proof);
  if (proof.error) return statistics.count("excluded");
  for (const GoalSearchResult& group : proof.groups) {
    if (!group.is_complete) return statistics.count("too many states");
  }
  const std::vector<std::uint8_t> none_met(goals.size(), 0);
  const MissingMissions missing = find_missing_missions(catalog, goals, none_met, assumptions, {});
  demand(!missing.error && missing.fault.empty(), "a fault: " + missing.fault);
  demand(missing.is_complete(), "it ended early");
  demand(missing.lower_bound.has_value() && *missing.lower_bound <= missing.missions.size(),
         "fewer scripts than the bound");
  const std::vector<std::uint8_t> met = run_all(catalog, goals, missing);
  statistics.count(missing.missions.empty() ? "no scripts" : "scripts");
  std::set<std::uint32_t> unmet;
  for (const MissingMissions::Unmet& one : missing.unmet) unmet.insert(one.goal);
  std::map<std::uint32_t, std::string> reasons;
  for (const MissingMissions::Unmet& one : missing.unreachable) reasons[one.goal] = one.reason;
  for (std::uint32_t goal = 0; goal < goals.size(); ++goal) {
    const std::string text = describe(catalog, goals[goal]);
    if (met[goal] != 0) {
      demand(!unmet.contains(goal), "met, but listed: " + text);
      statistics.count("met");
      continue;
    }
    if (!proof.unreachable[goal].empty()) {
      demand(!unmet.contains(goal), "unreachable, but listed: " + text);
      demand(reasons[goal] == proof.unreachable[goal],
             text + ": " + reasons[goal] + ", but " + proof.unreachable[goal]);
      statistics.count("unreachable");
      continue;
    }
    demand(unmet.contains(goal), "neither met nor listed: " + text);
    // A state has no times: others may always come first.
    demand(goals[goal].kind == Goal::Kind::timeout_fired, "no script meets it: " + text);
    statistics.count("no time for a timeout");
  }
  const MissingMissions nothing = find_missing_missions(catalog, goals, met, assumptions, {});
  demand(nothing.missions.empty(), "more scripts are written beside these");
  check_stop(sample, goals, proof, missing, statistics);
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  try {
    check(generate_verify_case(seed), results.statistics);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, fault.what()});
  }
}

constexpr oracle::LowerBound lower_bounds[] = {{"scripts", 300},
                                               {"met", 3000},
                                               {"unreachable", 500},
                                               {"stopped in the exploration", 300},
                                               {"stopped in the planning", 300},
                                               {"met by then", 3000},
                                               {"met before the cut", 300}};

TEST(MissingMissions, MeetWhatCanBeMet) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::missing_missions_property_test
