#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "compile/catalog_dump.h"
#include "unit/compiled_bytes.h"
#include "unit/compiled_fixture.h"

namespace cbc::catalog_text_test {
namespace {

std::string list(const char* yaml) {
  return catalog_text(test::compiled_file(test::compile_text(yaml)));
}

constexpr const char* head =
    "source: robot.yaml\n"
    "source digest: abababababababababababababababab\n"
    "written by: cbc 1.2.3\n"
    "format: 7\n"
    "content digest: 01010101010101010101010101010101\n"
    "size: 4321 bytes\n"
    "\n";

TEST(CatalogText, ListsWhatACatalogHolds) {
  EXPECT_EQ(list(R"(
behaviors:
- {behavior: PID, task: HOVER, suitability: 70, timeout: 2.5}
- behavior: MPC
  package: control
  task: HOVER
  suitability: 99.5
  requires:
  - {task: LOCALIZE, minimum_performance: 80.25}
  - {task: BLINK}
- {behavior: GPS, task: LOCALIZE}
- {behavior: LED, task: BLINK}
- {behavior: LAND_SOFTLY, task: LAND}
- {behavior: BEEP, task: SING}
tasks:
- task: SING
  parameters:
  - {parameter: tune, allowed_values: [LA, LE LU]}
  - {parameter: volume, allowed_values: number}
  - {parameter: key}
- task: HOVER
  execution_goal: keep_running
- task: LOCALIZE
  start_on_request: false
  minimum_performance: 50
- task: LAND
  timeout: 12
- task: BLINK
  start_on_request: false
  reactive_start: true
exclusivity_constraints:
- mutually_exclusive: [LAND, HOVER]
- mutually_exclusive: [BLINK, LAND, BLINK]
)"),
            std::string(head) +
                "tasks: 5\n"
                "behaviors: 6\n"
                "levels: 2\n"
                "exclusive pairs: 2\n"
                "requirements: 2\n"
                "task minimums: 1\n"
                "constraints: 5\n"
                "search space: 48\n"
                "situation variables: 0\n"
                "groups: 2\n"
                "\n"
                "group 0\n"
                "  tasks: 1\n"
                "  behaviors: 1\n"
                "  levels: 1\n"
                "  exclusive pairs: 0\n"
                "  requirements: 0\n"
                "  task minimums: 0\n"
                "  constraints: 0\n"
                "  search space: 2\n"
                "  task SING\n"
                "    level: 0\n"
                "    execution_goal: achieve_goal\n"
                "    start_on_request: true\n"
                "    reactive_start: false\n"
                "    parameter: tune, [LA, LE LU]\n"
                "    parameter: volume, number\n"
                "    parameter: key\n"
                "    behavior: BEEP, 100 %\n"
                "  behavior BEEP\n"
                "    level: 0\n"
                "\n"
                "group 1\n"
                "  tasks: 4\n"
                "  behaviors: 5\n"
                "  levels: 2\n"
                "  exclusive pairs: 2\n"
                "  requirements: 2\n"
                "  task minimums: 1\n"
                "  constraints: 5\n"
                "  search space: 24\n"
                "  task HOVER\n"
                "    level: 1\n"
                "    execution_goal: keep_running\n"
                "    start_on_request: true\n"
                "    reactive_start: false\n"
                "    behavior: MPC, 99.5 %\n"
                "    behavior: PID, 70 %\n"
                "  task LOCALIZE\n"
                "    level: 0\n"
                "    execution_goal: achieve_goal\n"
                "    start_on_request: false\n"
                "    reactive_start: false\n"
                "    minimum_performance: 50 %\n"
                "    behavior: GPS, 100 %\n"
                "  task LAND\n"
                "    level: 0\n"
                "    execution_goal: achieve_goal\n"
                "    start_on_request: true\n"
                "    reactive_start: false\n"
                "    timeout: 12 s\n"
                "    behavior: LAND_SOFTLY, 100 %\n"
                "  task BLINK\n"
                "    level: 0\n"
                "    execution_goal: achieve_goal\n"
                "    start_on_request: false\n"
                "    reactive_start: true\n"
                "    behavior: LED, 100 %\n"
                "  behavior PID\n"
                "    level: 0\n"
                "    timeout: 2.5 s\n"
                "  behavior MPC\n"
                "    level: 1\n"
                "    package: control\n"
                "    requires: LOCALIZE, at least 80.25 %\n"
                "    requires: BLINK\n"
                "  behavior GPS\n"
                "    level: 0\n"
                "  behavior LED\n"
                "    level: 0\n"
                "  behavior LAND_SOFTLY\n"
                "    level: 0\n"
                "  mutually_exclusive: HOVER, LAND\n"
                "  mutually_exclusive: LAND, BLINK\n");
}

TEST(CatalogText, ListsSituationVariablesAndConditions) {
  const std::string text = list(R"(
situation:
- {variable: TARGET, values: [far, near, lost]}
- {variable: GPS}
behaviors:
- {behavior: SEE, task: LOOK, situation: {GPS: false, TARGET: [near, far]}}
)");
  EXPECT_NE(text.find("situation variables: 2\n"
                      "  variable TARGET: far, near, lost\n"
                      "  variable GPS\n"
                      "groups: 1\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  behavior SEE\n"
                      "    level: 0\n"
                      "    situation: TARGET: far, near\n"
                      "    situation: not GPS\n"),
            std::string::npos)
      << text;
}

TEST(CatalogText, ListsABehaviorOfSeveralTasksOnce) {
  const std::string text = list(R"(
behaviors:
- {behavior: BOTH, tasks: [{task: A, suitability: 40}, {task: B, suitability: 60}]}
)");
  EXPECT_NE(text.find("\n    behavior: BOTH, 40 %\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n    behavior: BOTH, 60 %\n"), std::string::npos) << text;
  const std::size_t first = text.find("\n  behavior BOTH\n");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(text.find("\n  behavior BOTH\n", first + 1), std::string::npos);
}

TEST(CatalogText, ListsAnEmptyCatalog) {
  EXPECT_EQ(list("behaviors: []"), std::string(head) +
                                       "tasks: 0\n"
                                       "behaviors: 0\n"
                                       "levels: 0\n"
                                       "exclusive pairs: 0\n"
                                       "requirements: 0\n"
                                       "task minimums: 0\n"
                                       "constraints: 0\n"
                                       "search space: 1\n"
                                       "situation variables: 0\n"
                                       "groups: 0\n");
}

TEST(CatalogText, MakesHostileNamesHarmless) {
  const std::string text = list(R"(behaviors: [{behavior: "a\nb", task: "\e[2J"}])");
  EXPECT_NE(text.find("\n  task \\x1b[2J\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  behavior a\\nb\n"), std::string::npos) << text;
}

/// A line more in the source, and another place of a group, change nothing else.
TEST(CatalogText, DoesNotSayWhereThingsStandInTheSource) {
  const std::string plain = list(
      "behaviors: [{behavior: b, task: t, requires: [{task: u}]},\n"
      "  {behavior: c, task: u}]\n"
      "exclusivity_constraints: [{mutually_exclusive: [v, u]}]\n"
      "tasks: [{task: v, minimum_performance: 10}, {task: u}]\n");
  const std::string moved = list(
      "\n\nbehaviors: [\n{behavior: b, task: t, requires: [\n{task: u}]},\n\n"
      "  {behavior: c, task: u}]\n\n"
      "exclusivity_constraints: [{mutually_exclusive: [v, u]}]\n"
      "tasks: [{task: v, \nminimum_performance: 10}, {task: u}]\n");
  EXPECT_EQ(plain, moved);
}

}  // namespace
}  // namespace cbc::catalog_text_test
