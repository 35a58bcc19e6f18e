#include <string>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "core/words/suitability.h"
#include "core/words/words.h"
#include "unit/compiled_fixture.h"

namespace cbc::exact_values_test {
namespace {

double suitability(const std::vector<std::string>& percents) {
  std::string text = "behaviors:\n";
  for (std::size_t i = 0; i < percents.size(); ++i) {
    text += "- {behavior: b" + std::to_string(i) + ", task: T" + std::to_string(i) +
            ", suitability: " + percents[i] + "}\n";
  }
  const CompiledCatalog catalog = test::compile_text(text);
  State state(catalog);
  for (TaskId task(0); task < catalog.tasks.size(); ++task) state.set_value(task, 0, 0);
  return total_suitability(catalog, state);
}

TEST(ExactValues, TheSuitabilityOfNothingIsOne) {
  const CompiledCatalog catalog =
      test::compile_text("behaviors: [{behavior: a, task: A, suitability: 5}]");
  EXPECT_EQ(total_suitability(catalog, State(catalog)), 1.0);
}

TEST(ExactValues, SuitabilityIsTheNearestNumberToTheProduct) {
  EXPECT_EQ(suitability({"90", "80"}), 0.72);
  EXPECT_EQ(suitability({"70", "70"}), 0.49) << "0.7 * 0.7 is 0.48999999999999994";
  EXPECT_EQ(suitability({"10", "10", "10"}), 0.001);
  EXPECT_EQ(suitability({"100", "100"}), 1.0);
  EXPECT_EQ(suitability({"99.9999", "99.9999"}), 0.999998000001);
  EXPECT_EQ(suitability({"0.0001", "0.0001", "0.0001"}), 1e-18);
}

TEST(ExactValues, AZeroMakesItZero) {
  EXPECT_EQ(suitability({"90", "0"}), 0.0);
  EXPECT_EQ(suitability({"0", "90"}), 0.0);
}

TEST(ExactValues, ManyFactorsDoNotOverflow) {
  EXPECT_DOUBLE_EQ(suitability(std::vector<std::string>(60, "33.3333")), 2.3588409528186356e-29);
}

TEST(ExactValues, IdleIsTheShareOfTasksThatDoNotRun) {
  ObjectiveValues objective;
  EXPECT_EQ(idle_share(objective), 1.0) << "there is no such task";
  objective.idle_total = 3;
  objective.idle_running = 1;
  EXPECT_EQ(idle_share(objective), 2.0 / 3.0);
}

TEST(ExactValues, TheSearchSpaceIsExactBeyondSixtyFourBits) {
  EXPECT_EQ(search_space({}), "1");
  EXPECT_EQ(search_space({2, 1, 3}), "6");
  EXPECT_EQ(search_space({5, 0, 2}), "0");
  EXPECT_EQ(search_space(std::vector<std::uint32_t>(30, 10)), "1" + std::string(30, '0'));
}

TEST(ExactValues, SecondsAreTheNearestNumber) {
  EXPECT_EQ(to_seconds(0), 0.0);
  EXPECT_EQ(to_seconds(80'000), 0.08);
  EXPECT_EQ(to_seconds(4'080'000), 4.08);
  EXPECT_EQ(to_seconds(1), 1e-6);
}

}  // namespace
}  // namespace cbc::exact_values_test
