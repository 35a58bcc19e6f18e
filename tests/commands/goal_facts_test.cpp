// Why no mission can meet a goal: a catalog for each reason.
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "coverage/engine/goal_proof.h"
#include "support/exclusive_tasks.h"
#include "unit/compiled_fixture.h"

namespace cbc::goal_facts_test {
namespace {

using Change = std::function<void(const CompiledCatalog&, Assumptions&)>;

/// By goal that is unreachable: why.
std::map<std::string, std::string> reasons(std::string_view text, const Change& change = {}) {
  const CompiledCatalog catalog = test::compile_text(text);
  const std::vector<Goal> goals = find_goals(catalog);
  Assumptions assumptions = assumptions_of_goals(catalog);
  if (change) change(catalog, assumptions);
  const GoalProof proof = prove_unreachable(catalog, goals, assumptions, {});
  EXPECT_FALSE(proof.error.has_value());
  std::map<std::string, std::string> found;
  for (std::size_t goal = 0; goal < goals.size(); ++goal) {
    if (!proof.unreachable[goal].empty()) {
      found[describe(catalog, goals[goal])] = proof.unreachable[goal];
    }
  }
  return found;
}

using Reasons = std::map<std::string, std::string>;

/// The first state of this group has 2,000 moves.
TEST(GoalProof, EndsWithinAStateAndProvesNothingThen) {
  const CompiledCatalog catalog = test::compile_text(test::exclusive_tasks(1000));
  const auto prove = [&](const GoalSearchOptions& walk) {
    const GoalProof proof = prove_unreachable(catalog, {}, assumptions_of_goals(catalog), walk);
    EXPECT_EQ(proof.groups.size(), 1U);
    return proof.groups.front();
  };
  int looks = 0;
  GoalSearchOptions asked;
  asked.budget.is_stopped = [&looks] { return ++looks == 5; };
  const GoalSearchResult stopped = prove(asked);
  EXPECT_FALSE(stopped.is_complete);
  EXPECT_EQ(looks, 5);
  EXPECT_LT(stopped.moves, 500U);
  GoalSearchOptions memory;
  memory.budget.max_memory = 40'000;
  const GoalSearchResult full = prove(memory);
  EXPECT_FALSE(full.is_complete);
  EXPECT_LT(full.moves, 500U);
}

TEST(UnreachableGoals, OfWhatNothingStarts) {
  EXPECT_EQ(
      reasons(R"(
behaviors: [{behavior: PLAY_NOW, task: PLAY}]
tasks: [{task: PLAY}]
)",
              [](const CompiledCatalog&, Assumptions& assumptions) { assumptions.start.clear(); }),
      (Reasons{
          {"task PLAY ran", "no event requests task PLAY, and no behavior requires it"},
          {"behavior PLAY_NOW was active",
           "no event requests task PLAY, and no behavior requires it"},
          {"behavior PLAY_NOW achieved its goal",
           "no event requests task PLAY, and no behavior requires it"},
          {"behavior PLAY_NOW failed", "no event requests task PLAY, and no behavior requires it"},
      }));
}

TEST(UnreachableGoals, OfWhatNeverFits) {
  const auto found = reasons(R"(
behaviors:
- {behavior: FLY_HIGH, task: FLY, situation: {WIND: low, RAIN: false}}
- {behavior: LOOK_UP, task: LOOK, situation: {RAIN: true}, requires: [{task: LIGHT}]}
- {behavior: LAMP, task: LIGHT}
tasks: [{task: FLY}, {task: LOOK}, {task: LIGHT, start_on_request: false}]
situation: [{variable: WIND, values: [high, low]}, {variable: RAIN}]
)",
                             [](const CompiledCatalog&, Assumptions& assumptions) {
                               assumptions.variables.clear();
                               assumptions.initially.variables = {{0, 0}, {1, 0}};
                             });
  EXPECT_EQ(found.at("task FLY ran"), "FLY_HIGH fits no reachable situation");
  EXPECT_EQ(found.at("behavior FLY_HIGH failed"), "FLY_HIGH fits no reachable situation");
  EXPECT_EQ(found.at("behavior FLY_HIGH began to fit the situation"),
            "FLY_HIGH fits no reachable situation");
  EXPECT_EQ(found.at("behavior LOOK_UP began to fit the situation"),
            "LOOK_UP fits every reachable situation");
  EXPECT_EQ(found.at("behavior LOOK_UP ceased to fit while active"),
            "LOOK_UP fits every reachable situation");
  EXPECT_EQ(found.at("WIND was low"), "WIND always is high");
  EXPECT_EQ(found.at("RAIN was false"), "RAIN always is true");
  EXPECT_EQ(found.count("task LIGHT ran"), 0U);
}

TEST(UnreachableGoals, OfSituationsThatNeverOccur) {
  const auto found = reasons(R"(
behaviors: [{behavior: FLY_HIGH, task: FLY, situation: {WIND: low}}]
situation: [{variable: WIND, values: [high, middle, low]}]
)",
                             [](const CompiledCatalog&, Assumptions& assumptions) {
                               assumptions.never = {{{{0, 2}}, {}}};
                             });
  EXPECT_EQ(found.at("WIND was low"), "no situation in which WIND is low can be reached");
}

TEST(UnreachableGoals, OfWhatNeedsAnotherTask) {
  const auto found = reasons(R"(
behaviors:
- {behavior: DRIVE_NOW, task: DRIVE, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE, suitability: 90}
- {behavior: ODOMETRY, task: LOCALIZE, suitability: 50, requires: [{task: COUNT}]}
- {behavior: COUNT_NOW, task: COUNT}
tasks:
- {task: DRIVE}
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- {task: COUNT, start_on_request: false, execution_goal: keep_running}
exclusivity_constraints: [{mutually_exclusive: [DRIVE, COUNT]}]
)");
  EXPECT_EQ(found.at("task COUNT ran"),
            "no event requests task COUNT, and no behavior that requires it is ever active");
  EXPECT_EQ(found.at("behavior ODOMETRY was active"),
            "ODOMETRY requires task COUNT, which never runs");
  EXPECT_EQ(found.at("ODOMETRY was active with COUNT, which it requires"),
            "ODOMETRY requires task COUNT, which never runs");
  EXPECT_EQ(found.at("behavior GPS was replaced"),
            "task LOCALIZE never runs with another behavior");
}

TEST(UnreachableGoals, OfWhatIsNeverChosen) {
  const auto found = reasons(
      R"(
behaviors:
- {behavior: FAST, task: DRIVE, suitability: 90}
- {behavior: SLOW, task: DRIVE, suitability: 80, requires: [{task: LOCALIZE}]}
- {behavior: SWIM_NOW, task: SWIM, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE, requires: [{task: RECEIVE}]}
- {behavior: ANTENNA, task: RECEIVE}
tasks: [{task: DRIVE}, {task: SWIM}, {task: LOCALIZE}, {task: RECEIVE}]
exclusivity_constraints: [{mutually_exclusive: [SWIM, RECEIVE]}]
)",
      [](const CompiledCatalog&, Assumptions& assumptions) { assumptions.failures = false; });
  EXPECT_EQ(found.at("task SWIM ran"), "every start of task SWIM is rejected");
  EXPECT_EQ(found.at("behavior SLOW was active"), "task DRIVE always runs with another behavior");
  EXPECT_EQ(found.at("behavior FAST failed"), "no behavior fails");
  EXPECT_EQ(found.at("behavior SWIM_NOW was active"), "every start of task SWIM is rejected");
}

TEST(UnreachableGoals, OfConstraintsThatNeverMatter) {
  const auto found = reasons(R"(
behaviors:
- {behavior: FAST, task: DRIVE, requires: [{task: LOCALIZE, minimum_performance: 10}]}
- {behavior: DIG_NOW, task: DIG, situation: {SOIL: true}}
- {behavior: GPS, task: LOCALIZE, suitability: 90}
tasks:
- {task: DRIVE}
- {task: DIG}
- {task: LOCALIZE, start_on_request: false, minimum_performance: 20}
exclusivity_constraints: [{mutually_exclusive: [DRIVE, DIG]}]
situation: [{variable: SOIL}]
)",
                             [](const CompiledCatalog&, Assumptions& assumptions) {
                               assumptions.variables.clear();
                               assumptions.initially.variables = {{0, 1}};
                             });
  EXPECT_EQ(found.at("the minimum that FAST requires of LOCALIZE matters"),
            "even without it, wherever FAST is active, LOCALIZE would reach it");
  EXPECT_EQ(found.at("the minimum of LOCALIZE matters"),
            "even without it no event would run LOCALIZE below it");
  EXPECT_EQ(found.at("it matters that DRIVE excludes DIG"),
            "DRIVE and DIG never compete: in no event may both run");

  const auto doubled = reasons(R"(
behaviors:
- {behavior: DRIVE_NOW, task: DRIVE, requires: [{task: ROLL}]}
- {behavior: SWIM_NOW, task: SWIM}
- {behavior: WHEELS, task: ROLL}
tasks: [{task: DRIVE}, {task: SWIM}, {task: ROLL, start_on_request: false}]
exclusivity_constraints: [{mutually_exclusive: [DRIVE, SWIM]}, {mutually_exclusive: [ROLL, SWIM]}]
)");
  EXPECT_EQ(doubled.at("it matters that DRIVE excludes SWIM"),
            "even without that no event would run both DRIVE and SWIM");
}

TEST(UnreachableGoals, OfReactiveTasks) {
  const auto found = reasons(
      R"(
behaviors:
- {behavior: BLINK_ON, task: BLINK}
- {behavior: HUM_ON, task: HUM, situation: {QUIET: false}}
- {behavior: DOCK_NOW, task: DOCK}
tasks:
- {task: BLINK, reactive_start: true, start_on_request: false}
- {task: HUM, reactive_start: true, start_on_request: false}
- {task: DOCK}
situation: [{variable: QUIET, values: ["true", "false"]}]
)",
      [](const CompiledCatalog&, Assumptions& assumptions) { assumptions.variables.clear(); });
  EXPECT_EQ(found.at("task BLINK gave way"),
            "only its own stop and the end of its behavior stop task BLINK");
  EXPECT_EQ(found.at("task BLINK returned by itself after it gave way"),
            "task BLINK never gives way");
  EXPECT_EQ(found.at("task HUM started by itself"), "HUM_ON fits no reachable situation");
  EXPECT_EQ(found.at("task HUM gave way"), "HUM_ON fits no reachable situation");
}

TEST(UnreachableGoals, OfTimeouts) {
  const char* const text = R"(
behaviors:
- {behavior: DRIVE_NOW, task: DRIVE, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
tasks:
- {task: DRIVE, timeout: 20}
- {task: LOCALIZE, start_on_request: false, timeout: 10}
)";
  EXPECT_EQ(reasons(text).at("task DRIVE ran into its timeout"),
            "the timeout of task LOCALIZE (10 s) always comes first");
  EXPECT_EQ(reasons(text).count("task LOCALIZE ran into its timeout"), 0U);
  const auto quiet = [](const CompiledCatalog&, Assumptions& assumptions) {
    assumptions.failures = false;
  };
  EXPECT_EQ(reasons(text, quiet).at("task LOCALIZE ran into its timeout"),
            "no behavior fails, and so none runs into a timeout");

  // At the same instant, the task that the catalog has first comes first.
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_EQ(reasons(replaced("timeout: 20", "timeout: 10")),
            (Reasons{{"task LOCALIZE ran into its timeout",
                      "the timeout of task DRIVE (10 s) always comes first"}}));
  const std::string turned = R"(
behaviors:
- {behavior: GPS, task: LOCALIZE}
- {behavior: DRIVE_NOW, task: DRIVE, requires: [{task: LOCALIZE}]}
tasks:
- {task: LOCALIZE, start_on_request: false, timeout: 10}
- {task: DRIVE, timeout: 10}
)";
  EXPECT_EQ(reasons(turned).at("task DRIVE ran into its timeout"),
            "the timeout of task LOCALIZE (10 s) always comes first");
  EXPECT_EQ(reasons(replaced("timeout: 20", "timeout: 9")).count("task DRIVE ran into its timeout"),
            0U);
  // Another behavior takes over, and DRIVE goes on.
  EXPECT_EQ(reasons(replaced("tasks:",
                             "- {behavior: ODOMETRY, task: LOCALIZE, suitability: 50}\n"
                             "tasks:"))
                .count("task DRIVE ran into its timeout"),
            0U);
  // LOCALIZE may have begun later, as it is not required.
  EXPECT_EQ(reasons(replaced(", requires: [{task: LOCALIZE}]", ""))
                .count("task DRIVE ran into its timeout"),
            0U);
}

}  // namespace
}  // namespace cbc::goal_facts_test
