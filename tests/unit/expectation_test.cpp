#include <vector>

#include <gtest/gtest.h>

#include "core/script/runner.h"
#include "unit/compiled_fixture.h"

namespace cbc::expectation_test {
namespace {

TEST(Expectation, OfActiveBehaviorsIsAboutAllOfThemInAnyOrder) {
  // In groups the behaviors stand as c, a | b; in the catalog a is 0, b 1 and c 2.
  const CompiledCatalog catalog = test::compile_text(R"(
tasks: [{task: C}, {task: B}, {task: A}]
behaviors: [{behavior: a, task: A}, {behavior: b, task: B}, {behavior: c, task: C}]
exclusivity_constraints: [{mutually_exclusive: [A, C]}]
)");
  State state(catalog);
  for (const char* behavior : {"c", "b"}) {
    state.set_active(test::behavior_id(catalog, behavior), 0);
  }
  const auto mismatch = [&](const std::vector<std::uint32_t>& active) {
    Expectation expectation;
    expectation.active = active;
    return find_mismatch(expectation, catalog, state, {});
  };
  EXPECT_EQ(mismatch({2, 1, 2}), "");
  EXPECT_EQ(mismatch({1}), "expected the active behaviors to be 'b', but found 'b', 'c'");
  EXPECT_EQ(mismatch({1, 2, 0}),
            "expected the active behaviors to be 'a', 'b', 'c', but found 'b', 'c'");
  EXPECT_EQ(mismatch({}), "expected the active behaviors to be none, but found 'b', 'c'");
}

TEST(Expectation, OfOneOfSeveralBehaviors) {
  const CompiledCatalog catalog = test::compile_text(R"(
behaviors: [{behavior: a, task: A}, {behavior: b, task: A}, {behavior: c, task: A}]
)");
  State state(catalog);
  state.set_active(test::behavior_id(catalog, "c"), 0);
  state.set_value(TaskId(0), 2, 0);
  const auto mismatch = [&](const std::vector<std::uint32_t>& behaviors) {
    Expectation expectation;
    expectation.running.push_back({0, behaviors});
    return find_mismatch(expectation, catalog, state, {});
  };
  EXPECT_EQ(mismatch({}), "");
  EXPECT_EQ(mismatch({0, 2}), "");
  EXPECT_EQ(mismatch({0}), "expected task 'A' to run with 'a', but it runs with 'c'");
  EXPECT_EQ(mismatch({1, 0}), "expected task 'A' to run with 'b' or 'a', but it runs with 'c'");
}

}  // namespace
}  // namespace cbc::expectation_test
