// Ranges of numbers that stand for several pairs, where the same answer at both ends of a range
// says nothing of what is between. Random cases hardly ever have such a number; see
// tune_property_test.cpp for all others.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "tune/engine/tuner.h"

namespace cbc::tune_test {
namespace {

/// The tolerance of the default suitability, of a mission.
Interval tolerance_of_default(const std::string& catalog, const std::string& events) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(catalog, "robot.yaml", diagnostics);
  const CatalogReading reading = understand_catalog(*document, diagnostics);
  const auto mission = yaml::parse(events, "mission.yaml", diagnostics);
  const auto script = read_script(*mission, compile(reading.catalog), Severity::note, diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::error), 0U);
  const std::vector<TunableNumber> numbers = find_numbers(reading);
  EXPECT_TRUE(numbers.front().is_default);
  return Tuner(reading.catalog, numbers, {&*script}, 0).tolerance(0).values;
}

// The answer is FAST, whose product is s * s. BEACONS is possible from 50 on, where SLOW has the
// product 0.7 * s, which is more up to 70.
TEST(Tune, FindsWhatIsTheBestBetweenTwoValuesWithTheSameAnswer) {
  const Interval values = tolerance_of_default(R"(
default_values: {behaviors: {suitability: 90}}
behaviors:
- {behavior: FAST, task: DRIVE, requires: [{task: SCAN}]}
- {behavior: SLOW, task: DRIVE, suitability: 70, requires: [{task: LOCALIZE, minimum_performance: 50}]}
- {behavior: LIDAR, task: SCAN}
- {behavior: BEACONS, task: LOCALIZE}
tasks:
- {task: DRIVE}
- {task: SCAN, start_on_request: false}
- {task: LOCALIZE, start_on_request: false}
)",
                                               "- start: DRIVE\n");
  EXPECT_EQ(values.low, 700'000U);
  EXPECT_EQ(values.high, 1'000'000U);
}

// Two assignments have the same product whatever the default is: one of the two tasks has it, the
// other one 70. The canonical order prefers what suits DRIVE better, and WAVE has to reach 50.
TEST(Tune, FindsWhereTheCanonicalOrderTurns) {
  const Interval values = tolerance_of_default(R"(
default_values: {behaviors: {suitability: 90}}
behaviors:
- {behavior: DRIVE_AND_WAVE, task: GREET, suitability: 100, requires: [{task: DRIVE}, {task: WAVE}]}
- {behavior: DRIVE_BY_SCAN, task: DRIVE, requires: [{task: LEFT}]}
- {behavior: DRIVE_BY_MAP, task: DRIVE, suitability: 70, requires: [{task: RIGHT}]}
- {behavior: WAVE_WITH_ARM, task: WAVE, requires: [{task: UP}]}
- {behavior: WAVE_WITH_FLAG, task: WAVE, suitability: 70, requires: [{task: DOWN}]}
- {behavior: TURN_LEFT, task: LEFT, suitability: 100}
- {behavior: TURN_RIGHT, task: RIGHT, suitability: 100}
- {behavior: LOOK_UP, task: UP, suitability: 100}
- {behavior: LOOK_DOWN, task: DOWN, suitability: 100}
tasks:
- {task: GREET}
- {task: DRIVE, start_on_request: false}
- {task: WAVE, start_on_request: false, minimum_performance: 50}
- {task: LEFT, start_on_request: false}
- {task: RIGHT, start_on_request: false}
- {task: UP, start_on_request: false}
- {task: DOWN, start_on_request: false}
exclusivity_constraints:
- mutually_exclusive: [LEFT, UP]
- mutually_exclusive: [RIGHT, DOWN]
)",
                                               "- start: GREET\n");
  EXPECT_EQ(values.low, 700'000U);
}

// At 0 all products are 0, and FAST, which takes fewer supporting tasks, is the answer again.
TEST(Tune, LooksAtZeroApart) {
  const Interval values = tolerance_of_default(R"(
default_values: {behaviors: {suitability: 90}}
behaviors:
- {behavior: FAST, task: DRIVE, requires: [{task: SCAN}]}
- {behavior: SLOW, task: DRIVE, suitability: 70, requires: [{task: LOCALIZE}, {task: SEE}]}
- {behavior: LIDAR, task: SCAN}
- {behavior: BEACONS, task: LOCALIZE}
- {behavior: CAMERA, task: SEE, suitability: 100}
tasks:
- {task: DRIVE}
- {task: SCAN, start_on_request: false}
- {task: LOCALIZE, start_on_request: false}
- {task: SEE, start_on_request: false}
)",
                                               "- start: DRIVE\n");
  EXPECT_EQ(values.low, 700'000U);
}

TEST(Tune, TakesTheMiddleWhereThereIsNoRoomForTheMargin) {
  const Interval narrow{400'000, 420'000};
  EXPECT_EQ(narrow.nearest(100'000, 0), 400'000U);
  EXPECT_EQ(narrow.nearest(900'000, 5'000), 415'000U);
  EXPECT_EQ(narrow.nearest(900'000, 50'000), 410'000U);
  const Interval open{0, 420'000};
  EXPECT_EQ(open.nearest(900'000, 50'000), 370'000U);
  EXPECT_EQ((Interval{400'000, 1'000'000}.nearest(0, 50'000)), 450'000U);
}

}  // namespace
}  // namespace cbc::tune_test
