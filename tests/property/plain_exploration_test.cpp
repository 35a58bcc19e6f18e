// The plain search against catalogs whose states are counted by hand, and its scripts against one
// coordinator that runs them from the start. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include "plain_exploration.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "demand.h"
#include "move_replay.h"
#include "plain_model.h"
#include "random_cases.h"
#include "verify_case.h"

namespace cbc::plain::plain_exploration_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 500;
constexpr std::uint64_t most_states = 1000;

using Counts = std::vector<std::uint64_t>;
using Depths = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

CompiledCatalog compile(const std::string& yaml) { return oracle::compile_yaml(yaml).value(); }

Exploration explore_all(const CompiledCatalog& catalog, const Assumptions& assumptions,
                        const std::vector<const Property*>& properties = {}) {
  std::vector<std::uint32_t> groups;
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) groups.push_back(group);
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
  can_start.task = 0;
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
//   2 R                  start A -> 1, failure of R -> 3 (its own finish: R does not join the
//   queue) 3 nothing            start A -> 1
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
  settled.condition.stopped = {0, 1};
  settled.settled = true;
  const Exploration result = explore_all(catalog, default_assumptions(catalog), {&settled});
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 9U);
  EXPECT_EQ(result.runs, (Depths{{0, 1}, {1, 1}}));
  EXPECT_TRUE(result.together.empty());
  EXPECT_EQ(result.verdicts.at(0).script,
            (std::vector<Move>{{Move::Kind::due, 0, 0}, {Move::Kind::failure, 1, 0}}));
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
  const Exploration result = explore_plainly(catalog, {0}, assumptions, {}, most_states);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2}));
  EXPECT_EQ(result.transitions, 4U);
  // The other group has none of these variables, so nothing is excluded: one state.
  EXPECT_EQ(explore_plainly(catalog, {1}, assumptions, {}, most_states).states, 1U);
}

TEST(PlainExploration, RefusesAnExcludedFirstState) {
  const CompiledCatalog catalog = compile(two_variables);
  Assumptions assumptions;
  assumptions.initially.variables = {{0, 1}};
  assumptions.never.push_back({{{0, 1}}, {}});
  const Exploration result = explore_plainly(catalog, {0}, assumptions, {}, most_states);
  EXPECT_TRUE(result.error.has_value());
  // Variables that do not change have their initial value everywhere.
  EXPECT_TRUE(explore_plainly(catalog, {1}, assumptions, {}, most_states).error.has_value());
  assumptions.variables = {0};
  EXPECT_FALSE(explore_plainly(catalog, {1}, assumptions, {}, most_states).error.has_value());
}

// Stopped: start; own(A_BY) true or not. Running with own(A_BY) false, it may finish for that.
TEST(PlainExploration, CountsOwnAnswers) {
  const CompiledCatalog catalog = compile("behaviors: [{behavior: A_BY, task: A}]");
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.behaviors = {0};
  const Exploration result = explore_all(catalog, assumptions);
  EXPECT_EQ(result.states_at_depth, (Counts{1, 2, 1}));
  EXPECT_EQ(result.transitions, 2U + 5 + 2 + 6);
}

TEST(PlainExploration, ComparesPrioritiesInTheOrderOfTheList) {
  const CompiledCatalog catalog = compile("behaviors: [{behavior: A_BY, task: A}]");
  Assumptions assumptions;
  assumptions.start = {{0, {3, 1}}};
  Property runs;
  runs.kind = Property::Kind::reachable;
  runs.condition.running = {{0, none}};
  const Exploration result = explore_all(catalog, assumptions, {&runs});
  EXPECT_EQ(result.verdicts.at(0).result, Verdict::Result::proved);
  EXPECT_EQ(result.verdicts.at(0).script, (std::vector<Move>{{Move::Kind::start, 0, 3}}));
}

/// Whether the end of its script is what a property forbids, or asks for.
bool ends_as_stated(const PlainModel& model, const Property& property, const Replay& replayed) {
  switch (property.kind) {
    case Property::Kind::can_start:
      return replayed.outcome == Outcome::rejected;
    case Property::Kind::always:
      return (!property.when || model.holds(*property.when, replayed.end)) &&
             !model.holds(property.condition, replayed.end);
    case Property::Kind::never:
    case Property::Kind::reachable:
      return model.holds(property.condition, replayed.end);
  }
  return false;
}

void replay_scripts(const VerifyCase& sample, const Exploration& result,
                    oracle::Statistics& statistics) {
  std::set<std::uint32_t> variables;
  for (const Property& property : sample.question.properties) {
    variables.merge(variables_of(property));
  }
  const PlainModel model(sample.catalog, sample.question.groups, sample.question.assumptions,
                         variables);
  for (std::size_t i = 0; i < sample.question.properties.size(); ++i) {
    const Property& property = sample.question.properties[i];
    const std::vector<Move>& script = result.verdicts[i].script;
    statistics.count(result.verdicts[i].result == Verdict::Result::proved ? "proved" : "violated");
    if (!result.verdicts[i].has_script) continue;
    Snapshot state = model.first_state();
    for (const Move& move : script) state = model.step(state, move).next;
    const Replay replayed = replay(model, script);
    const std::string text = " after\n" + text_of(sample.catalog, script);
    demand(model.key(replayed.end) == model.key(state), "another state" + text);
    demand(ends_as_stated(model, property, replayed), property.name + ": another end" + text);
    if (script.size() > 3) statistics.count("script of more than three moves");
    if (std::count(script.begin(), script.end(), Move{}) > 1) statistics.count("two dues");
  }
}

void count_sort_of_case(const VerifyCase& sample, const Exploration& result,
                        const Rarities& rarities, oracle::Statistics& statistics) {
  const auto count = [&](const char* what, bool happened) {
    if (happened) statistics.count(what);
  };
  count("joined groups", sample.question.groups.size() > 1);
  count("failed rollback", rarities.fault_finishes > 0);
  count("due without an event", rarities.silent_dues > 0);
  count("several sets in the queue", rarities.long_queues > 0);
  count("waiting tasks", rarities.waiting > 0);
  count("refused starts", !result.start_refused.empty());
  count("100 states", result.states >= 100);
  count("depth of 8", result.depth >= 8);
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample;
  try {
    sample = generate_verify_case(seed);
    Rarities rarities;
    const Exploration result =
        explore_plainly(sample.catalog, sample.question.groups, sample.question.assumptions,
                        sample.properties(), most_states, &rarities);
    if (result.error) {
      results.statistics.count("excluded first state");
    } else if (!result.complete) {
      results.statistics.count("too many states");
    } else {
      count_sort_of_case(sample, result, rarities, results.statistics);
      replay_scripts(sample, result, results.statistics);
    }
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        text_of(sample) + "--- fault\n" + error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"proved", 800},
    {"violated", 800},
    {"script of more than three moves", 60},
    {"two dues", 5},
    {"joined groups", 40},
    {"failed rollback", 4},
    {"due without an event", 80},
    {"several sets in the queue", 50},
    {"waiting tasks", 60},
    {"refused starts", 150},
    {"100 states", 100},
    {"depth of 8", 60},
};

TEST(PlainExploration, ScriptsEndAsStated) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::plain_exploration_test
