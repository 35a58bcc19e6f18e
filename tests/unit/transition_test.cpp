#include "runtime/coordinator/transition.h"

#include <string>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"
#include "unit/stage.h"

namespace cbc::transition_test {
namespace {

using test::Stage;

// Levels: c is 0, b1 and b2 are 1, a is 2, z is 0.
constexpr const char* chain = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: Z}, {task: A}, {task: B}, {task: D}, {task: C}]
behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: D}]}
- {behavior: b2, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: d, task: D, requires: [{task: C}]}
- {behavior: z, task: Z}
- {behavior: c, task: C}
exclusivity_constraints:
- mutually_exclusive: [A, Z]
)";

TEST(Transition, ActivatesFromTheGroundUpAndDeactivatesFromTheTopDown) {
  Stage stage(chain);
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.changes(), "+c required, +b1 required, +d required, +a requested 1");
  EXPECT_EQ(stage.start("Z"), "accepted");
  EXPECT_EQ(stage.changes(),
            "-a displaced 1, -b1 released, -d released, -c released, +z requested 1")
      << "all deactivations first; of one level in catalog order";
  EXPECT_EQ(stage.active(), "z");
}

TEST(Transition, TasksOfALongChainStopWithWhatPerformedThem) {
  constexpr int length = 2'000;
  std::string catalog = "default_values: {tasks: {start_on_request: false}}\nbehaviors:\n";
  std::string changes;
  for (int task = 0; task < length; ++task) {
    const std::string number = std::to_string(task);
    catalog += "- {behavior: b" + number + ", task: T" + number;
    if (task + 1 < length) catalog += ", requires: [{task: T" + std::to_string(task + 1) + "}]";
    catalog += "}\n";
    changes += (task == 0 ? "-b" : ", -b") + number + (task == 0 ? " requested 1" : " released");
  }
  Stage stage(catalog);
  EXPECT_EQ(stage.start("T0"), "accepted");
  EXPECT_EQ(stage.stop("T0"), "accepted");
  EXPECT_EQ(stage.changes(), changes);
}

TEST(Transition, CatalogOrderIsThatOfBehaviorsNotOfTheirTasks) {
  Stage stage(R"(
tasks: [{task: A}, {task: B}, {task: C}]
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: c, task: C}
- {behavior: b, task: B}
- {behavior: a, task: A, requires: [{task: B}, {task: C}]}
)");
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.changes(), "+c required, +b required, +a requested 1");
}

TEST(Transition, AReplacedBehaviorIsOneDeactivationAndOneActivation) {
  Stage stage(chain, {}, {{"b1", false}});
  EXPECT_EQ(stage.start("A", 4), "accepted");
  EXPECT_EQ(stage.changes(), "+c required, +b2 required, +d required, +a requested 4");
  stage.set({{"b1", true}});
  EXPECT_EQ(stage.start("A", 5), "accepted");
  EXPECT_EQ(stage.changes(), "-b2 replaced, +b1 required");
  EXPECT_EQ(stage.objectives(), "1/1 idle 4/5 changes 2");
}

TEST(Transition, ARestartComesLastAndIsOneOfEach) {
  Stage stage(chain, {}, {{"b1", false}});
  EXPECT_EQ(stage.start("A", 1, "p"), "accepted");
  stage.set({{"b1", true}});
  EXPECT_EQ(stage.start("A", 3, "q"), "accepted");
  EXPECT_EQ(stage.changes(), "-b2 replaced, +b1 required, -a restarted 1, +a restarted 3")
      << "the priority before the event, and the one after it";
  EXPECT_EQ(stage.objectives(), "1/1 idle 4/5 changes 2") << "a restart is no change";
}

TEST(Transition, AStopIsRequestedAndReleasesTheRest) {
  Stage stage(chain);
  stage.start("A", 2);
  EXPECT_EQ(stage.stop("A"), "accepted");
  EXPECT_EQ(stage.changes(), "-a requested 2, -b1 released, -d released, -c released");
  EXPECT_EQ(stage.stopped(), "A interrupted, B interrupted, D interrupted, C interrupted");
}

TEST(Transition, WhatFinishedIsNotDeactivatedAgain) {
  Stage stage(chain);
  stage.start("A", 2);
  EXPECT_EQ(stage.finish("a"), "accepted");
  EXPECT_EQ(stage.changes(), "-b1 released, -d released, -c released");
  EXPECT_EQ(stage.stopped(), "A goal_achieved, B interrupted, D interrupted, C interrupted");
  EXPECT_EQ(stage.objectives(), "0/0 idle 0/5 changes 3");
}

constexpr const char* several = R"(
tasks: [{task: A}, {task: B}, {task: C}]
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
- {behavior: a, task: A, suitability: 50}
- {behavior: b, task: B, suitability: 50}
- {behavior: c, task: C}
exclusivity_constraints:
- mutually_exclusive: [B, C]
)";

TEST(Transition, ABehaviorOfSeveralTasksHasThoseThatItPerforms) {
  Stage stage(several);
  EXPECT_EQ(stage.start("A", 1), "accepted");
  EXPECT_EQ(stage.changes(), "+x(A) requested 1");
  EXPECT_EQ(stage.start("B", 3), "accepted");
  EXPECT_EQ(stage.changes(), "") << "it is active already";
  EXPECT_EQ(stage.objectives(), "2/2 idle 0/0 changes 0");
  EXPECT_EQ(stage.stop("A"), "accepted");
  EXPECT_EQ(stage.changes(), "") << "B still has it";
  EXPECT_EQ(stage.stopped(), "A interrupted");
  EXPECT_EQ(stage.stop("B"), "accepted");
  EXPECT_EQ(stage.changes(), "-x(B) requested 3");
}

TEST(Transition, ABehaviorThatOneOfItsTasksKeepsIsNotDeactivated) {
  Stage stage(several);
  stage.start("A", 1);
  stage.start("B", 2);
  EXPECT_EQ(stage.start("C", 2), "accepted");
  EXPECT_EQ(stage.changes(), "+c requested 2");
  EXPECT_EQ(stage.stopped(), "B interrupted");
}

TEST(Transition, ReplacedWinsOverDisplaced) {
  // C excludes E, which only x requires: A goes on with a, B has to stop.
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A}, {task: B}, {task: C}, {task: E}]
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}], requires: [{task: E}]}
- {behavior: a, task: A, suitability: 50}
- {behavior: c, task: C}
- {behavior: e, task: E}
exclusivity_constraints:
- mutually_exclusive: [E, C]
)");
  stage.start("A", 1);
  stage.start("B", 2);
  EXPECT_EQ(stage.running(), "A=x B=x E=e");
  EXPECT_EQ(stage.start("C", 2), "accepted");
  EXPECT_EQ(stage.changes(), "-x(A,B) replaced 2, -e released, +a requested 1, +c requested 2")
      << "the priority is the highest of its tasks";
}

TEST(Transition, RequestedWinsOverReplacedOnAStop) {
  // Without A, which excludes E, the better way of B is free.
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A}, {task: B}, {task: E}]
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B, suitability: 50}]}
- {behavior: b, task: B, requires: [{task: E}]}
- {behavior: e, task: E}
exclusivity_constraints:
- mutually_exclusive: [A, E]
)");
  stage.start("A", 1);
  stage.start("B", 2);
  EXPECT_EQ(stage.running(), "A=x B=x");
  EXPECT_EQ(stage.stop("A"), "accepted");
  EXPECT_EQ(stage.changes(), "-x(A,B) requested 2, +e required, +b requested 2");
}

// T moves from t to x as soon as it can.
constexpr const char* joining = R"(
tasks:
- {task: A, reactive_start: true, start_on_request: false}
- {task: D}
- {task: T, start_on_request: false}
behaviors:
- {behavior: x, tasks: [{task: A}, {task: T}]}
- {behavior: d, task: D, requires: [{task: T}]}
- {behavior: t, task: T, suitability: 90}
)";

TEST(Transition, OfAnActivationRequestedWinsOverRequired) {
  Stage stage(joining, {}, {{"x", false}});
  stage.start("D", 3);
  stage.set({{"x", true}});
  EXPECT_EQ(stage.start("A", 2), "accepted");
  EXPECT_EQ(stage.changes(), "-t replaced, +x(A,T) requested 2");
}

TEST(Transition, OfAnActivationReactiveWinsOverRequired) {
  Stage stage(joining, {}, {{"x", false}});
  stage.start("D", 3);
  stage.set({{"x", true}});
  EXPECT_EQ(stage.settle_at(0.08), "accepted");
  EXPECT_EQ(stage.changes(), "-t replaced, +x(A,T) reactive 0");
}

TEST(Transition, AFaultIsUndoneByTheNextSolution) {
  // The way over b1 fails at the top, so that c2 has to go again.
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a1, task: A, requires: [{task: C}]}
- {behavior: a2, task: A, suitability: 90}
- {behavior: c, task: C}
)");
  stage.fault("a1");
  EXPECT_EQ(stage.start("A", 2), "accepted");
  EXPECT_EQ(stage.changes(), "+c required, +a1 requested 2 failed, -c undone, +a2 requested 2");
  EXPECT_EQ(stage.objectives(), "1/1 idle 1/2 changes 1");
}

// It takes several failures in one event to get here.
TEST(Transition, ARestartOnlyActivatesABehaviorThatIsInactiveByThen) {
  const CompiledCatalog catalog = test::compile_text(chain);
  State state(catalog);
  EventRecord record;
  Transition transition(catalog, state, record);
  Trigger trigger;
  trigger.task = test::task_id(catalog, "Z");
  trigger.priority = 2;
  const BehaviorId z = test::behavior_id(catalog, "z");
  state.set_value(trigger.task, 0, 0);
  const std::vector<BehaviorId> before{z};
  transition.load(trigger, before);
  const Assignment solution = test::answer_of(catalog, "Z=z");
  EXPECT_EQ(transition.apply(solution, z, 5), std::nullopt);
  ASSERT_EQ(record.changes.size(), 1U);
  EXPECT_EQ(record.changes[0].cause, ChangeCause::restarted) << "restarted wins over undone";
  EXPECT_EQ(transition.apply(solution, z, 5), std::nullopt);
  ASSERT_EQ(record.changes.size(), 3U);
  EXPECT_FALSE(record.changes[1].is_activation);
  EXPECT_TRUE(record.changes[2].is_activation);
}

}  // namespace
}  // namespace cbc::transition_test
