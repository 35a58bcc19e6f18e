// The plain search against catalogs whose states are counted by hand.
#include "plain_exploration.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"

namespace cbc::plain::plain_exploration_test {
namespace {

constexpr std::uint64_t most_states = 1000;

using Counts = std::vector<std::uint64_t>;
using Depths = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

CompiledCatalog compile(const std::string& yaml) { return oracle::compile_yaml(yaml).value(); }

Exploration explore_all(const CompiledCatalog& catalog, const Assumptions& assumptions,
                        const std::vector<const Property*>& properties = {}) {
  std::vector<GroupId> groups;
  for (GroupId group(0); group < catalog.group_count(); ++group) groups.push_back(group);
  return explore_plainly(catalog, groups, assumptions, properties, most_states);
}

TEST(PlainExploration, CountsOneTask) {
  const CompiledCatalog catalog = compile("behaviors: [{behavior: A_BY, task: A}]");
  Assumptions assumptions = default_assumptions(catalog);
  // Stopped: start. Running: start, stop, success, failure.
  Exploration result = explore_all(catalog, assumptions);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 1}));
  EXPECT_EQ(result.transitions, 5U);
  EXPECT_EQ(result.runs, (Depths{{0, 1}}));
  EXPECT_EQ(result.active, (Depths{{0, 1}}));
  EXPECT_EQ(result.start_refused, Depths{});

  // With a fault: stopped, running, each faulty or not. One move more in each of them.
  assumptions.faults = 1;
  Property can_start;
  can_start.task = TaskId(0);
  result = explore_all(catalog, assumptions, {&can_start});
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 14U);
  EXPECT_EQ(result.start_refused, (Depths{{0, 1}}));
  EXPECT_EQ(result.verdicts.at(0).result, Verdict::Result::violated);
  EXPECT_EQ(result.verdicts.at(0).script,
            (std::vector<Move>{{Move::Kind::fault, 0, 0}, {Move::Kind::start, 0, 1}}));
}

// States, by what runs and what is in the queue:
//   0 nothing, R         start A -> 1, due -> 2
//   1 A                  start A, stop A -> 0, success -> 0, failure -> 0
//   2 R                  start A -> 1, failure of R -> 3 (its own end: R does not join the
//                        queue), and if it may be stopped, stop R -> 3
//   3 nothing            start A -> 1
TEST(PlainExploration, CountsReactiveTask) {
  const CompiledCatalog catalog = compile(R"(
tasks:
- {task: A}
- {task: R, reactive_start: true, execution_goal: keep_running}
behaviors:
- {behavior: A_BY, task: A}
- {behavior: R_BY, task: R}
exclusivity_constraints:
- mutually_exclusive: [A, R]
)");
  Property settled;
  settled.kind = Property::Kind::never;
  settled.condition.parts = {StateCondition::of_task(StateCondition::Kind::stopped, TaskId(0)),
                             StateCondition::of_task(StateCondition::Kind::stopped, TaskId(1))};
  settled.settled = true;
  Assumptions assumptions = default_assumptions(catalog);
  Exploration result = explore_all(catalog, assumptions, {&settled});
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 9U);
  EXPECT_EQ(result.runs, (Depths{{0, 1}, {1, 1}}));
  EXPECT_TRUE(result.together.empty());
  EXPECT_EQ(result.verdicts.at(0).script,
            (std::vector<Move>{{Move::Kind::due, 0, 0}, {Move::Kind::failure, 1, 0}}));
  assumptions.stop.push_back(catalog.task_ids[1]);
  result = explore_all(catalog, assumptions, {&settled});
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 10U);
  EXPECT_EQ(result.verdicts.at(0).script,
            (std::vector<Move>{{Move::Kind::due, 0, 0}, {Move::Kind::stop, 1, 0}}));
}

// R and A exclude one another by what they require. States, by what runs, queue, waiting:
//   0 -, R, -      start A -> 1, due -> 2
//   1 A S2, R, -   start A, stop A -> 0, success A -> 0, failure A -> 0, failure S2 -> 0, due -> 3
//   2 R S1, -, -   start A -> 1 (R joins the queue), failure R -> 4, failure S1 -> 0 (R joins)
//   3 A S2, -, R   start A -> 5 (R tries again); stop, success, failure A, failure S2 -> 6
//   4 -, -, -      start A -> 7
//   5 A S2, R, R   start A; stop, success, failure A, failure S2 -> 6; due -> 3, without an event
//   6 -, R, R      start A -> 5, due -> 2
//   7 A S2, -, -   start A; stop, success, failure A, failure S2 -> 4
TEST(PlainExploration, CountsWaitingTask) {
  const CompiledCatalog catalog = compile(R"(
tasks:
- {task: A}
- {task: R, reactive_start: true, execution_goal: keep_running}
- {task: S1, start_on_request: false, execution_goal: keep_running}
- {task: S2, start_on_request: false, execution_goal: keep_running}
behaviors:
- {behavior: A_BY, task: A, requires: [{task: S2}]}
- {behavior: R_BY, task: R, requires: [{task: S1}]}
- {behavior: S1_BY, task: S1}
- {behavior: S2_BY, task: S2}
exclusivity_constraints:
- mutually_exclusive: [S1, S2]
)");
  const Exploration result = explore_all(catalog, default_assumptions(catalog));
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 2, 3}));
  EXPECT_EQ(result.transitions, 2U + 6 + 3 + 5 + 1 + 6 + 2 + 5);
  ASSERT_EQ(result.together.size(), 2U);
  EXPECT_EQ(result.together[0].b, 3U);
  EXPECT_EQ(result.together[1].a, 1U);
}

// Two groups: nothing runs, A, B, A before B, B before A. Start and stop, success, failure of each
// that runs.
TEST(PlainExploration, CountsOrdersOfEqualPriorities) {
  const CompiledCatalog catalog =
      compile("behaviors: [{behavior: A_BY, task: A}, {behavior: B_BY, task: B}]");
  Assumptions assumptions = default_assumptions(catalog);
  Exploration result = explore_all(catalog, assumptions);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 2}));
  EXPECT_EQ(result.transitions, 2U + 2 * (2 + 3) + 2 * (2 + 6));
  // The order between priorities decides nothing.
  assumptions.start[1].priorities = {2};
  result = explore_all(catalog, assumptions);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 2U + 2 * (2 + 3) + (2 + 6));
}

const char* const two_variables = R"(
situation: [{variable: V}, {variable: W}]
behaviors:
- {behavior: A_BY_V, task: A, situation: {V: true}}
- {behavior: A_BY_W, task: A, situation: {W: true}}
- {behavior: B_BY, task: B}
)";

// Nothing starts: three of four situations; two moves in the first, one in each other.
TEST(PlainExploration, LeavesOutExcludedSituations) {
  const CompiledCatalog catalog = compile(two_variables);
  Assumptions assumptions;
  assumptions.variables = {0, 1};
  assumptions.never.push_back({{{0, 1}, {1, 1}}, {}});
  const Exploration result = explore_plainly(catalog, {GroupId(0)}, assumptions, {}, most_states);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2}));
  EXPECT_EQ(result.transitions, 4U);
  // The other group has none of these variables, so nothing is excluded: one state.
  EXPECT_EQ(explore_plainly(catalog, {GroupId(1)}, assumptions, {}, most_states).states, 1U);
}

// Nothing starts. The group of A knows V, that of B knows X and, by an entry of `never`, W. Another
// entry ties V and W: (V, W, X) without (-, 1, 1) and (1, 1, -), five of eight.
TEST(PlainExploration, AddsWhatNeverTiesToTheState) {
  const CompiledCatalog catalog = compile(R"(
situation: [{variable: V}, {variable: W}, {variable: X}]
behaviors:
- {behavior: A_BY_V, task: A, situation: {V: true}}
- {behavior: B_BY_X, task: B, situation: {X: true}}
)");
  Assumptions assumptions;
  assumptions.variables = {0, 1, 2};
  assumptions.never.push_back({{{1, 1}, {2, 1}}, {}});
  const auto explore_group = [&](std::uint32_t group) {
    return explore_plainly(catalog, {GroupId(group)}, assumptions, {}, most_states);
  };
  // V alone; W and X but for both.
  EXPECT_EQ(explore_group(0).states_at_depth, (Counts{1, 1}));
  EXPECT_EQ(explore_group(1).states_at_depth, (Counts{1, 2}));
  assumptions.never.push_back({{{0, 1}, {1, 1}}, {}});
  for (const std::uint32_t group : {0U, 1U}) {
    EXPECT_EQ(explore_group(group).states_at_depth, (Counts{1, 3, 1}));
    // Of the first state, of the three with one of them, of V with X.
    EXPECT_EQ(explore_group(group).transitions, 3U + 2 + 1 + 2 + 2);
  }
  // The availability of a behavior of the other group, which may change.
  assumptions.never = {{{{0, 1}}, {{BehaviorId(1), false}}}};
  EXPECT_EQ(explore_group(0).states, 2U);
  assumptions.behaviors = {BehaviorId(1)};
  EXPECT_EQ(explore_group(0).states_at_depth, (Counts{1, 2}));
}

// V and W change one by one, or both at once: four situations, three moves in each.
TEST(PlainExploration, ChangesVariablesTogether) {
  const CompiledCatalog catalog = compile(two_variables);
  Assumptions assumptions;
  assumptions.variables = {0, 1};
  assumptions.together = {{0, 1}};
  Property both;
  both.kind = Property::Kind::reachable;
  both.condition.parts = {StateCondition::of_variable(0, {1}), StateCondition::of_variable(1, {1})};
  const auto explore_group = [&](std::uint32_t group) {
    return explore_plainly(catalog, {GroupId(group)}, assumptions, {&both}, most_states);
  };
  Exploration result = explore_group(0);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 3}));
  EXPECT_EQ(result.transitions, 12U);
  EXPECT_EQ(result.verdicts.at(0).script, (std::vector<Move>{{Move::Kind::together, 0, 3}}));
  assumptions.never = {{{{0, 0}, {1, 1}}, {}}, {{{0, 1}, {1, 0}}, {}}};
  result = explore_group(0);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 1}));
  EXPECT_EQ(result.transitions, 2U);
  assumptions.together.clear();
  EXPECT_EQ(explore_group(0).states, 1U);
}

TEST(PlainExploration, LetsOnlySomeBehaviorsFail) {
  const CompiledCatalog catalog =
      compile("behaviors: [{behavior: A_BY, task: A}, {behavior: A_TOO, task: A}]");
  Assumptions assumptions;
  assumptions.faults = 2;
  EXPECT_EQ(explore_all(catalog, assumptions).states_at_depth, (Counts{1, 2, 1}));
  assumptions.listed_for_faults = {BehaviorId(1)};
  EXPECT_EQ(explore_all(catalog, assumptions).states_at_depth, (Counts{1, 1}));
  assumptions.only_listed_fail = true;
  Property faulty;
  faulty.kind = Property::Kind::reachable;
  faulty.condition = StateCondition::of_behavior(StateCondition::Kind::faulty, BehaviorId(0));
  const Exploration result = explore_all(catalog, assumptions, {&faulty});
  EXPECT_EQ(result.states_at_depth, (Counts{1, 1}));
  EXPECT_EQ(result.verdicts.at(0).result, Verdict::Result::violated);
}

TEST(PlainExploration, RefusesAnExcludedFirstState) {
  const CompiledCatalog catalog = compile(two_variables);
  Assumptions assumptions;
  assumptions.initially.variables = {{0, 1}};
  assumptions.never.push_back({{{0, 1}}, {}});
  const Exploration result = explore_plainly(catalog, {GroupId(0)}, assumptions, {}, most_states);
  EXPECT_TRUE(result.error.has_value());
  // Variables that do not change have their initial value everywhere.
  EXPECT_TRUE(
      explore_plainly(catalog, {GroupId(1)}, assumptions, {}, most_states).error.has_value());
  assumptions.variables = {0};
  EXPECT_FALSE(
      explore_plainly(catalog, {GroupId(1)}, assumptions, {}, most_states).error.has_value());
}

// Stopped: start; own(A_BY) true or not. Running with own(A_BY) false, it may finish for that.
TEST(PlainExploration, CountsOwnAnswers) {
  const CompiledCatalog catalog = compile("behaviors: [{behavior: A_BY, task: A}]");
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.behaviors = {BehaviorId(0)};
  const Exploration result = explore_all(catalog, assumptions);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 2U + 5 + 2 + 6);
}

TEST(PlainExploration, ComparesPrioritiesInTheOrderOfTheList) {
  const CompiledCatalog catalog = compile("behaviors: [{behavior: A_BY, task: A}]");
  Assumptions assumptions;
  assumptions.start = {{TaskId(0), {3, 1}}};
  Property runs;
  runs.kind = Property::Kind::reachable;
  runs.condition = StateCondition::of_task(StateCondition::Kind::running, TaskId(0));
  const Exploration result = explore_all(catalog, assumptions, {&runs});
  EXPECT_EQ(result.verdicts.at(0).result, Verdict::Result::proved);
  EXPECT_EQ(result.verdicts.at(0).script, (std::vector<Move>{{Move::Kind::start, 0, 3}}));
}

}  // namespace
}  // namespace cbc::plain::plain_exploration_test
