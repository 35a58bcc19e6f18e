#include "runtime/coordinator/coordinator.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"
#include "unit/stage.h"

// One test for each rule of docs/semantics.md, "Events", "Application" and "Reactive tasks", that
// is easy to get wrong.

namespace cbc::coordinator_test {
namespace {

using test::Stage;

// Start ----------------------------------------------------------------------------------------

// A and B exclude one another, and each has two behaviors. Z stands alone.
constexpr const char* rivals = R"(
tasks: [{task: A}, {task: B}, {task: Z, start_on_request: false}]
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A, suitability: 90}
- {behavior: b1, task: B}
- {behavior: b2, task: B, suitability: 90}
- {behavior: z, task: Z}
exclusivity_constraints:
- mutually_exclusive: [A, B]
)";

TEST(Start, HasPriorityOneUnlessGiven) {
  Stage stage(rivals);
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.requests(), "A:1");
  EXPECT_EQ(stage.searches(), "optimal protection 1 sizes 2 1");
}

TEST(Start, IsRejectedByAHigherRequestOfTheTaskItself) {
  Stage stage(rivals);
  stage.start("A", 5);
  EXPECT_EQ(stage.start("A", 4), "rejected");
  EXPECT_EQ(stage.events(), "start A 4 conflict A 5 rejected");
  EXPECT_EQ(stage.searches(), "none");
  EXPECT_EQ(stage.requests(), "A:5");
  EXPECT_EQ(stage.start("A", 5), "accepted");
  EXPECT_EQ(stage.start("A", 6), "accepted");
  EXPECT_EQ(stage.requests(), "A:6");
}

constexpr int many = 130;

/// That many behaviors b0, b1, ... of A, the best first.
std::string many_behaviors() {
  std::string catalog = "behaviors:\n";
  for (int i = 0; i < many; ++i) {
    catalog += fmt::format("- {{behavior: b{0}, task: A, suitability: {1}}}\n", i, 100 - i * 0.5);
  }
  return catalog;
}

TEST(Start, ChoosesAmongMoreThanSixtyFourBehaviors) {
  Stage stage(many_behaviors());
  for (int i = 0; i + 1 < many; ++i) {
    stage.fault(fmt::format("b{}", i));
    EXPECT_EQ(stage.start("A"), "accepted");
    EXPECT_EQ(stage.running(), fmt::format("A=b{}", i + 1));
    stage.stop("A");
    stage.set({{fmt::format("b{}", i), false}});
    EXPECT_EQ(stage.start("A"), "accepted");
    EXPECT_EQ(stage.running(), fmt::format("A=b{}", i + 1));
    EXPECT_EQ(stage.changes(), fmt::format("+b{} requested 1", i + 1));
    stage.stop("A");
  }
}

TEST(Start, LeavesOneOfMoreThanSixtyFourBehaviorsRunning) {
  Stage stage(many_behaviors() + "- {behavior: c, task: C, requires: [{task: A}]}\n");
  for (int i = 0; i + 1 < many; ++i) {
    stage.set({{fmt::format("b{}", i), false}});
    stage.start("A");
    EXPECT_EQ(stage.start("C"), "accepted");
    EXPECT_EQ(stage.running(), fmt::format("A=b{} C=c", i + 1));
    EXPECT_EQ(stage.changes(), "+c requested 1");
    stage.stop("A");
    EXPECT_EQ(stage.running(), "");
  }
}

TEST(Start, TakesTheFieldFromAnEqualPriorityNotFromAHigherOne) {
  Stage stage(rivals);
  stage.start("A", 2);
  EXPECT_EQ(stage.start("B", 1), "rejected");
  EXPECT_EQ(stage.searches(), "infeasible protection 1 sizes 2 2");
  EXPECT_EQ(stage.objectives(), "none");
  EXPECT_EQ(stage.changes(), "");
  EXPECT_EQ(stage.running(), "A=a1");
  EXPECT_EQ(stage.start("B", 2), "accepted");
  EXPECT_EQ(stage.running(), "B=b1");
  EXPECT_EQ(stage.requests(), "B:2");
  EXPECT_EQ(stage.objectives(), "1/2 idle 0/1 changes 2")
      << "the request that is lost is an active one of this event";
}

TEST(Start, CountsRequestsOfTheWholeCatalog) {
  Stage stage(rivals);
  stage.start("Z", 1);
  EXPECT_EQ(stage.objectives(), "1/1 idle 1/1 changes 1");
  stage.start("A", 1);
  EXPECT_EQ(stage.objectives(), "2/2 idle 1/1 changes 1");
  EXPECT_EQ(stage.running(), "A=a1 Z=z");
}

TEST(Start, OfATaskThatIsRequiredGivesItARequest) {
  Stage stage(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: T}]}
- {behavior: t, task: T}
tasks: [{task: A}, {task: T, start_on_request: false}]
)");
  stage.start("A", 3);
  EXPECT_EQ(stage.requests(), "A:3");
  EXPECT_EQ(stage.start("T", 1), "accepted");
  EXPECT_EQ(stage.requests(), "A:3 T:1");
  EXPECT_EQ(stage.changes(), "");
}

TEST(Start, RejectsWhatHasNoAvailableBehavior) {
  Stage stage(rivals, {}, {{"a1", false}, {"a2", false}});
  EXPECT_EQ(stage.start("A"), "rejected");
  stage.set({{"a2", true}});
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.running(), "A=a2");
}

TEST(Start, MayMoveATaskBackToABetterBehavior) {
  Stage stage(rivals, {}, {{"a1", false}});
  stage.start("A");
  stage.set({{"a1", true}});
  EXPECT_EQ(stage.running(), "A=a2") << "a situation is no coordination";
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.running(), "A=a1");
}

TEST(Situation, DoesNotStopAnActiveBehavior) {
  Stage stage(rivals);
  stage.start("A");
  EXPECT_EQ(stage.set({{"a1", false}}), "unchanged");
  EXPECT_EQ(stage.searches(), "none");
  EXPECT_EQ(stage.start("A", 3), "accepted");
  EXPECT_EQ(stage.running(), "A=a1") << "keeping it is no activation";
  stage.stop("A");
  stage.start("A");
  EXPECT_EQ(stage.running(), "A=a2");
}

TEST(Fault, AndRepairAndWaitChangeNothingAtOnce) {
  Stage stage(rivals);
  stage.start("A");
  EXPECT_EQ(stage.fault("a1"), "unchanged");
  EXPECT_EQ(stage.events(), "fault a1 unchanged");
  EXPECT_EQ(stage.running(), "A=a1");
  EXPECT_EQ(stage.repair("a1"), "unchanged");
  EXPECT_EQ(stage.wait(), "unchanged");
  EXPECT_EQ(stage.events(), "wait unchanged");
}

// Parameters -----------------------------------------------------------------------------------

constexpr const char* one_task = "behaviors: [{behavior: a, task: A}]";
constexpr const char* restart = "-a restarted 1, +a restarted 1";

TEST(Parameters, ThatChangeRestartTheBehavior) {
  Stage stage(one_task);
  stage.start("A", 1, "p");
  EXPECT_EQ(stage.changes(), "+a requested 1") << "the first time is no restart";
  stage.start("A", 1, "p");
  EXPECT_EQ(stage.changes(), "");
  stage.start("A", 1, "q");
  EXPECT_EQ(stage.changes(), restart);
}

TEST(Parameters, NotGivenAreThoseOfThePresentRequest) {
  Stage stage(one_task);
  stage.start("A", 1, "p");
  stage.start("A", 1);
  EXPECT_EQ(stage.changes(), "");
  stage.start("A", 1, "p");
  EXPECT_EQ(stage.changes(), "");
}

TEST(Parameters, GivenEmptyClear) {
  Stage stage(one_task);
  stage.start("A", 1, "p");
  stage.start("A", 1, "");
  EXPECT_EQ(stage.changes(), restart);
  stage.start("A", 1);
  EXPECT_EQ(stage.changes(), "");
}

TEST(Parameters, AreForgottenWithTheRequest) {
  Stage stage(one_task);
  stage.start("A", 1, "p");
  stage.stop("A");
  stage.start("A", 1);
  stage.start("A", 1, "");
  EXPECT_EQ(stage.changes(), "") << "they were empty already";
}

TEST(Parameters, OfATaskWithoutRequestAreEmpty) {
  Stage stage(R"(
tasks: [{task: A}, {task: T, start_on_request: false}]
behaviors:
- {behavior: a, task: A, requires: [{task: T}]}
- {behavior: t, task: T}
)");
  stage.start("A");
  stage.start("T", 2);
  EXPECT_EQ(stage.changes(), "");
  stage.stop("A");
  stage.stop("T");
  stage.start("A");
  stage.start("T", 2, "p");
  EXPECT_EQ(stage.changes(), "-t restarted, +t restarted 2")
      << "no request before the event, one of priority 2 after it";
}

TEST(Parameters, RestartNothingWhereTheBehaviorChanges) {
  Stage stage(rivals, {}, {{"a1", false}});
  stage.start("A", 1, "p");
  stage.set({{"a1", true}});
  stage.start("A", 1, "q");
  EXPECT_EQ(stage.changes(), "-a2 replaced 1, +a1 requested 1");
}

TEST(Parameters, OfARejectedStartAreNotTaken) {
  Stage stage(one_task);
  stage.start("A", 2, "p");
  stage.start("A", 1, "q");
  stage.start("A", 2, "p");
  EXPECT_EQ(stage.changes(), "");
}

// Stop -----------------------------------------------------------------------------------------

TEST(Stop, HasThePriorityOfTheRequestUnlessGiven) {
  Stage stage(rivals);
  stage.start("A", 4);
  EXPECT_EQ(stage.stop("A"), "accepted");
  EXPECT_EQ(stage.events(), "stop A 4 accepted");
  EXPECT_EQ(stage.searches(), "optimal protection 4 sizes 1 1");
  EXPECT_EQ(stage.running(), "");
}

TEST(Stop, IsRejectedByAHigherRequest) {
  Stage stage(rivals);
  stage.start("A", 4);
  EXPECT_EQ(stage.stop("A", 3), "rejected");
  EXPECT_EQ(stage.events(), "stop A 3 conflict A 4 rejected");
  EXPECT_EQ(stage.running(), "A=a1");
  EXPECT_EQ(stage.stop("A", 5), "accepted");
}

TEST(Stop, OfWhatDoesNotRunChangesNothing) {
  Stage stage(rivals);
  EXPECT_EQ(stage.stop("A"), "unchanged");
  EXPECT_EQ(stage.events(), "stop A 0 unchanged");
  EXPECT_EQ(stage.searches(), "none");
  EXPECT_EQ(stage.stop("A", 7), "unchanged");
  EXPECT_EQ(stage.events(), "stop A 7 unchanged");
}

// A needs T; B does so if it can, but prefers T to its other way.
constexpr const char* supported = R"(
tasks: [{task: A}, {task: B}, {task: T, start_on_request: false}]
behaviors:
- {behavior: a, task: A, requires: [{task: T}]}
- {behavior: b1, task: B, requires: [{task: T}]}
- {behavior: b2, task: B, suitability: 90}
- {behavior: t1, task: T}
- {behavior: t2, task: T, suitability: 80}
)";

TEST(Stop, OfARequiredTaskIsUpToProtection) {
  Stage stage(supported);
  stage.start("A", 1);
  EXPECT_EQ(stage.stop("T"), "rejected") << "its priority is 0, and A has 1";
  EXPECT_EQ(stage.searches(), "infeasible protection 0 sizes 1 1 1");
  EXPECT_EQ(stage.stop("T", 1), "accepted");
  EXPECT_EQ(stage.stopped(), "A interrupted, T interrupted");
  EXPECT_EQ(stage.objectives(), "0/1 idle 0/1 changes 2");
}

TEST(Stop, LeavesWhatCanGoOnAnotherWay) {
  Stage stage(supported);
  stage.start("B", 9);
  EXPECT_EQ(stage.running(), "B=b1 T=t1");
  EXPECT_EQ(stage.stop("T"), "accepted");
  EXPECT_EQ(stage.running(), "B=b2");
  EXPECT_EQ(stage.changes(), "-b1 replaced 9, -t1 requested, +b2 requested 9");
}

// Finish ---------------------------------------------------------------------------------------

TEST(Finish, OfWhatIsNotActiveChangesNothing) {
  Stage stage(rivals);
  EXPECT_EQ(stage.finish("a1"), "unchanged");
  EXPECT_EQ(stage.searches(), "none");
  stage.start("A");
  EXPECT_EQ(stage.finish("a2", FinishCause::process_failure), "unchanged");
}

TEST(Finish, WithSuccessLeavesTheBehaviorToOtherTasks) {
  Stage stage(R"(
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
- {behavior: b, task: B, suitability: 50}
)");
  stage.start("A");
  stage.set({{"x", false}});
  stage.start("B");
  EXPECT_EQ(stage.running(), "A=x B=b");
  stage.set({{"x", true}});
  EXPECT_EQ(stage.finish("x"), "accepted");
  EXPECT_EQ(stage.running(), "B=x");
}

TEST(Stop, EndsTheRequestInTheObjectives) {
  Stage stage(rivals);
  stage.start("A");
  EXPECT_EQ(stage.stop("A"), "accepted");
  EXPECT_EQ(stage.objectives(), "0/0 idle 0/1 changes 1");
}

TEST(Finish, WithSuccessEndsTheRequest) {
  Stage stage(rivals);
  stage.start("A", 3);
  EXPECT_EQ(stage.finish("a1"), "accepted");
  EXPECT_EQ(stage.stopped(), "A goal_achieved");
  EXPECT_EQ(stage.requests(), "");
  EXPECT_EQ(stage.objectives(), "0/0 idle 0/1 changes 0");
  EXPECT_EQ(stage.searches(), "optimal protection 3 sizes 1 1");
}

TEST(Finish, WithFailureTriesAnotherBehavior) {
  Stage stage(rivals);
  stage.start("A", 3);
  EXPECT_EQ(stage.finish("a1", FinishCause::wrong_progress), "accepted");
  EXPECT_EQ(stage.running(), "A=a2");
  EXPECT_EQ(stage.requests(), "A:3");
  EXPECT_EQ(stage.changes(), "+a2 requested 3");
  EXPECT_EQ(stage.stopped(), "");
  EXPECT_EQ(stage.finish("a2", FinishCause::interrupted), "accepted");
  EXPECT_EQ(stage.running(), "A=a1") << "an event that is over excludes nothing";
}

TEST(Finish, WithFailureAndNoOtherWayStopsTheTask) {
  Stage stage(rivals, {}, {{"a2", false}});
  stage.start("A", 3);
  EXPECT_EQ(stage.finish("a1", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.stopped(), "A process_failure");
  EXPECT_EQ(stage.objectives(), "0/1 idle 0/1 changes 0");
}

TEST(Finish, WithASituationChangeMayChooseTheBehaviorAgain) {
  Stage stage(rivals);
  stage.start("A", 3);
  EXPECT_EQ(stage.finish("a1", FinishCause::situation_change), "accepted");
  EXPECT_EQ(stage.changes(), "+a1 requested 3") << "which is an activation";
  EXPECT_EQ(stage.objectives(), "1/1 idle 0/1 changes 1");
  stage.set({{"a1", false}});
  EXPECT_EQ(stage.finish("a1", FinishCause::situation_change), "accepted");
  EXPECT_EQ(stage.changes(), "+a2 requested 3");
}

TEST(Finish, StopsEveryTaskOfTheBehavior) {
  Stage stage(R"(
tasks: [{task: A}, {task: B}, {task: C}]
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}, {task: C}]}
)");
  stage.start("A", 1);
  stage.start("C", 4);
  EXPECT_EQ(stage.finish("x"), "accepted");
  EXPECT_EQ(stage.stopped(), "A goal_achieved, C goal_achieved");
  EXPECT_EQ(stage.searches(), "optimal protection 4 sizes 1 1 1");
}

TEST(Finish, FailureExcludesTheBehaviorFromOtherTasksToo) {
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
- {behavior: a, task: A, suitability: 50, requires: [{task: B}]}
- {behavior: b, task: B, suitability: 50}
)");
  stage.start("A");
  EXPECT_EQ(stage.running(), "A=x");
  EXPECT_EQ(stage.finish("x", FinishCause::time_out), "accepted");
  EXPECT_EQ(stage.running(), "A=a B=b");
}

// T, which C and D require, has one behavior left.
constexpr const char* escalating = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: C}, {task: D}, {task: T}]
behaviors:
- {behavior: c, task: C, requires: [{task: T}]}
- {behavior: d1, task: D, requires: [{task: T}]}
- {behavior: d2, task: D, suitability: 10}
- {behavior: t, task: T}
)";

TEST(Finish, RaisesTheProtectionLevelUntilThereIsASolution) {
  Stage stage(escalating, {}, {{"d2", false}});
  stage.start("C", 2);
  stage.start("D", 4);
  EXPECT_EQ(stage.finish("t", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.searches(), "optimal protection 4 escalated sizes 2 2 1");
  EXPECT_EQ(stage.stopped(), "C interrupted, D interrupted, T process_failure");
}

TEST(Finish, RaisesTheProtectionLevelNoFurtherThanNeeded) {
  Stage stage(escalating);
  stage.start("C", 2);
  stage.start("D", 4);
  EXPECT_EQ(stage.finish("t", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.searches(), "optimal protection 2 escalated sizes 2 2 1");
  EXPECT_EQ(stage.running(), "D=d2");
  EXPECT_EQ(stage.requests(), "D:4");
}

TEST(Finish, BeginsAtThePriorityOfItsOwnRequest) {
  Stage stage(escalating, {}, {{"d2", false}});
  stage.start("C", 2);
  stage.start("T", 3);
  EXPECT_EQ(stage.finish("t"), "accepted");
  EXPECT_EQ(stage.searches(), "optimal protection 3 sizes 2 2 1");
}

TEST(Finish, OfASupportLetsWhatRequiresItGoOnAnotherWay) {
  Stage stage(supported);
  stage.start("A", 1);
  EXPECT_EQ(stage.finish("t1", FinishCause::wrong_progress), "accepted");
  EXPECT_EQ(stage.running(), "A=a T=t2");
  EXPECT_EQ(stage.searches(), "optimal protection 0 sizes 1 1 2");
}

// Which requests are kept ----------------------------------------------------------------------

// C stops A or B, as it likes.
constexpr const char* choice = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A}, {task: B}, {task: C}]
behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B}
- {behavior: c1, task: C, requires: [{task: P}]}
- {behavior: c2, task: C, requires: [{task: Q}]}
- {behavior: p, task: P}
- {behavior: q, task: Q, suitability: 50}
exclusivity_constraints:
- mutually_exclusive: [A, P]
- mutually_exclusive: [B, Q]
)";

TEST(Requests, OfEqualPriorityTheMoreRecentIsKept) {
  Stage stage(choice);
  stage.start("B");
  stage.start("A");
  EXPECT_EQ(stage.start("C"), "accepted");
  EXPECT_EQ(stage.running(), "A=a C=c2 Q=q") << "although p suits better than q";
}

TEST(Requests, AreAsRecentAsTheEventThatLastSetThem) {
  Stage stage(choice);
  stage.start("B");
  stage.start("A");
  stage.start("B");
  EXPECT_EQ(stage.start("C"), "accepted");
  EXPECT_EQ(stage.running(), "B=b C=c1 P=p");
}

TEST(Requests, OfHigherPriorityAreKeptBeforeMoreRecentOnes) {
  Stage stage(choice);
  stage.start("A", 2);
  stage.start("B", 1);
  EXPECT_EQ(stage.start("C", 2), "accepted");
  EXPECT_EQ(stage.running(), "A=a C=c2 Q=q");
}

// Faults ---------------------------------------------------------------------------------------

TEST(ActivationFailure, ExcludesTheBehaviorAndSolvesAgain) {
  Stage stage(rivals);
  stage.fault("a1");
  EXPECT_EQ(stage.start("A", 2), "accepted");
  EXPECT_EQ(stage.changes(), "+a1 requested 2 failed, +a2 requested 2");
  EXPECT_EQ(stage.running(), "A=a2");
  EXPECT_EQ(stage.active(), "a2");
  EXPECT_EQ(stage.objectives(), "1/1 idle 0/1 changes 1");
  EXPECT_EQ(stage.searches(), "optimal protection 2 sizes 1 1") << "the domain without a1";
}

TEST(ActivationFailure, TakesAllBackWhereThereIsNoSolutionLeft) {
  Stage stage(rivals);
  stage.start("A", 1);
  stage.fault("b1");
  stage.fault("b2");
  EXPECT_EQ(stage.start("B", 1), "rejected");
  EXPECT_EQ(stage.changes(),
            "-a1 displaced 1, +b1 requested 1 failed, +b2 requested 1 failed, +a1 undone");
  EXPECT_EQ(stage.stopped(), "");
  EXPECT_EQ(stage.running(), "A=a1");
  EXPECT_EQ(stage.requests(), "A:1");
  EXPECT_EQ(stage.active(), "a1");
  EXPECT_EQ(stage.searches(), "infeasible protection 1 sizes 3 0");
}

TEST(ActivationFailure, KeepsRequestsAndChangesOfTheStateBefore) {
  Stage stage(R"(
tasks: [{task: A}, {task: B}, {task: T, start_on_request: false}]
behaviors:
- {behavior: a, task: A}
- {behavior: b1, task: B, requires: [{task: T}]}
- {behavior: b2, task: B, suitability: 50}
- {behavior: t, task: T}
exclusivity_constraints:
- mutually_exclusive: [A, T]
)");
  // Both ways satisfy as many requests only if A goes on: so b2 is first.
  stage.start("A", 1);
  EXPECT_EQ(stage.start("B", 2), "accepted");
  EXPECT_EQ(stage.running(), "A=a B=b2");
  stage.stop("B");
  stage.fault("b2");
  EXPECT_EQ(stage.start("B", 2), "accepted");
  EXPECT_EQ(stage.changes(),
            "+b2 requested 2 failed, -a displaced 1, +t required, +b1 requested 2");
  EXPECT_EQ(stage.objectives(), "1/2 idle 1/1 changes 3");
  stage.stop("B");
  stage.start("A", 1);
  stage.repair("b2");
  stage.fault("t");
  stage.set({{"b2", false}});
  EXPECT_EQ(stage.start("B", 2), "rejected");
  EXPECT_EQ(stage.changes(), "-a displaced 1, +t required failed, +a undone");
}

TEST(ActivationFailure, OfARestartExcludesTheActiveBehavior) {
  Stage stage(rivals);
  stage.start("A", 1, "p");
  stage.fault("a1");
  EXPECT_EQ(stage.start("A", 2, "q"), "accepted");
  EXPECT_EQ(stage.changes(), "-a1 restarted 1, +a1 restarted 2 failed, +a2 requested 2");
  EXPECT_EQ(stage.running(), "A=a2");
  EXPECT_EQ(stage.requests(), "A:2");
}

TEST(ActivationFailure, OfATakingBackIsFollowedByAFinish) {
  Stage stage("behaviors: [{behavior: a, task: A}]");
  stage.start("A", 1, "p");
  stage.fault("a");
  EXPECT_EQ(stage.start("A", 1, "q"), "rejected; accepted");
  EXPECT_EQ(stage.events(), "start A 1 rejected; fault finish a process_failure accepted");
  EXPECT_EQ(stage.changes(), "-a restarted 1, +a restarted 1 failed, +a undone failed; ");
  EXPECT_EQ(stage.stopped(), "; A process_failure");
  EXPECT_EQ(stage.running(), "");
  EXPECT_EQ(stage.active(), "");
}

// N has to stop all of X, Y and Z; nothing goes on without it.
constexpr const char* fragile = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: Y}, {task: X}, {task: Z}, {task: N}]
behaviors:
- {behavior: z, task: Z}
- {behavior: y, task: Y, requires: [{task: X}]}
- {behavior: x, task: X}
- {behavior: n, task: N}
exclusivity_constraints:
- mutually_exclusive: [N, X]
- mutually_exclusive: [N, Y]
- mutually_exclusive: [N, Z]
)";

TEST(ActivationFailure, OfSeveralTakingsBackIsFollowedByFinishesInCatalogOrder) {
  Stage stage(fragile);
  stage.start("Z", 1);
  stage.start("X", 1);
  stage.fault("x");
  stage.fault("z");
  stage.fault("n");
  EXPECT_EQ(stage.start("N", 1), "rejected; accepted; accepted");
  EXPECT_EQ(stage.events(),
            "start N 1 rejected; fault finish z process_failure accepted; "
            "fault finish x process_failure accepted");
  EXPECT_EQ(stage.changes(),
            "-z displaced 1, -x displaced 1, +n requested 1 failed, +z undone failed, "
            "+x undone failed; ; ");
  EXPECT_EQ(stage.active(), "");
}

TEST(ActivationFailure, FinishesComeInCatalogOrderWhateverTheLevels) {
  Stage stage(fragile);
  stage.start("Y", 1);
  stage.fault("x");
  stage.fault("y");
  stage.fault("n");
  EXPECT_EQ(stage.start("N", 1), "rejected; accepted; unchanged");
  EXPECT_EQ(stage.events(),
            "start N 1 rejected; fault finish y process_failure accepted; "
            "fault finish x process_failure unchanged")
      << "x was taken back first, as y requires it";
  EXPECT_EQ(stage.stopped(), "; Y process_failure, X interrupted; ");
}

TEST(ActivationFailure, AFinishThatAnEarlierOneAnticipatedChangesNothing) {
  // In catalog order x would come last; here it comes first, and takes y down.
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: Y}, {task: X}, {task: N}]
behaviors:
- {behavior: x, task: X}
- {behavior: y, task: Y, requires: [{task: X}]}
- {behavior: n, task: N}
exclusivity_constraints:
- mutually_exclusive: [N, X]
- mutually_exclusive: [N, Y]
)");
  stage.start("Y", 1);
  stage.fault("x");
  stage.fault("y");
  stage.fault("n");
  EXPECT_EQ(stage.start("N", 1), "rejected; accepted; unchanged");
  EXPECT_EQ(stage.events(),
            "start N 1 rejected; fault finish x process_failure accepted; "
            "fault finish y process_failure unchanged");
  EXPECT_EQ(stage.changes(),
            "-y displaced 1, -x released, +n requested 1 failed, +x undone failed, "
            "+y undone failed; -y displaced 1; ")
      << "until its own finish it counts as active";
  EXPECT_EQ(stage.stopped(), "; Y interrupted, X process_failure; ");
  EXPECT_EQ(stage.active(), "");
}

TEST(ActivationFailure, OfATakingBackIsExcludedIfTheEventGoesOn) {
  // b1 stops C; b1 fails; b2 lets C go on with c1, which has become faulty: so c2.
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: B}, {task: C}, {task: T}]
behaviors:
- {behavior: b1, task: B, requires: [{task: T}]}
- {behavior: b2, task: B, suitability: 10}
- {behavior: c1, task: C, requires: [{task: U}]}
- {behavior: c2, task: C, suitability: 90}
- {behavior: t, task: T}
- {behavior: u, task: U}
exclusivity_constraints:
- mutually_exclusive: [T, U]
)");
  stage.start("C", 1);
  EXPECT_EQ(stage.running(), "C=c1 U=u");
  stage.fault("b1");
  stage.fault("c1");
  EXPECT_EQ(stage.start("B", 1), "accepted");
  EXPECT_EQ(stage.changes(),
            "-c1 replaced 1, -u released, +c2 requested 1, +t required, "
            "+b1 requested 1 failed, -c2 undone, -t undone, +b2 requested 1, +u undone, "
            "+c1 undone failed, -u released, +c2 requested 1");
  EXPECT_EQ(stage.running(), "B=b2 C=c2");
  EXPECT_EQ(stage.objectives(), "2/2 idle 2/4 changes 4");
}

TEST(ActivationFailure, OfAFinishedBehaviorAlwaysHasASolution) {
  Stage stage(rivals);
  stage.start("A", 5);
  stage.fault("a2");
  EXPECT_EQ(stage.finish("a1", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.changes(), "+a2 requested 5 failed");
  EXPECT_EQ(stage.stopped(), "A process_failure");
  EXPECT_EQ(stage.active(), "");
}

TEST(ActivationFailure, ExcludesNothingButWhatFailed) {
  Stage stage(rivals, {}, {{"a1", false}});
  stage.start("A", 1);
  stage.set({{"a1", true}});
  stage.fault("a1");
  EXPECT_EQ(stage.finish("a2", FinishCause::situation_change), "accepted");
  EXPECT_EQ(stage.changes(), "+a1 requested 1 failed, +a2 requested 1");
}

TEST(ActivationFailure, OfAFinishMayRaiseTheProtectionLevel) {
  // t fails, t2 turns out to be faulty, so that A has to stop after all.
  Stage stage(supported);
  stage.start("A", 3);
  stage.fault("t2");
  EXPECT_EQ(stage.finish("t1", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.changes(), "+t2 required failed, -a displaced 3");
  EXPECT_EQ(stage.searches(), "optimal protection 3 escalated sizes 2 1 1");
}

TEST(Repair, LetsTheBehaviorBeActivatedAgain) {
  Stage stage(rivals);
  stage.fault("a1");
  stage.repair("a1");
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.changes(), "+a1 requested 1");
}

// Timeouts -------------------------------------------------------------------------------------

constexpr const char* timed = R"(
tasks:
- {task: A, timeout: 10}
- {task: B, timeout: 10}
- {task: K, timeout: 10, execution_goal: keep_running}
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A, suitability: 90, timeout: 3}
- {behavior: b, task: B}
- {behavior: k, task: K}
)";

TEST(Timeout, FinishesTheBehaviorOfATaskThatIsToAchieveAGoal) {
  Stage stage(timed);
  stage.advance_to(1);
  stage.start("B");
  stage.start("K");
  EXPECT_EQ(stage.timeouts(), "B@11");
  EXPECT_EQ(stage.advance_to(11), "") << "what is due at that very instant comes later";
  EXPECT_EQ(stage.settle_at(11), "accepted");
  EXPECT_EQ(stage.events(), "11 timeout finish b time_out accepted");
  EXPECT_EQ(stage.stopped(), "B time_out");
  EXPECT_EQ(stage.running(), "K=k");
  EXPECT_EQ(stage.timeouts(), "");
}

TEST(Timeout, OfABehaviorOverridesThatOfTheTask) {
  Stage stage(timed);
  stage.start("A");
  EXPECT_EQ(stage.settle_at(10), "accepted");
  EXPECT_EQ(stage.running(), "A=a2");
  EXPECT_EQ(stage.timeouts(), "A@13");
  EXPECT_EQ(stage.settle_at(13), "accepted");
  EXPECT_EQ(stage.events(), "13 timeout finish a2 time_out accepted");
  EXPECT_EQ(stage.running(), "A=a1") << "an event that is over excludes nothing";
  EXPECT_EQ(stage.timeouts(), "A@23");
}

TEST(Timeout, BeginsAnewWithARestart) {
  Stage stage(timed);
  stage.start("A", 1, "p");
  stage.advance_to(4);
  stage.start("A", 2, "p");
  EXPECT_EQ(stage.timeouts(), "A@10") << "no restart";
  stage.start("A", 2, "q");
  EXPECT_EQ(stage.timeouts(), "A@14");
}

TEST(Timeout, BeginsAnewWithAnUndoneActivation) {
  Stage stage(R"(
tasks: [{task: A, timeout: 10}, {task: B}]
behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B}
exclusivity_constraints:
- mutually_exclusive: [A, B]
)");
  stage.start("A");
  stage.advance_to(4);
  stage.fault("b");
  EXPECT_EQ(stage.start("B"), "rejected");
  EXPECT_EQ(stage.timeouts(), "A@14");
}

TEST(Timeout, OfATaskThatTakesAnActiveBehaviorBeginsThen) {
  Stage stage(R"(
tasks: [{task: A, timeout: 10}, {task: B, timeout: 10}]
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
)");
  stage.start("A");
  stage.advance_to(4);
  stage.start("B");
  EXPECT_EQ(stage.timeouts(), "A@10 B@14");
  EXPECT_EQ(stage.settle_at(10), "accepted");
  EXPECT_EQ(stage.stopped(), "A time_out, B time_out") << "the behavior finishes, for both";
  EXPECT_EQ(stage.timeouts(), "");
}

TEST(Timeout, OfTheSameInstantComeInCatalogOrderOfTheTasks) {
  Stage stage(timed, {}, {{"a2", false}});
  stage.start("B");
  stage.start("A");
  EXPECT_EQ(stage.settle_at(10), "accepted; accepted");
  EXPECT_EQ(stage.events(),
            "10 timeout finish a1 time_out accepted; 10 timeout finish b time_out accepted");
}

TEST(Timeout, ComesAfterScriptedEventsOfTheSameInstant) {
  Stage stage(timed);
  stage.start("B");
  stage.advance_to(10);
  EXPECT_EQ(stage.stop("B"), "accepted");
  EXPECT_EQ(stage.settle_at(10), "");
}

TEST(Timeout, GoesWithTheTask) {
  Stage stage(timed);
  stage.start("B");
  stage.stop("B");
  EXPECT_EQ(stage.timeouts(), "");
  EXPECT_EQ(stage.settle_at(100), "");
}

// Reactive tasks -------------------------------------------------------------------------------

// H starts by itself when neither A nor B runs. R needs T.
constexpr const char* reactive = R"(
default_values: {tasks: {start_on_request: false}}
tasks:
- {task: A}
- {task: H, reactive_start: true}
- {task: G, reactive_start: true}
- {task: T}
behaviors:
- {behavior: a, task: A}
- {behavior: h, task: H}
- {behavior: g, task: G, requires: [{task: T}]}
- {behavior: t, task: T}
exclusivity_constraints:
- mutually_exclusive: [A, H]
)";

TEST(Queue, ReactiveTasksJoinItAtTheStart) {
  Stage stage(reactive);
  EXPECT_EQ(stage.queue(), "H@0.08 G@0.08");
  EXPECT_EQ(stage.advance_to(0.08), "");
  EXPECT_EQ(stage.settle_at(0.08), "accepted; accepted");
  EXPECT_EQ(stage.events(), "0.08 reactive start H 0 accepted; 0.08 reactive start G 0 accepted");
  EXPECT_EQ(stage.changes(), "+h reactive 0; +t required, +g reactive 0");
  EXPECT_EQ(stage.requests(), "H:0 G:0");
  EXPECT_EQ(stage.queue(), "");
}

TEST(Queue, HasADelayOfItsOwn) {
  CoordinatorOptions options;
  options.reactive_delay = 2 * second;
  EXPECT_EQ(Stage(reactive, options).queue(), "H@2 G@2");
}

TEST(Queue, IsLeftByWhatStartsAndByItsRivals) {
  Stage stage(reactive);
  stage.start("A");
  EXPECT_EQ(stage.queue(), "G@0.08");
  stage.start("G");
  EXPECT_EQ(stage.queue(), "");
}

TEST(Queue, IsJoinedWhenARivalStops) {
  Stage stage(reactive);
  stage.start("A");
  stage.start("G");
  stage.advance_to(2);
  stage.finish("a");
  EXPECT_EQ(stage.queue(), "H@2.08");
  stage.start("A");
  EXPECT_EQ(stage.queue(), "");
  stage.stop("A");
  EXPECT_EQ(stage.queue(), "H@2.08");
}

TEST(Queue, StopsCountBeforeStarts) {
  Stage stage(reactive);
  stage.settle_at(1);
  EXPECT_EQ(stage.running(), "H=h G=g T=t");
  EXPECT_EQ(stage.start("A"), "accepted");
  EXPECT_EQ(stage.stopped(), "H interrupted");
  EXPECT_EQ(stage.queue(), "") << "H joins as it is stopped, and leaves as A starts";
}

TEST(Queue, IsNotJoinedAfterItsOwnStopOrFinish) {
  Stage stage(reactive);
  stage.settle_at(1);
  stage.stop("H");
  EXPECT_EQ(stage.queue(), "");
  stage.finish("g", FinishCause::process_failure);
  EXPECT_EQ(stage.running(), "");
  EXPECT_EQ(stage.queue(), "");
}

TEST(Queue, IsJoinedByAReactiveTaskThatAnotherEventStopped) {
  Stage stage(reactive);
  stage.settle_at(1);
  EXPECT_EQ(stage.stop("T"), "accepted") << "a request of priority 0 is not protected";
  EXPECT_EQ(stage.stopped(), "G interrupted, T interrupted");
  EXPECT_EQ(stage.queue(), "G@1.08");
}

TEST(Queue, IsJoinedByAReactiveTaskThatTheFinishOfAnotherBehaviorStopped) {
  Stage stage(reactive);
  stage.settle_at(1);
  stage.finish("t", FinishCause::process_failure);
  EXPECT_EQ(stage.queue(), "G@1.08");
}

TEST(Queue, KeepsTheFirstDueTime) {
  Stage stage(reactive, {}, {{"h", false}});
  stage.advance_to(0.05);
  stage.set({{"h", true}});
  EXPECT_EQ(stage.queue(), "H@0.08 G@0.08");
}

TEST(Queue, IsLeftByTheStopOfATaskThatDoesNotRun) {
  Stage stage(reactive);
  EXPECT_EQ(stage.stop("H"), "unchanged");
  EXPECT_EQ(stage.queue(), "G@0.08");
}

TEST(Queue, IsJoinedByTheWholeGroupWhenABehaviorBecomesAvailable) {
  Stage stage(reactive, {}, {{"a", false}});
  stage.stop("H");
  stage.stop("G");
  stage.advance_to(3);
  stage.set({{"t", true}});
  EXPECT_EQ(stage.queue(), "") << "it was available";
  stage.set({{"a", false}});
  EXPECT_EQ(stage.queue(), "");
  stage.set({{"a", true}});
  EXPECT_EQ(stage.queue(), "H@3.08") << "G is of another group";
}

TEST(Queue, IsJoinedWhenAFaultyBehaviorIsRepaired) {
  Stage stage(reactive);
  stage.stop("H");
  stage.stop("G");
  stage.repair("a");
  EXPECT_EQ(stage.queue(), "") << "it was not faulty";
  stage.fault("t");
  EXPECT_EQ(stage.queue(), "");
  stage.repair("t");
  EXPECT_EQ(stage.queue(), "G@0.08");
}

TEST(ReactiveStart, IsDroppedWithoutAnEventWhereARivalRuns) {
  Stage stage(reactive, {}, {{"h", false}});
  stage.start("A");
  stage.stop("G");
  stage.set({{"h", true}});
  EXPECT_EQ(stage.queue(), "H@0.08");
  EXPECT_EQ(stage.settle_at(1), "");
  EXPECT_EQ(stage.queue(), "");
}

TEST(ReactiveStart, IsDroppedWithoutAnEventWhereNoBehaviorIsAvailable) {
  Stage stage(reactive, {}, {{"h", false}, {"g", false}});
  EXPECT_EQ(stage.settle_at(1), "");
  EXPECT_EQ(stage.queue(), "");
}

TEST(ReactiveStart, NeverStopsARequestedOrReactiveTask) {
  // G and H can run one at a time only, but share no exclusivity list.
  const std::string yaml = R"(
default_values: {tasks: {start_on_request: false}}
tasks:
- {task: G, reactive_start: true}
- {task: H, reactive_start: true}
behaviors:
- {behavior: g, task: G, requires: [{task: T}]}
- {behavior: h, task: H, requires: [{task: U}]}
- {behavior: t, task: T}
- {behavior: u, task: U}
exclusivity_constraints:
- mutually_exclusive: [T, U]
)";
  Stage stage(yaml);
  EXPECT_EQ(stage.settle_at(1), "accepted; rejected");
  EXPECT_EQ(stage.events(), "0.08 reactive start G 0 accepted; 0.08 reactive start H 0 rejected");
  EXPECT_EQ(stage.searches(),
            "optimal protection 0 sizes 1 2 2 2; infeasible protection 0 sizes 1 1 2 2");
  EXPECT_EQ(stage.queue(), "") << "it has left the queue";
}

TEST(ReactiveStart, MayMoveTasksWithoutRequest) {
  Stage stage(R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A}, {task: H, reactive_start: true}, {task: S}]
behaviors:
- {behavior: a1, task: A, requires: [{task: S}]}
- {behavior: a2, task: A, suitability: 90}
- {behavior: h, task: H}
- {behavior: s, task: S}
- {behavior: u, task: U}
exclusivity_constraints:
- mutually_exclusive: [S, U]
)");
  stage.start("A", 5);
  EXPECT_EQ(stage.settle_at(1), "accepted");
  EXPECT_EQ(stage.running(), "A=a1 H=h S=s");
}

TEST(ReactiveStart, ComesAfterTimeoutsOfTheSameInstant) {
  Stage stage(R"(
tasks:
- {task: H, reactive_start: true}
- {task: Z, timeout: 0.08}
behaviors:
- {behavior: h, task: H}
- {behavior: z, task: Z}
)");
  stage.start("Z");
  EXPECT_EQ(stage.settle_at(0.08), "accepted; accepted");
  EXPECT_EQ(stage.events(),
            "0.08 timeout finish z time_out accepted; 0.08 reactive start H 0 accepted");
}

TEST(ReactiveStart, IsDueInOrderOfTime) {
  Stage stage(R"(
tasks:
- {task: H, reactive_start: true}
- {task: Z, timeout: 0.09}
behaviors:
- {behavior: h, task: H}
- {behavior: z, task: Z}
)");
  stage.start("Z");
  EXPECT_EQ(stage.settle_at(1), "accepted; accepted");
  EXPECT_EQ(stage.events(),
            "0.08 reactive start H 0 accepted; 0.09 timeout finish z time_out accepted");
}

TEST(ReactiveStart, OfARequestIsRaisedByAScriptedStart) {
  Stage stage(reactive);
  stage.settle_at(1);
  EXPECT_EQ(stage.start("H", 3), "accepted");
  EXPECT_EQ(stage.requests(), "H:3 G:0");
  EXPECT_EQ(stage.start("A", 2), "rejected");
}

// Limits ---------------------------------------------------------------------------------------

constexpr const char* restless = R"(
tasks:
- {task: H, reactive_start: true, timeout: 1, execution_goal: achieve_goal}
- {task: G, reactive_start: true, timeout: 1, execution_goal: achieve_goal}
behaviors:
- {behavior: h, task: H}
- {behavior: g, task: G}
exclusivity_constraints:
- mutually_exclusive: [G, H]
)";

TEST(ClockEvents, EndTheRunBeyondTheirLimit) {
  CoordinatorOptions options;
  options.max_clock_events = 4;
  // H, its timeout, G, its timeout, and so on.
  Stage stage(restless, options);
  stage.settle_at(2.16);
  EXPECT_EQ(stage.status(), Coordinator::Status::ok);
  EXPECT_EQ(stage.outcomes(), "accepted; accepted; accepted; accepted");
  stage.advance_to(100);
  EXPECT_EQ(stage.status(), Coordinator::Status::too_many_clock_events);
  EXPECT_EQ(stage.outcomes(), "") << "the event that is one too many is not reported";
}

class Witness final : public EventListener {
 public:
  void on_event(const EventRecord& record) override { times.push_back(record.time); }
  std::vector<Microseconds> times;
};

TEST(ClockEvents, GoOnAfterTheirLimitIfMoreAreAllowed) {
  CoordinatorOptions options;
  options.max_clock_events = 3;
  const CompiledCatalog catalog = test::compile_text(restless);
  Witness witness;
  Coordinator coordinator(catalog, options, witness);
  coordinator.begin({});
  // H from 0.08 to 1.08, G from 1.16 to 2.16, H from 2.24 to 3.24.
  EXPECT_EQ(coordinator.advance_to(3 * second), Coordinator::Status::too_many_clock_events);
  EXPECT_EQ(coordinator.advance_to(3 * second), Coordinator::Status::too_many_clock_events);
  EXPECT_EQ(coordinator.now(), 1'160'000);
  EXPECT_EQ(coordinator.next_due(), 2'160'000);
  coordinator.restart_count();
  EXPECT_EQ(coordinator.advance_to(3 * second), Coordinator::Status::ok);
  coordinator.restart_count();
  EXPECT_EQ(coordinator.advance_to(4 * second), Coordinator::Status::ok);
  EXPECT_EQ(witness.times, (std::vector<Microseconds>{80'000, 1'080'000, 1'160'000, 2'160'000,
                                                      2'240'000, 3'240'000, 3'320'000}));
}

TEST(ClockEvents, DoNotCountWhatCouldNotBeTakenBack) {
  CoordinatorOptions options;
  options.max_clock_events = 1;
  Stage stage(fragile, options);
  // The tasks are Y, X, Z, N, the behaviors z, y, x, n.
  stage.start("Z");
  stage.start("X");
  for (const char* behavior : {"z", "x", "n"}) stage.fault(behavior);
  stage.start("N");
  EXPECT_EQ(stage.status(), Coordinator::Status::ok) << "two behaviors finish after the start";
}

TEST(ClockEvents, DoNotCountWhatTheScriptDoes) {
  CoordinatorOptions options;
  options.max_clock_events = 1;
  Stage stage(rivals, options);
  for (int i = 0; i < 5; ++i) {
    stage.start("A");
    EXPECT_EQ(stage.status(), Coordinator::Status::ok);
  }
}

/// M goes on with m1 alone: m2 needs four tasks, which have three places. That takes more than one
/// decision to find out. K is in the same group.
std::string four_in_three_places() {
  std::string text = R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: b, task: B, requires: [{task: M}]}
- {behavior: k, task: K}
- {behavior: m1, task: M}
- {behavior: m2, tasks: [{task: M, suitability: 50}, {task: N}],
   requires: [{task: T0}, {task: T1}, {task: T2}, {task: T3}]}
)";
  std::string lists = "- mutually_exclusive: [K, N]\n";
  for (const std::string place : {"0", "1", "2"}) {
    for (const std::string task : {"T0", "T1", "T2", "T3"}) {
      text += "- {behavior: " + task + "at" + place + ", task: " + task +
              ", requires: [{task: " + task + place + "}]}\n- {behavior: of" + task + place +
              ", task: " + task + place + "}\n";
    }
    lists += "- mutually_exclusive: [T0" + place + ", T1" + place + ", T2" + place + ", T3" +
             place + "]\n";
  }
  return text + "exclusivity_constraints:\n" + lists;
}

TEST(SearchLimits, ThatLeaveNoSolutionRejectAStart) {
  CoordinatorOptions options;
  options.search.max_nodes = 1;
  Stage stage(four_in_three_places(), options);
  EXPECT_EQ(stage.start("N"), "rejected");
  EXPECT_EQ(stage.searches().substr(0, 7), "unknown");
  EXPECT_EQ(stage.running(), "");
}

TEST(SearchLimits, ThatLeaveAFinishWithoutSolutionStopWhatNeedsTheBehavior) {
  CoordinatorOptions options;
  options.search.max_nodes = 1;
  Stage stage(four_in_three_places(), options);
  EXPECT_EQ(stage.start("B"), "accepted");
  EXPECT_EQ(stage.start("K"), "accepted");
  EXPECT_EQ(stage.running(), "B=b K=k M=m1");
  EXPECT_EQ(stage.finish("m1", FinishCause::wrong_progress), "accepted");
  EXPECT_EQ(stage.searches().substr(0, 8), "feasible");
  EXPECT_EQ(stage.running(), "K=k");
  EXPECT_EQ(stage.active(), "k");
}

/// A request of a higher priority than the finished one is protected at first, but stops as well if
/// it needs the behavior.
TEST(SearchLimits, ThatLeaveAFinishWithoutSolutionEscalateIt) {
  CoordinatorOptions options;
  options.search.max_nodes = 1;
  Stage stage(four_in_three_places(), options);
  EXPECT_EQ(stage.start("B", 3), "accepted");
  EXPECT_EQ(stage.start("K", 2), "accepted");
  EXPECT_EQ(stage.start("M", 1), "accepted");
  EXPECT_EQ(stage.running(), "B=b K=k M=m1");
  EXPECT_EQ(stage.finish("m1", FinishCause::wrong_progress), "accepted");
  EXPECT_EQ(stage.searches().substr(0, 31), "feasible protection 3 escalated");
  EXPECT_EQ(stage.running(), "K=k");
  EXPECT_EQ(stage.stopped(), "B interrupted, M wrong_progress");
}

TEST(SearchLimits, OfTimeEndTheSearchForReasons) {
  struct Reasons final : EventListener {
    void on_event(const EventRecord& record) override {
      status = record.search->result.status;
      count = record.conflict.size();
    }
    SearchStatus status = SearchStatus::unknown;
    std::size_t count = 0;
  };
  const CompiledCatalog catalog = test::compile_text(rivals);
  for (const auto limit : {std::chrono::microseconds(0), std::chrono::microseconds(1)}) {
    CoordinatorOptions options;
    options.search.time_limit = limit;
    Reasons reasons;
    Coordinator coordinator(catalog, options, reasons);
    coordinator.begin({});
    Event start;
    start.verb = Verb::start;
    start.priority = 2;
    EXPECT_EQ(coordinator.handle(start), Coordinator::Status::ok);
    start.subject = 1;
    start.priority = 1;
    EXPECT_EQ(coordinator.handle(start), Coordinator::Status::ok);
    EXPECT_EQ(reasons.status, SearchStatus::infeasible) << "by propagation at the root";
    EXPECT_EQ(reasons.count == 0, limit.count() > 0);
  }
}

TEST(SearchLimits, ThatComeBeforeTheFirstSolutionLeaveARepair) {
  CoordinatorOptions options;
  options.search.max_nodes = 1;
  Stage stage(supported, options);
  EXPECT_EQ(stage.start("B", 1), "accepted");
  EXPECT_EQ(stage.searches().substr(0, 8), "feasible");
}

TEST(SearchLimits, ThePapersOrderTakesTheFirstSolution) {
  CoordinatorOptions options;
  options.search.max_solutions = 1;
  Stage stage(choice, options);
  stage.start("B");
  stage.start("A");
  // A: a (kept), B: b (kept), C: c1 needs P, which A excludes; c2 needs Q: so B stops, c1 fails …
  EXPECT_EQ(stage.start("C"), "accepted");
  EXPECT_EQ(stage.searches().substr(0, 8), "feasible");
  EXPECT_EQ(stage.running(), "A=a C=c2 Q=q");
}

TEST(TieSeed, OrdersBehaviorsOfEqualSuitability) {
  int first = 0;
  int second = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CoordinatorOptions options;
    options.tie_seed = seed;
    Stage stage("behaviors: [{behavior: a1, task: A}, {behavior: a2, task: A}]", options);
    stage.start("A");
    ++(stage.running() == "A=a1" ? first : second);
  }
  EXPECT_GT(first, 2);
  EXPECT_GT(second, 2);
}

}  // namespace
}  // namespace cbc::coordinator_test
