#include "runtime/coordinator/state.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc::state_test {
namespace {

TEST(State, ATimeoutThatWasHandledIsDueAgainOnlyAfterAnotherActivation) {
  const CompiledCatalog catalog =
      test::compile_text("tasks: [{task: A, timeout: 10}]\nbehaviors: [{behavior: a, task: A}]\n");
  State state(catalog);
  const TaskId task(0);
  const BehaviorId behavior(0);
  state.set_active(behavior, 2 * second);
  state.set_value(task, 0, 2 * second);
  state.update_timeout(task, 2 * second);
  state.update_timeout(task, 12 * second);
  EXPECT_EQ(state.timeouts().first_due(), 12 * second) << "still waited for";
  state.drop_timeout(task);
  state.update_timeout(task, 12 * second);
  EXPECT_TRUE(state.timeouts().empty());
  state.set_active(behavior, 12 * second);
  state.update_timeout(task, 12 * second);
  EXPECT_EQ(state.timeouts().first_due(), 22 * second);
}

TEST(State, ListsRunningTasksOfLargeCatalogs) {
  std::string yaml = "behaviors:\n";
  for (int i = 0; i < 130; ++i) {
    yaml += "- {behavior: b" + std::to_string(i) + ", task: T" + std::to_string(i) + "}\n";
  }
  const CompiledCatalog catalog = test::compile_text(yaml);
  State state(catalog);
  const std::vector<std::uint32_t> running{0, 63, 64, 127, 128, 129};
  for (const std::uint32_t index : {128U, 0U, 129U, 64U, 127U, 5U, 63U}) {
    state.set_value(catalog.task_ids[index], 0, 0);
  }
  state.set_value(catalog.task_ids[5], none, 0);
  EXPECT_EQ(state.running(), running);
}

TEST(State, LeavesNothingBehindWhenAnotherOneIsRestored) {
  const CompiledCatalog catalog = test::compile_text(
      "tasks:\n- {task: A, reactive_start: true}\n- {task: B, reactive_start: true, timeout: 10}\n"
      "behaviors:\n- {behavior: a, task: A}\n- {behavior: b, task: B}\n");
  const TaskId task = test::task_id(catalog, "A");
  const TaskId other = test::task_id(catalog, "B");
  const BehaviorId behavior = catalog.values[other][0].behavior;
  State state(catalog);
  state.set_waiting(task, true);
  state.enqueue(task, second);
  state.set_value(other, 0, second);
  state.set_active(behavior, second);
  state.update_timeout(other, second);
  state.set_faulty(behavior, true);
  state.set_denied(behavior, true);
  state.restore(Snapshot());
  EXPECT_FALSE(state.is_waiting(task));
  EXPECT_EQ(state.waiting_count(), 0U);
  EXPECT_TRUE(state.queue().empty());
  EXPECT_FALSE(state.is_running(other));
  EXPECT_FALSE(state.is_active(behavior));
  EXPECT_TRUE(state.timeouts().empty());
  EXPECT_FALSE(state.is_faulty(behavior));
  EXPECT_TRUE(state.is_available(behavior));
}

}  // namespace
}  // namespace cbc::state_test
