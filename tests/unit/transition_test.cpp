#include "runtime/coordinator/transition.h"

#include <string>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"
#include "unit/stage.h"

namespace cbc::transition_test {
namespace {

using test::Stage;

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

// It takes several failures in one event to get here.
TEST(Transition, ARestartOnlyActivatesABehaviorThatIsInactiveByThen) {
  const CompiledCatalog catalog = test::compile_text("behaviors: [{behavior: z, task: Z}]");
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
