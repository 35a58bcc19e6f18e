// What events can come to, on catalogs whose states are counted by hand.
#include "explore/properties/outcomes.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "explore/properties/explore.h"
#include "unit/compiled_fixture.h"

namespace cbc::outcomes_test {
namespace {

/// LAND excludes the other two.
constexpr const char* drone = R"(
behaviors:
- {behavior: CAMERA, task: FILM}
- {behavior: RADIO, task: REPORT}
- {behavior: DESCEND, task: LAND}
exclusivity_constraints:
- mutually_exclusive: [FILM, LAND]
- mutually_exclusive: [REPORT, LAND]
)";

Exploration explore_group(const CompiledCatalog& catalog, ExplorationOptions options = {}) {
  options.outcomes = true;
  return explore(catalog, {GroupId(0)}, default_assumptions(catalog), {}, options);
}

/// "2 FILM CAMERA REPORT RADIO": the length of the script, then what runs.
std::vector<std::string> texts_of(const CompiledCatalog& catalog, const Exploration& exploration) {
  std::vector<std::string> texts;
  for (const ReachableOutcome& outcome : exploration.outcomes.value()) {
    std::string& text = texts.emplace_back(std::to_string(outcome.script.size()));
    for (const auto& [task, behavior] : outcome.running) {
      text += " " + std::string(catalog.task_names[task]);
      text += " " + std::string(catalog.behavior_names[behavior]);
    }
  }
  return texts;
}

TEST(Outcomes, AreInTheOrderOfTheirScriptsThenOfTheCatalog) {
  const CompiledCatalog catalog = test::compile_text(drone);
  const Exploration result = explore_group(catalog);
  EXPECT_EQ(texts_of(catalog, result),
            (std::vector<std::string>{"0", "1 FILM CAMERA", "1 REPORT RADIO", "1 LAND DESCEND",
                                      "2 FILM CAMERA REPORT RADIO"}));
  EXPECT_EQ(result.outcomes->back().script,
            (std::vector<Move>{{Move::Kind::start, 0, 1}, {Move::Kind::start, 1, 1}}));
}

TEST(Outcomes, AreThoseUpToTheDepthThatWasVisited) {
  const CompiledCatalog catalog = test::compile_text(drone);
  ExplorationOptions options;
  options.budget.max_states = 2;
  const Exploration result = explore_group(catalog, options);
  EXPECT_EQ(result.depth, 0U);
  EXPECT_EQ(texts_of(catalog, result), std::vector<std::string>{"0"});
}

TEST(Outcomes, AreNotWantedUnlessAskedFor) {
  const CompiledCatalog catalog = test::compile_text(drone);
  const Exploration result =
      explore(catalog, {GroupId(0)}, default_assumptions(catalog), {}, ExplorationOptions());
  EXPECT_FALSE(result.outcomes.has_value());
}

// HOLD starts by itself, as nothing excludes it at first, and whenever DRIVE ends. After a failure
// of BRAKE it waits.
TEST(Outcomes, HaveNothingInTheQueue) {
  const CompiledCatalog catalog = test::compile_text(R"(
behaviors:
- {behavior: WHEELS, task: DRIVE}
- {behavior: BRAKE, task: HOLD}
tasks:
- {task: DRIVE}
- {task: HOLD, start_on_request: false, reactive_start: true, execution_goal: keep_running}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, HOLD]
)");
  const Exploration result = explore_group(catalog);
  EXPECT_EQ(texts_of(catalog, result),
            (std::vector<std::string>{"1 DRIVE WHEELS", "1 HOLD BRAKE", "2"}));
  EXPECT_EQ(result.outcomes->back().script,
            (std::vector<Move>{{Move::Kind::due}, {Move::Kind::failure, 1}}));
}

TEST(Outcomes, ArePropertiesAboutAllTasksOfTheGroup) {
  const CompiledCatalog catalog = test::compile_text(drone);
  const Exploration result = explore_group(catalog);
  const Property property = property_of(catalog, GroupId(0), result.outcomes->at(1));
  EXPECT_EQ(property.kind, Property::Kind::reachable);
  EXPECT_TRUE(property.settled);
  EXPECT_EQ(describe_condition(catalog, property.condition),
            "FILM runs with CAMERA and REPORT does not run and LAND does not run");
}

}  // namespace
}  // namespace cbc::outcomes_test
