#include "coordinator/state.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

using test::behavior_id;
using test::compile_text;
using test::task_id;

// In groups the tasks stand as A C | B.
constexpr const char* text = R"(
tasks:
- {task: A, timeout: 10}
- {task: B, start_on_request: false, reactive_start: true}
- {task: C, start_on_request: false, execution_goal: keep_running, timeout: 5}
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A, suitability: 90, timeout: 3}
- {behavior: b, task: B}
- {behavior: x, tasks: [{task: A, suitability: 50}, {task: C}], timeout: 4}
)";

class StateTest : public testing::Test {
 protected:
  [[nodiscard]] TaskId task(std::string_view name) const { return task_id(catalog, name); }
  [[nodiscard]] BehaviorId behavior(std::string_view name) const {
    return behavior_id(catalog, name);
  }
  void run(std::string_view task_name, std::string_view behavior_name, Microseconds now = 0) {
    state.set_value(task(task_name), test::value_index(catalog, task_name, behavior_name), now);
  }
  void stop(std::string_view name) { state.set_value(task(name), none, 0); }

  CompiledCatalog catalog = compile_text(text);
  State state{catalog};
};

TEST_F(StateTest, AtTheStartNothingRuns) {
  for (TaskId one = 0; one < 3; ++one) {
    EXPECT_FALSE(state.is_running(one));
    EXPECT_EQ(state.behavior(one), none);
    EXPECT_FALSE(state.has_request(one));
  }
  for (BehaviorId one = 0; one < 4; ++one) {
    EXPECT_TRUE(state.is_available(one));
    EXPECT_FALSE(state.is_faulty(one));
    EXPECT_FALSE(state.is_active(one));
  }
  EXPECT_TRUE(state.timeouts().empty());
  EXPECT_TRUE(state.queue().empty());
  EXPECT_EQ(state.idle_total(), 2U);
  EXPECT_EQ(state.idle_running(), 0U);
}

TEST_F(StateTest, ListsRunningTasksInCatalogOrder) {
  run("C", "x");
  run("B", "b");
  run("A", "a2");
  EXPECT_EQ(state.running(), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(state.behavior(task("A")), behavior("a2"));
  EXPECT_EQ(state.idle_running(), 2U);
  run("A", "a1");
  stop("B");
  EXPECT_EQ(state.running(), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(state.idle_running(), 1U);
}

TEST_F(StateTest, ATaskLosesItsRequestAsSoonAsItDoesNotRun) {
  run("A", "a1");
  state.set_request(task("A"), 3, 7, "p");
  EXPECT_EQ(state.request_count(), 1U);
  EXPECT_EQ(state.request(task("A")).priority, 3);
  EXPECT_EQ(state.request(task("A")).event, 7U);
  EXPECT_EQ(state.request(task("A")).parameters, "p");
  run("A", "a2");
  EXPECT_TRUE(state.has_request(task("A"))) << "another behavior keeps it";
  state.set_request(task("A"), 4, 8, "");
  EXPECT_EQ(state.request_count(), 1U);
  stop("A");
  EXPECT_FALSE(state.has_request(task("A")));
  EXPECT_EQ(state.request_count(), 0U);
  run("A", "a1");
  EXPECT_FALSE(state.has_request(task("A")));
}

TEST_F(StateTest, AvailabilityIsThatOfAllValuesOfTheBehavior) {
  state.set_available(behavior("x"), false);
  EXPECT_FALSE(state.is_available(behavior("x")));
  EXPECT_FALSE(state.has_available_behavior(task("C")));
  EXPECT_TRUE(state.has_available_behavior(task("A")));
  // The values of A are a1, a2, x.
  EXPECT_EQ(state.available_words()[catalog.words[task("A")]], 0b011U);
  state.set_available(behavior("a1"), false);
  EXPECT_EQ(state.available_words()[catalog.words[task("A")]], 0b010U);
  state.set_available(behavior("x"), true);
  EXPECT_EQ(state.available_words()[catalog.words[task("A")]], 0b110U);
  EXPECT_EQ(state.available_words()[catalog.words[task("C")]], 0b1U);
}

TEST_F(StateTest, ABehaviorTimesOutAfterTheTimeOfItsTask) {
  state.set_active(behavior("a1"), 2 * second);
  run("A", "a1", 2 * second);
  state.update_timeout(task("A"), 0);
  EXPECT_EQ(state.timeouts().first(), 0U);
  EXPECT_EQ(state.timeouts().first_due(), 12 * second);
  stop("A");
  state.update_timeout(task("A"), 0);
  EXPECT_TRUE(state.timeouts().empty());
}

TEST_F(StateTest, ATimeoutThatWasDealtWithIsDueAgainOnlyAfterAnotherActivation) {
  state.set_active(behavior("a1"), 2 * second);
  run("A", "a1", 2 * second);
  state.update_timeout(task("A"), 2 * second);
  state.update_timeout(task("A"), 12 * second);
  EXPECT_EQ(state.timeouts().first_due(), 12 * second) << "still waited for";
  state.drop_timeout(task("A"));
  state.update_timeout(task("A"), 12 * second);
  EXPECT_TRUE(state.timeouts().empty());
  state.set_active(behavior("a1"), 12 * second);
  state.update_timeout(task("A"), 12 * second);
  EXPECT_EQ(state.timeouts().first_due(), 22 * second);
}

TEST_F(StateTest, TheTimeOfABehaviorOverridesThatOfTheTask) {
  state.set_active(behavior("a2"), second);
  run("A", "a2", second);
  state.update_timeout(task("A"), 0);
  EXPECT_EQ(state.timeouts().first_due(), 4 * second);
}

TEST_F(StateTest, ATaskThatKeepsRunningHasNoTimeout) {
  state.set_active(behavior("x"), 0);
  run("C", "x");
  state.update_timeout(task("C"), 0);
  EXPECT_TRUE(state.timeouts().empty());
}

TEST_F(StateTest, TheTimeRunsFromTheLaterOfActivationAndTaking) {
  state.set_active(behavior("x"), 1 * second);
  run("A", "x", 5 * second);
  state.update_timeout(task("A"), 0);
  EXPECT_EQ(state.timeouts().first_due(), 9 * second) << "taken after it was activated";
  state.set_active(behavior("x"), 6 * second);
  state.update_timeout(task("A"), 0);
  EXPECT_EQ(state.timeouts().first_due(), 10 * second) << "activated again";
  run("A", "x", 8 * second);
  state.update_timeout(task("A"), 0);
  EXPECT_EQ(state.timeouts().first_due(), 10 * second) << "nothing was taken anew";
}

TEST_F(StateTest, ATaskJoinsTheQueueOnlyOnceAndIfItDoesNotRun) {
  state.enqueue(task("B"), 5);
  state.enqueue(task("B"), 9);
  EXPECT_EQ(state.queue().first(), 1U) << "items are catalog indices";
  EXPECT_EQ(state.queue().first_due(), 5);
  state.dequeue(task("B"));
  EXPECT_TRUE(state.queue().empty());
  run("B", "b");
  state.enqueue(task("B"), 9);
  EXPECT_TRUE(state.queue().empty());
}

TEST_F(StateTest, FaultsAndActivity) {
  state.set_faulty(behavior("b"), true);
  EXPECT_TRUE(state.is_faulty(behavior("b")));
  state.set_faulty(behavior("b"), false);
  EXPECT_FALSE(state.is_faulty(behavior("b")));
  state.set_active(behavior("b"), 0);
  EXPECT_TRUE(state.is_active(behavior("b")));
  state.set_inactive(behavior("b"));
  EXPECT_FALSE(state.is_active(behavior("b")));
  state.leave_active(behavior("b"));
  EXPECT_TRUE(state.is_active(behavior("b")));
}

TEST(State, ListsRunningTasksOfLargeCatalogs) {
  std::string yaml = "behaviors:\n";
  for (int i = 0; i < 130; ++i) {
    yaml += "- {behavior: b" + std::to_string(i) + ", task: T" + std::to_string(i) + "}\n";
  }
  const CompiledCatalog catalog = compile_text(yaml);
  State state(catalog);
  const std::vector<std::uint32_t> running{0, 63, 64, 127, 128, 129};
  for (const std::uint32_t index : {128U, 0U, 129U, 64U, 127U, 5U, 63U}) {
    state.set_value(catalog.task_ids[index], 0, 0);
  }
  state.set_value(catalog.task_ids[5], none, 0);
  EXPECT_EQ(state.running(), running);
}

TEST(State, KnowsWhetherARunningTaskExcludesAnother) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B}
- {behavior: c, task: C}
exclusivity_constraints:
- mutually_exclusive: [A, B]
- mutually_exclusive: [B, C]
)");
  State state(catalog);
  state.set_value(task_id(catalog, "A"), 0, 0);
  EXPECT_FALSE(state.excludes_running_task(task_id(catalog, "A"))) << "not itself";
  EXPECT_TRUE(state.excludes_running_task(task_id(catalog, "B")));
  EXPECT_FALSE(state.excludes_running_task(task_id(catalog, "C")));
}

}  // namespace
}  // namespace cbc
