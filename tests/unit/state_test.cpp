#include "coordinator/state.h"

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
  state.set_active(0, 2 * second);
  state.set_value(0, 0, 2 * second);
  state.update_timeout(0, 2 * second);
  state.update_timeout(0, 12 * second);
  EXPECT_EQ(state.timeouts().first_due(), 12 * second) << "still waited for";
  state.drop_timeout(0);
  state.update_timeout(0, 12 * second);
  EXPECT_TRUE(state.timeouts().empty());
  state.set_active(0, 12 * second);
  state.update_timeout(0, 12 * second);
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

}  // namespace
}  // namespace cbc::state_test
