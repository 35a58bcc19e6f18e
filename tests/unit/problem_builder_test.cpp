#include "coordinator/problem_builder.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

using test::behavior_id;
using test::compile_text;
using test::task_id;

constexpr const char* text = R"(
tasks:
- {task: A}
- {task: B}
- {task: C, start_on_request: false}
- {task: Z}
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A, suitability: 90}
- {behavior: b1, task: B}
- {behavior: b2, task: B, suitability: 90}
- {behavior: c, task: C}
- {behavior: x, tasks: [{task: A, suitability: 50}, {task: C, suitability: 50}]}
- {behavior: z, task: Z}
exclusivity_constraints:
- mutually_exclusive: [B, C]
)";

class ProblemBuilderTest : public testing::Test {
 protected:
  void run(std::string_view task, std::string_view behavior,
           std::optional<std::int32_t> priority = {}, std::uint64_t event = 1) {
    const TaskId id = task_id(catalog, task);
    state.set_value(id, test::value_index(catalog, task, behavior), 0);
    state.set_active(behavior_id(catalog, behavior), 0);
    if (priority) state.set_request(id, *priority, event, "");
  }
  [[nodiscard]] Trigger start(std::string_view task, std::int32_t priority) const {
    Trigger trigger;
    trigger.kind = Trigger::Kind::start;
    trigger.task = task_id(catalog, task);
    trigger.group = catalog.tasks[trigger.task].group;
    trigger.priority = priority;
    return trigger;
  }
  [[nodiscard]] Trigger stop(std::string_view task, std::int32_t priority) const {
    Trigger trigger = start(task, priority);
    trigger.kind = Trigger::Kind::stop;
    return trigger;
  }
  [[nodiscard]] Trigger finish(std::string_view behavior, FinishCause cause) const {
    Trigger trigger;
    trigger.kind = Trigger::Kind::finish;
    trigger.behavior = behavior_id(catalog, behavior);
    trigger.cause = cause;
    return trigger;
  }
  /// The domains at a protection level, "A?:a1,a2 B:b1" ("?": it may stop).
  std::string domains(const Trigger& trigger, std::int32_t protection) {
    builder.load(trigger, 9);
    return ask(protection);
  }
  std::string ask(std::int32_t protection) {
    const Problem& problem = builder.build(protection);
    std::string result;
    for (std::uint32_t task = 0; task < problem.may_stop.size(); ++task) {
      const TaskId id = catalog.group_tasks[problem.group] + task;
      result += (task == 0 ? "" : " ") + std::string(catalog.name_of_task(id)) +
                (problem.may_stop[task] != 0 ? "?:" : ":");
      for (std::uint32_t index = 0; index < catalog.values[id].size(); ++index) {
        const std::uint32_t word =
            catalog.words[id] - catalog.words[catalog.group_tasks[problem.group]];
        if (((problem.domains[word] >> index) & 1) == 0) continue;
        if (result.back() != ':') result += ",";
        result += std::string(catalog.name_of_behavior(catalog.values[id][index].behavior));
      }
    }
    return result;
  }
  std::string requests(const Trigger& trigger) {
    builder.load(trigger, 9);
    std::string result;
    for (const std::uint32_t task : builder.build(0).requests) {
      result += std::string(catalog.name_of_task(task));
    }
    return result;
  }
  std::string active() {
    std::string result;
    for (const BehaviorId behavior : builder.active_before()) {
      result += " " + std::string(catalog.name_of_behavior(behavior));
    }
    return result;
  }

  CompiledCatalog catalog = compile_text(text);
  State state{catalog};
  ProblemBuilder builder{catalog, state};
};

TEST_F(ProblemBuilderTest, TheStartedTaskHasToRunWithAnAvailableBehavior) {
  EXPECT_EQ(domains(start("A", 1), 1), "A:a1,a2,x B?: C?:c,x");
  state.set_available(behavior_id(catalog, "a1"), false);
  EXPECT_EQ(domains(start("A", 1), 1), "A:a2,x B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, OnlyTheGroupOfTheTaskIsAffected) {
  run("A", "a1", 5);
  EXPECT_EQ(domains(start("Z", 1), 1), "Z:z");
}

TEST_F(ProblemBuilderTest, KeepingABehaviorThatIsNotAvailableIsNoActivation) {
  run("A", "a1", 1);
  state.set_available(behavior_id(catalog, "a1"), false);
  EXPECT_EQ(domains(start("A", 1), 1), "A:a1,a2,x B?: C?:c,x");
  EXPECT_EQ(domains(start("B", 1), 1), "A?:a1,a2,x B:b1,b2 C?:c,x");
}

TEST_F(ProblemBuilderTest, AnActiveBehaviorThatIsNotAvailableStaysWithItsTaskOnly) {
  run("A", "x", 1);
  state.set_available(behavior_id(catalog, "x"), false);
  EXPECT_EQ(domains(start("B", 1), 1), "A?:a1,a2,x B:b1,b2 C?:c");
}

TEST_F(ProblemBuilderTest, AStoppedTaskHasOnlyNotRunning) {
  run("A", "a1", 1);
  EXPECT_EQ(domains(stop("A", 1), 1), "A?: B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, WhatStartsOnRequestDoesNotStartOtherwise) {
  EXPECT_EQ(domains(start("Z", 1), 1), "Z:z");
  EXPECT_EQ(domains(start("C", 1), 1), "A?: B?: C:c,x");
}

TEST_F(ProblemBuilderTest, AProtectedTaskMayNotStop) {
  run("A", "a1", 3);
  EXPECT_EQ(domains(start("B", 2), 2), "A:a1,a2,x B:b1,b2 C?:c,x");
  EXPECT_EQ(domains(start("B", 3), 3), "A?:a1,a2,x B:b1,b2 C?:c,x") << "an equal priority is none";
}

TEST_F(ProblemBuilderTest, ARunningTaskWithoutRequestIsNotProtected) {
  run("C", "c");
  EXPECT_EQ(domains(start("B", 1), 1), "A?: B:b1,b2 C?:c,x");
}

TEST_F(ProblemBuilderTest, AReactiveStartFindsEveryRequestProtected) {
  run("A", "a1", 0);
  run("B", "b1", 2);
  Trigger trigger = start("C", 0);
  trigger.is_reactive = true;
  EXPECT_EQ(domains(trigger, 0), "A:a1,a2,x B:b1,b2 C:c,x");
}

TEST_F(ProblemBuilderTest, SuccessStopsTheTasksOfTheBehavior) {
  run("A", "x", 2);
  run("C", "x");
  EXPECT_EQ(domains(finish("x", FinishCause::goal_achieved), 2), "A?: B?: C?:");
  EXPECT_EQ(builder.first_protection(), 2);
}

TEST_F(ProblemBuilderTest, SuccessLeavesTheBehaviorToOtherTasks) {
  run("A", "x", 2);
  EXPECT_EQ(domains(finish("x", FinishCause::goal_achieved), 2), "A?: B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, FailureExcludesTheBehaviorFromAllTasks) {
  run("A", "x", 2);
  for (const FinishCause cause : {FinishCause::time_out, FinishCause::wrong_progress,
                                  FinishCause::process_failure, FinishCause::interrupted}) {
    EXPECT_EQ(domains(finish("x", cause), 2), "A?:a1,a2 B?: C?:c");
  }
}

TEST_F(ProblemBuilderTest, ATaskWhoseBehaviorFinishedMayStopWhateverTheLevel) {
  run("A", "a1", 5);
  EXPECT_EQ(domains(finish("a1", FinishCause::time_out), 0), "A?:a2,x B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, AfterASituationChangeTheBehaviorCountsIfAvailable) {
  run("A", "a1", 1);
  EXPECT_EQ(domains(finish("a1", FinishCause::situation_change), 1), "A?:a1,a2,x B?: C?:c,x");
  state.set_available(behavior_id(catalog, "a1"), false);
  EXPECT_EQ(domains(finish("a1", FinishCause::situation_change), 1), "A?:a2,x B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, ExcludedBehaviorsAreInNoDomainUntilTheNextEvent) {
  run("A", "x", 1);
  builder.load(start("A", 1), 9);
  builder.exclude(behavior_id(catalog, "x"));
  EXPECT_EQ(ask(1), "A:a1,a2 B?: C?:c") << "even if it was active before";
  EXPECT_EQ(domains(start("A", 1), 1), "A:a1,a2,x B?: C?:c,x");
}

TEST_F(ProblemBuilderTest, TheFirstProtectionLevelIsThatOfTheEvent) {
  builder.load(start("A", 4), 9);
  EXPECT_EQ(builder.first_protection(), 4);
  run("A", "a1", 3);
  builder.load(stop("A", 7), 9);
  EXPECT_EQ(builder.first_protection(), 7);
}

TEST_F(ProblemBuilderTest, AFinishBeginsAtTheHighestRequestOfItsTasks) {
  run("A", "x", 2);
  run("C", "x", 6);
  run("B", "b1", 9);
  builder.load(finish("x", FinishCause::time_out), 9);
  EXPECT_EQ(builder.first_protection(), 6);
  EXPECT_EQ(builder.next_protection(6), 9);
  EXPECT_EQ(builder.next_protection(9), std::nullopt);
}

TEST_F(ProblemBuilderTest, WithoutRequestsAFinishBeginsAtZero) {
  run("C", "c");
  run("A", "a1", 3);
  run("B", "b1", 2);
  builder.load(finish("c", FinishCause::goal_achieved), 9);
  EXPECT_EQ(builder.first_protection(), 0);
  EXPECT_EQ(builder.next_protection(0), 2) << "level 1 protects what 0 does";
  EXPECT_EQ(builder.next_protection(2), 3);
  EXPECT_EQ(builder.next_protection(3), std::nullopt);
}

TEST_F(ProblemBuilderTest, RequestsAreRankedByPriorityThenByRecency) {
  run("A", "a1", 1, 5);
  run("B", "b1", 2, 4);
  run("C", "c", 1, 6);
  EXPECT_EQ(requests(start("A", 1)), "BAC") << "the new one is the most recent";
  EXPECT_EQ(requests(start("C", 3)), "CBA");
  EXPECT_EQ(requests(start("B", 2)), "BCA");
}

TEST_F(ProblemBuilderTest, TheStoppedOrDoneRequestIsNoActiveOne) {
  run("A", "x", 1, 5);
  run("B", "b1", 2, 4);
  EXPECT_EQ(requests(stop("A", 1)), "B");
  EXPECT_EQ(requests(finish("x", FinishCause::goal_achieved)), "B");
  EXPECT_EQ(requests(finish("x", FinishCause::time_out)), "BA");
  EXPECT_EQ(requests(finish("x", FinishCause::situation_change)), "BA");
}

TEST_F(ProblemBuilderTest, ActiveBehaviorsCountOnceWithoutTheOneThatFinished) {
  run("A", "x", 1);
  run("C", "x");
  run("B", "b2", 1);
  builder.load(start("B", 1), 9);
  EXPECT_EQ(active(), " b2 x");
  builder.load(finish("x", FinishCause::time_out), 9);
  EXPECT_EQ(active(), " b2");
  EXPECT_TRUE(builder.has_finished(task_id(catalog, "A")));
  EXPECT_TRUE(builder.has_finished(task_id(catalog, "C")));
  EXPECT_FALSE(builder.has_finished(task_id(catalog, "B")));
}

TEST_F(ProblemBuilderTest, ThePresentBehaviorsAreThoseBeforeTheEvent) {
  run("A", "a2", 1);
  builder.load(finish("a2", FinishCause::time_out), 9);
  EXPECT_EQ(builder.build(1).present, (std::vector<std::uint32_t>{1, none, none}))
      << "a task whose behavior just finished counts as running with it";
}

}  // namespace
}  // namespace cbc
