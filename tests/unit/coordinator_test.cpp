#include "runtime/coordinator/coordinator.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/script/runner.h"
#include "unit/compiled_fixture.h"
#include "unit/stage.h"

// What the random missions of tests/property do not reach, where an oracle has the rules of events:
// many behaviors of a task, limits, and what no report tells.

namespace cbc::coordinator_test {
namespace {

using test::Stage;

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
}

TEST(Finish, RaisesTheProtectionLevelWhenAnActivationFails) {
  // t fails, t2 turns out to be faulty, so that A has to stop after all.
  Stage stage(supported);
  stage.start("A", 3);
  stage.fault("t2");
  EXPECT_EQ(stage.finish("t1", FinishCause::process_failure), "accepted");
  EXPECT_EQ(stage.changes(), "+t2 required failed, -a displaced 3");
  EXPECT_EQ(stage.searches(), "optimal protection 3 escalated sizes 2 1 1");
}

/// HOVER needs one controller, and taking off another one, which excludes it.
constexpr const char* take_off = R"(
tasks:
- {task: HOVER, reactive_start: true}
- {task: PID, start_on_request: false}
- {task: DF, start_on_request: false}
- {task: TAKE_OFF}
behaviors:
- {behavior: hover, task: HOVER, requires: [{task: PID}]}
- {behavior: pid, task: PID}
- {behavior: df, task: DF}
- {behavior: take_off, task: TAKE_OFF, requires: [{task: DF}]}
exclusivity_constraints:
- mutually_exclusive: [PID, DF]
)";

TEST(WaitingTasks, AreCountedAsLongAsTheyWait) {
  Stage stage(take_off);
  stage.start("TAKE_OFF");
  EXPECT_EQ(stage.settle_at(1), "rejected");
  EXPECT_EQ(stage.state().waiting_count(), 1U);
  stage.finish("take_off");
  EXPECT_EQ(stage.settle_at(2), "accepted");
  EXPECT_EQ(stage.running(), "HOVER=hover PID=pid");
  EXPECT_EQ(stage.state().waiting_count(), 0U);
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
  struct Reasons final : RunListener {
    void on_event(const ExplainedRecord& record, const Step*, const State&) override {
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
    Runner runner(catalog, options, reasons, {.rejections = true});
    runner.begin({});
    Step start;
    start.verb = Verb::start;
    start.priority = 2;
    EXPECT_TRUE(runner.take(start));
    start.subject = 1;
    start.priority = 1;
    EXPECT_TRUE(runner.take(start));
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

}  // namespace
}  // namespace cbc::coordinator_test
