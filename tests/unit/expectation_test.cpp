#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "script/runner.h"
#include "unit/compiled_fixture.h"

namespace cbc::expectation_test {
namespace {

// In groups the tasks stand as A C | B, so that places and ids differ.
class ExpectationTest : public testing::Test {
 protected:
  void SetUp() override {
    run("C", "c2");
    run("B", "b");
  }
  void run(std::string_view task, std::string_view behavior) {
    state.set_value(test::task_id(catalog, task), test::value_index(catalog, task, behavior), 0);
    state.set_active(test::behavior_id(catalog, behavior), 0);
  }
  [[nodiscard]] std::string mismatch(std::optional<Outcome> outcome = {}) const {
    return find_mismatch(expectation, catalog, state, outcome);
  }
  void expect_running(std::uint32_t task, std::optional<std::uint32_t> behavior = {}) {
    Expectation::Running running;
    running.task = task;
    running.behavior = behavior;
    expectation.running.push_back(running);
  }

  // Places in the catalog: tasks A 0, B 1, C 2; behaviors b 0, c1 1, c2 2, a 3.
  CompiledCatalog catalog = test::compile_text(R"(
tasks: [{task: A}, {task: B}, {task: C}]
behaviors:
- {behavior: b, task: B}
- {behavior: c1, task: C}
- {behavior: c2, task: C}
- {behavior: a, task: A}
exclusivity_constraints:
- mutually_exclusive: [A, C]
)");
  State state{catalog};
  Expectation expectation;
};

TEST_F(ExpectationTest, OfNothingAlwaysHolds) { EXPECT_EQ(mismatch(), ""); }

TEST_F(ExpectationTest, OfARunningTaskThatDoesNotRunFails) {
  expect_running(0);
  expect_running(0, 3);
  EXPECT_EQ(mismatch(),
            "expected task 'A' to run, but it does not run; "
            "expected task 'A' to run with 'a', but it does not run");
}

TEST_F(ExpectationTest, OfActiveBehaviorsIsAboutAllOfThemInAnyOrder) {
  expectation.active = {2, 0, 2};
  EXPECT_EQ(mismatch(), "");
  expectation.active = {0};
  EXPECT_EQ(mismatch(), "expected the active behaviors to be 'b', but found 'b', 'c2'");
  expectation.active = {0, 2, 3};
  EXPECT_EQ(mismatch(), "expected the active behaviors to be 'b', 'c2', 'a', but found 'b', 'c2'");
  expectation.active = std::vector<std::uint32_t>{};
  EXPECT_EQ(mismatch(), "expected the active behaviors to be none, but found 'b', 'c2'");
}

TEST_F(ExpectationTest, TellsAllThatDoesNotHold) {
  expectation.outcome = Outcome::unchanged;
  expect_running(0);
  expectation.stopped = {2};
  EXPECT_EQ(mismatch(Outcome::accepted),
            "expected outcome 'unchanged', but it is 'accepted'; "
            "expected task 'A' to run, but it does not run; "
            "expected task 'C' not to run, but it runs with 'c2'");
}

}  // namespace
}  // namespace cbc::expectation_test
