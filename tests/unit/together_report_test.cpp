// The table of tasks that can run together, as text, JSON and DOT.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/check/together.h"
#include "graph/report/tables.h"
#include "lint/report/lint_report.h"
#include "unit/compiled_fixture.h"

namespace cbc::together_report_test {
namespace {

using Json = nlohmann::json;

CompiledCatalog robot() {
  return test::compile_text(R"(default_values:
  tasks: {execution_goal: keep_running}
behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: PID}]}
- {behavior: FLY_LAND, task: LAND, requires: [{task: DF}]}
- {behavior: PID_CONTROLLER, task: PID}
- {behavior: DF_CONTROLLER, task: DF}
- {behavior: BLINK, task: BLINK}
- {behavior: MOVE, task: MOVE, requires: [{task: PID}]}
- {behavior: SPIN, task: SPIN, requires: [{task: PID}, {task: DF}]}
tasks:
- task: HOVER
- task: BLINK
- task: LAND
- task: MOVE
- task: SPIN
- {task: PID, start_on_request: FALSE}
- {task: DF, start_on_request: FALSE}
exclusivity_constraints:
- mutually_exclusive: [PID, DF]
- mutually_exclusive: [HOVER, MOVE]
)");
}

TogetherTable table_of(const CompiledCatalog& catalog) { return make_together_table(catalog, {}); }

std::string text_of(const CompiledCatalog& catalog) {
  return together_text(catalog, table_of(catalog), plain_style());
}

TEST(TogetherText, IsAMatrixWithReasons) {
  const CompiledCatalog catalog = robot();
  std::string text = text_of(catalog);
  const std::string file(catalog.file);
  for (std::size_t at = 0; (at = text.find(file, at)) != std::string::npos;) {
    text.replace(at, file.size(), "robot.yaml");
  }
  EXPECT_EQ(text, R"(robot.yaml
  4 tasks on request, 6 pairs
    + can run together: 3
    - excluded by a list: 1
    x excluded by what they require: 2
  left out, since they can never run: SPIN

          123
  1 HOVER
  2 BLINK +
  3 LAND  x+
  4 MOVE  -+x

HOVER, LAND
  HOVER_WITH_PID requires PID (robot.yaml:4)
  PID excludes DF (robot.yaml:20)
  FLY_LAND requires DF (robot.yaml:5)

LAND, MOVE
  FLY_LAND requires DF (robot.yaml:5)
  PID excludes DF (robot.yaml:20)
  behavior MOVE requires PID (robot.yaml:9)
)");
}

/// A catalog of tasks that do not exclude one another.
CompiledCatalog many_tasks(std::size_t number, std::string_view name) {
  std::string behaviors = "behaviors:\n";
  std::string tasks = "tasks:\n";
  for (std::size_t i = 0; i < number; ++i) {
    const std::string task = std::string(name) + std::to_string(i);
    behaviors += "- {behavior: B" + std::to_string(i) + ", task: " + task + "}\n";
    tasks += "- {task: " + task + "}\n";
  }
  return test::compile_text(behaviors + tasks);
}

std::size_t longest_line(std::string_view text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    longest = std::max(longest, end - begin);
    begin = end + 1;
  }
  return longest;
}

TEST(TogetherText, FitsIntoEightyColumns) {
  const std::string forty = text_of(many_tasks(40, "A_TASK_WITH_A_RATHER_LONG_NAME_"));
  EXPECT_LE(longest_line(forty), 80U);
  // One matrix, with its numbers upright.
  EXPECT_NE(forty.find("1 11111 11112 22222"), std::string::npos) << forty;
  EXPECT_NE(forty.find("\n  40 A_TASK_WITH_..._LONG_NAME_39 +++++ +++++ +++++ "), std::string::npos)
      << forty;
  EXPECT_EQ(forty.find("\n\n", forty.find("\n  40 A")), std::string::npos) << forty;
  const std::string hundred = text_of(many_tasks(100, "A_TASK_WITH_A_RATHER_LONG_NAME_"));
  EXPECT_LE(longest_line(hundred), 80U);
  EXPECT_EQ(std::count(hundred.begin(), hundred.end(), '+'), 1 + 100 * 99 / 2);
}

TEST(TogetherText, OfNoTasks) {
  const CompiledCatalog catalog = test::compile_text(
      "behaviors: [{behavior: b, task: T}]\ntasks: [{task: T, start_on_request: FALSE}]\n");
  EXPECT_EQ(together_text(catalog, TogetherTable{}, plain_style()),
            std::string(catalog.file) + "\n  0 tasks on request, 0 pairs\n");
}

/// Any task may be requested, so a catalog in which none waits for a request has its pairs, too.
TEST(TogetherText, OfAllTasks) {
  const CompiledCatalog catalog = test::compile_text(R"(default_values:
  tasks: {start_on_request: FALSE}
behaviors: [{behavior: a, task: A}, {behavior: b, task: B}, {behavior: c, task: C}]
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints: [{mutually_exclusive: [A, C]}]
)");
  EXPECT_EQ(text_of(catalog),
            std::string(catalog.file) +
                "\n  3 tasks, 3 pairs; no task has start_on_request, so all tasks "
                "are here\n"
                "    + can run together: 2\n"
                "    - excluded by a list: 1\n"
                "\n"
                "      12\n"
                "  1 A\n"
                "  2 B +\n"
                "  3 C -+\n");
  EXPECT_EQ(Json::parse(together_json(catalog, table_of(catalog)))["all_tasks"], true);
}

TEST(TogetherText, MarksWhatTheSettingsForbid) {
  const CompiledCatalog catalog = robot();
  const std::vector<NeverTogether> lists{{"", {}, {"HOVER", "LAND", "BLINK", "DIVE"}, {}}};
  TogetherOptions options;
  options.never_together = lists;
  const TogetherTable table = make_together_table(catalog, options);
  const std::string text = together_text(catalog, table, plain_style());
  EXPECT_NE(text.find("    + can run together: 1\n"
                      "    ! can run together, which the settings forbid: 2\n"
                      "    - excluded by a list: 1\n"),
            std::string::npos)
      << text;
  // What cannot happen need not be forbidden.
  EXPECT_NE(text.find("  2 BLINK !\n  3 LAND  x!\n  4 MOVE  -+x\n"), std::string::npos) << text;
  const Json json = Json::parse(together_json(catalog, table));
  EXPECT_EQ(json["possible"], 3);
  EXPECT_EQ(json["forbidden"], 2);
  EXPECT_EQ(json["pairs"][0]["forbidden"], true);
  EXPECT_EQ(json["pairs"][1]["forbidden"], false);
}

TEST(TogetherTable, LeavesOpenWhatTakesTooLong) {
  // Of two neighboring sensors at most one is on.
  const CompiledCatalog catalog = test::compile_text(R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- {behavior: DELIVERY, task: DELIVER, requires: [{task: LOCALIZE}, {task: AVOID}]}
- {behavior: WATCHING, task: WATCH, requires: [{task: MAP}, {task: TRACK}]}
- {behavior: LOCALIZE_BY_LIDAR, task: LOCALIZE, requires: [{task: LIDAR}]}
- {behavior: LOCALIZE_BY_WHEELS, task: LOCALIZE, suitability: 60}
- {behavior: AVOID_BY_SONAR, task: AVOID, requires: [{task: SONAR}]}
- {behavior: AVOID_BY_BUMPER, task: AVOID, suitability: 60}
- {behavior: MAP_BY_RADAR, task: MAP, requires: [{task: RADAR}]}
- {behavior: MAP_BY_PLAN, task: MAP, suitability: 60}
- {behavior: TRACK_BY_CAMERA, task: TRACK, requires: [{task: CAMERA}]}
- {behavior: TRACK_BY_SOUND, task: TRACK, suitability: 60}
- {behavior: DRIVER, tasks: [{task: LIDAR}, {task: SONAR}, {task: RADAR}, {task: CAMERA}]}
tasks:
- {task: DELIVER, start_on_request: TRUE}
- {task: WATCH, start_on_request: TRUE}
- task: LOCALIZE
- task: AVOID
- task: MAP
- task: TRACK
- task: LIDAR
- task: SONAR
- task: RADAR
- task: CAMERA
exclusivity_constraints:
- mutually_exclusive: [LIDAR, SONAR]
- mutually_exclusive: [SONAR, RADAR]
- mutually_exclusive: [RADAR, CAMERA]
)");
  const TogetherTable decided = table_of(catalog);
  ASSERT_EQ(decided.pairs.size(), 1U);
  EXPECT_EQ(decided.pairs[0].together, Together::possible);
  const TogetherTable limited = make_together_table(catalog, {.max_nodes = 1});
  ASSERT_EQ(limited.pairs.size(), 1U);
  EXPECT_EQ(limited.pairs[0].together, Together::undecided);
  EXPECT_NE(together_text(catalog, limited, plain_style())
                .find("? not decided: there is too much to search: 1\n"),
            std::string::npos);
}

TEST(TogetherTable, LooksAtAllSituations) {
  // BY_DAY and AT_NIGHT are of different groups, DRIVE and DOCK of one. FLY requires what fits at
  // night only, or what fits by day only.
  const CompiledCatalog catalog = test::compile_text(R"(situation:
- {variable: LIGHT, values: [day, dusk, night]}
- variable: DRY
behaviors:
- {behavior: a, task: BY_DAY, situation: {LIGHT: [day, dusk]}}
- {behavior: b, task: AT_NIGHT, situation: {LIGHT: night}}
- {behavior: c, task: AT_DUSK, situation: {LIGHT: [dusk, night], DRY: false}}
- {behavior: d, task: FLY, requires: [{task: SEE}]}
- {behavior: e, task: SEE, situation: {LIGHT: day}}
- {behavior: f, task: SEE, situation: {LIGHT: night, DRY: true}}
- {behavior: g, task: REST}
tasks:
- task: BY_DAY
- task: AT_NIGHT
- task: AT_DUSK
- task: FLY
- task: REST
- {task: SEE, start_on_request: FALSE, execution_goal: keep_running}
)");
  const std::string text = text_of(catalog);
  EXPECT_NE(text.find("    + can run together: 8\n    s fit in no common situation: 2\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  2 AT_NIGHT s\n"
                      "  3 AT_DUSK  ++\n"
                      "  4 FLY      ++s\n"
                      "  5 REST     ++++\n"
                      "\n"
                      "BY_DAY, AT_NIGHT\n"
                      "  a fits only where LIGHT is day or dusk\n"
                      "  b fits only where LIGHT is night\n"
                      "\n"
                      "AT_DUSK, FLY\n"
                      "  c fits only where DRY is false\n"
                      "  c fits only where LIGHT is dusk or night\n"
                      "  d requires SEE ("),
            std::string::npos)
      << text;
}

TEST(TogetherTable, TellsExclusionsInEachSituation) {
  // By day A takes P and B takes Q, at night the other way around.
  const CompiledCatalog catalog = test::compile_text(R"(situation:
- {variable: LIGHT, values: [day, night]}
behaviors:
- {behavior: a1, task: A, requires: [{task: P}], situation: {LIGHT: day}}
- {behavior: a2, task: A, requires: [{task: Q}], situation: {LIGHT: night}}
- {behavior: b1, task: B, requires: [{task: Q}], situation: {LIGHT: day}}
- {behavior: b2, task: B, requires: [{task: P}], situation: {LIGHT: night}}
- {behavior: p, task: P}
- {behavior: q, task: Q}
tasks:
- task: A
- task: B
- {task: P, start_on_request: FALSE, execution_goal: keep_running}
- {task: Q, start_on_request: FALSE, execution_goal: keep_running}
exclusivity_constraints:
- mutually_exclusive: [P, Q]
)");
  const TogetherTable table = table_of(catalog);
  ASSERT_EQ(table.pairs.size(), 1U);
  EXPECT_EQ(table.pairs[0].together, Together::excluded_in_each_situation);
  // All requirements, all conditions, and the exclusion.
  EXPECT_EQ(table.pairs[0].reasons.size(), 9U);
  const std::string text = together_text(catalog, table, plain_style());
  EXPECT_NE(text.find("    X excluded in each situation, by what fits in it: 1\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\n  2 B X\n"), std::string::npos) << text;
}

TEST(TogetherTable, LeavesOutWhatFitsInNoSituation) {
  const CompiledCatalog catalog = test::compile_text(R"(situation:
- {variable: LIGHT, values: [day, night]}
behaviors:
- {behavior: a, task: FLY, requires: [{task: SEE}], situation: {LIGHT: night}}
- {behavior: b, task: SEE, situation: {LIGHT: day}}
- {behavior: c, task: REST}
tasks:
- task: FLY
- task: REST
- {task: SEE, start_on_request: FALSE, execution_goal: keep_running}
)");
  const TogetherTable table = table_of(catalog);
  EXPECT_EQ(table.tasks.size(), 1U);
  ASSERT_EQ(table.never_run.size(), 1U);
  EXPECT_EQ(catalog.name_of_task(table.never_run[0]), "FLY");
}

TEST(TogetherJson, HasAllPairs) {
  const CompiledCatalog catalog = robot();
  const Json json = Json::parse(together_json(catalog, table_of(catalog)));
  EXPECT_EQ(json["schema"], "cbc.together/1");
  EXPECT_EQ(json["tasks"], Json::parse(R"(["HOVER", "BLINK", "LAND", "MOVE"])"));
  EXPECT_EQ(json["never_run"], Json::parse(R"(["SPIN"])"));
  EXPECT_EQ(json["possible"], 3);
  EXPECT_EQ(json["excluded"], 1);
  EXPECT_EQ(json["excluded_indirectly"], 2);
  EXPECT_EQ(json["undecided"], 0);
  ASSERT_EQ(json["pairs"].size(), 6U);
  EXPECT_EQ(json["pairs"][0]["together"], "possible");
  EXPECT_EQ(json["pairs"][0]["reasons"], Json::array());
  const Json& pair = json["pairs"][1];
  EXPECT_EQ(pair["tasks"], Json::parse(R"(["HOVER", "LAND"])"));
  EXPECT_EQ(pair["together"], "excluded_indirectly");
  // From one task to the other one.
  ASSERT_EQ(pair["reasons"].size(), 3U);
  EXPECT_EQ(pair["reasons"][0]["behavior"], "HOVER_WITH_PID");
  EXPECT_EQ(pair["reasons"][1]["tasks"], Json::parse(R"(["PID", "DF"])"));
  EXPECT_EQ(pair["reasons"][2]["behavior"], "FLY_LAND");
  EXPECT_EQ(json["pairs"][2]["together"], "excluded");
  EXPECT_EQ(json["pairs"][2]["reasons"][0]["line"], 21);
}

}  // namespace
}  // namespace cbc::together_report_test
