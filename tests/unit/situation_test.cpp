#include <gtest/gtest.h>

#include "stage.h"

// Situation variables, finishes by task, and reactive tasks that wait.

namespace cbc::situation_test {
namespace {

using test::Stage;

constexpr const char* localizers = R"(
tasks: [{task: LOCALIZE, start_on_request: false, execution_goal: keep_running}, {task: GO}]
behaviors:
- {behavior: amcl, task: LOCALIZE, situation: {LIGHT: [day, dusk]}}
- {behavior: gps, task: LOCALIZE, suitability: 90, situation: {GPS: true, LIGHT: [day, night]}}
- {behavior: lidar, task: LOCALIZE, suitability: 50}
- {behavior: go, task: GO, requires: [{task: LOCALIZE}]}
situation:
- {variable: LIGHT, values: [day, dusk, night]}
- {variable: GPS}
)";

TEST(SituationVariables, AnActiveBehaviorThatDoesNotFitFinishesAtOnce) {
  Stage stage(localizers);
  stage.start("GO");
  EXPECT_EQ(stage.running(), "LOCALIZE=amcl GO=go");
  EXPECT_EQ(stage.set_variables({{"LIGHT", "dusk"}}), "unchanged") << "it fits in both";
  stage.set_variables({{"LIGHT", "night"}});
  EXPECT_EQ(stage.events(), "situation unchanged; situation finish amcl situation_change accepted");
  EXPECT_EQ(stage.running(), "LOCALIZE=gps GO=go");
  EXPECT_EQ(stage.set_variables({{"GPS", "false"}, {"LIGHT", "day"}}), "unchanged; accepted");
  EXPECT_EQ(stage.running(), "LOCALIZE=amcl GO=go");
}

TEST(SituationVariables, ABehaviorThatFitsAgainIsNotChosenBeforeAnEvent) {
  Stage stage(localizers);
  stage.set_variables({{"LIGHT", "night"}, {"GPS", "false"}});
  stage.start("GO");
  EXPECT_EQ(stage.running(), "LOCALIZE=lidar GO=go");
  stage.set_variables({{"LIGHT", "day"}});
  EXPECT_EQ(stage.running(), "LOCALIZE=lidar GO=go");
  stage.start("GO");
  EXPECT_EQ(stage.running(), "LOCALIZE=amcl GO=go");
}

TEST(SituationVariables, WhatAScriptDeniesStaysDenied) {
  Stage stage(localizers, {}, {{"amcl", false}});
  stage.start("GO");
  EXPECT_EQ(stage.running(), "LOCALIZE=gps GO=go");
  EXPECT_EQ(stage.set_variables({{"GPS", "false"}}, {{"gps", false}}), "unchanged; accepted");
  EXPECT_EQ(stage.running(), "LOCALIZE=lidar GO=go");
  stage.set_variables({{"GPS", "true"}});
  stage.start("GO");
  EXPECT_EQ(stage.running(), "LOCALIZE=lidar GO=go") << "it fits, but is denied";
}

TEST(SituationVariables, FinishesComeInCatalogOrderAndOneMayAnticipateAnother) {
  Stage stage(R"(
tasks: [{task: A}, {task: B, start_on_request: false}]
behaviors:
- {behavior: a, task: A, requires: [{task: B}], situation: {DRY: true}}
- {behavior: b, task: B, situation: {DRY: true}}
- {behavior: c, task: A, suitability: 10}
situation: [{variable: DRY}]
)");
  stage.start("A");
  EXPECT_EQ(stage.active(), "a b");
  stage.set_variables({{"DRY", "false"}});
  EXPECT_EQ(stage.events(), "situation unchanged; situation finish a situation_change accepted");
  EXPECT_EQ(stage.changes(), "; -b released, +c requested 1") << "b was stopped with a";
}

TEST(SituationVariables, LetReactiveTasksTryWhatBecameAvailable) {
  Stage stage(R"(
tasks: [{task: HOVER, reactive_start: true}]
behaviors: [{behavior: hover, task: HOVER, situation: {AIRBORNE: true}}]
situation: [{variable: AIRBORNE, values: [false, true]}]
)");
  EXPECT_EQ(stage.settle_at(1), "") << "no behavior is available: dropped";
  stage.set_variables({{"AIRBORNE", "true"}});
  EXPECT_EQ(stage.queue(), "HOVER@1.08");
  stage.settle_at(2);
  EXPECT_EQ(stage.running(), "HOVER=hover");
  stage.set_variables({{"AIRBORNE", "false"}});
  EXPECT_EQ(stage.running(), "");
  EXPECT_EQ(stage.queue(), "HOVER@2.08") << "stopped by the situation, not by its own end";
  EXPECT_EQ(stage.settle_at(3), "");
}

TEST(FinishByTask, FinishesWhatPerformsTheTask) {
  Stage stage(localizers);
  EXPECT_EQ(stage.finish_task("GO"), "unchanged");
  stage.start("GO");
  EXPECT_EQ(stage.finish_task("LOCALIZE", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.events(), "finish task LOCALIZE amcl process_failure accepted");
  EXPECT_EQ(stage.running(), "LOCALIZE=gps GO=go");
}

/// HOVER needs one controller, and taking off another one, which excludes it.
constexpr const char* take_off = R"(
tasks:
- {task: HOVER, reactive_start: true}
- {task: PID, start_on_request: false}
- {task: DF, start_on_request: false}
- {task: TAKE_OFF}
- {task: LAND}
behaviors:
- {behavior: hover, task: HOVER, requires: [{task: PID}]}
- {behavior: pid, task: PID}
- {behavior: df, task: DF}
- {behavior: take_off, task: TAKE_OFF, requires: [{task: DF}]}
- {behavior: land, task: LAND}
exclusivity_constraints:
- mutually_exclusive: [PID, DF]
- mutually_exclusive: [LAND, HOVER]
- mutually_exclusive: [LAND, TAKE_OFF]
)";

TEST(WaitingTasks, TryAgainWhenTheirGroupChanges) {
  Stage stage(take_off);
  stage.start("TAKE_OFF");
  EXPECT_EQ(stage.settle_at(1), "rejected");
  EXPECT_EQ(stage.events(), "0.08 reactive start HOVER 0 rejected");
  EXPECT_EQ(stage.queue(), "");
  EXPECT_EQ(stage.waiting(), "HOVER");
  stage.settle_at(5);
  stage.finish("take_off");
  EXPECT_EQ(stage.queue(), "HOVER@5.08");
  EXPECT_EQ(stage.waiting(), "HOVER");
  stage.settle_at(6);
  EXPECT_EQ(stage.events(), "5.08 reactive start HOVER 0 accepted");
  EXPECT_EQ(stage.waiting(), "");
  EXPECT_EQ(stage.state().waiting_count(), 0U);
}

TEST(WaitingTasks, AnotherAttemptThatFailsIsNoEvent) {
  Stage stage(take_off);
  stage.start("TAKE_OFF");
  stage.settle_at(1);
  stage.start("TAKE_OFF", 2);
  EXPECT_EQ(stage.queue(), "HOVER@1.08");
  EXPECT_EQ(stage.settle_at(2), "");
  EXPECT_EQ(stage.waiting(), "HOVER");
  EXPECT_EQ(stage.stop("HOVER"), "unchanged");
  EXPECT_EQ(stage.waiting(), "");
  stage.finish("take_off");
  EXPECT_EQ(stage.queue(), "") << "it was stopped";
}

TEST(WaitingTasks, WaitNoLongerWhenARivalRuns) {
  Stage stage(take_off);
  stage.start("TAKE_OFF");
  stage.settle_at(1);
  stage.start("LAND");
  EXPECT_EQ(stage.running(), "LAND=land");
  EXPECT_EQ(stage.waiting(), "");
  stage.finish("land");
  EXPECT_EQ(stage.queue(), "HOVER@1.08") << "as a rival stopped";
}

TEST(WaitingTasks, AreEventsIfAnActivationFailed) {
  Stage stage(take_off);
  stage.start("TAKE_OFF");
  stage.settle_at(1);
  stage.fault("hover");
  stage.stop("TAKE_OFF");
  EXPECT_EQ(stage.settle_at(2), "rejected");
  EXPECT_EQ(stage.changes(), "+pid required, +hover reactive 0 failed, -pid undone");
}

}  // namespace
}  // namespace cbc::situation_test
