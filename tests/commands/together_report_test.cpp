// The table of tasks that can run together, where it is large, limited or hostile.
#include "graph/report/together_report.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/check/together.h"
#include "lint/report/lint_report.h"
#include "unit/compiled_fixture.h"

namespace cbc::together_report_test {
namespace {

TogetherTable table_of(const CompiledCatalog& catalog) { return make_together_table(catalog, {}); }

std::string text_of(const CompiledCatalog& catalog) {
  return together_text(catalog, table_of(catalog), plain_style());
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

/// Their pairs would take minutes and gigabytes.
TEST(TogetherSummary, IsNotOfVeryManyTasks) {
  const auto summary_of = [](std::size_t tasks) {
    LintedFile file;
    const CompiledCatalog catalog = many_tasks(tasks, "T");
    file.summary = summarize(catalog);
    file.together = summarize_together(catalog, LintOptions().max_nodes);
    return lint_summary(file, plain_style());
  };
  EXPECT_NE(summary_of(10).find("pairs on request          45\n"), std::string::npos);
  const std::string summary = summary_of(50'000);
  EXPECT_TRUE(summary.ends_with("    pairs of more than 2000 tasks are not looked at\n"))
      << summary;
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

TEST(TogetherDot, EscapesNames) {
  const CompiledCatalog catalog = test::compile_text(
      "behaviors: [{behavior: a, task: 'A<&\"B>'}, {behavior: c, task: C}]\n"
      "tasks: [{task: 'A<&\"B>'}, {task: C}]\n");
  const std::string dot = together_dot(catalog, table_of(catalog));
  EXPECT_NE(dot.find("1 A&lt;&amp;&quot;B&gt;"), std::string::npos) << dot;
  EXPECT_NE(dot.find("\">+</TD>"), std::string::npos) << dot;
}

TEST(LintSummary, ListsTenTasksThatCanRunTogether) {
  const CompiledCatalog catalog = many_tasks(14, "T");
  LintedFile file{"a.yaml", "", {}, summarize(catalog)};
  file.together = summarize_together(catalog, LintOptions().max_nodes);
  const std::string text = lint_summary(file, plain_style());
  EXPECT_NE(text.find("    T9 with T10, T11, T12, T13\n"
                      "    and 3 more tasks ('cbc graph --view together' shows all)\n"),
            std::string::npos)
      << text;
}

/// Any task may be requested where none waits for a request.
TEST(LintSummary, CountsPairsOfAllTasks) {
  const CompiledCatalog catalog = test::compile_text(R"(default_values:
  tasks: {start_on_request: FALSE}
behaviors: [{behavior: a, task: A}, {behavior: b, task: B}, {behavior: c, task: C}]
)");
  LintedFile file{"a.yaml", "", {}, summarize(catalog)};
  file.together = summarize_together(catalog, LintOptions().max_nodes);
  EXPECT_NE(lint_summary(file, plain_style()).find("  pairs of tasks             3\n"),
            std::string::npos);
}

TEST(LintJson, HasTasksThatCanRunTogether) {
  const CompiledCatalog catalog = test::compile_text(R"(default_values:
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
  LintedFile file{"a.yaml", "", {}, summarize(catalog)};
  EXPECT_FALSE(
      nlohmann::json::parse(lint_json({file}))["files"][0]["summary"].contains("together"));
  file.together = summarize_together(catalog, LintOptions().max_nodes);
  EXPECT_EQ(nlohmann::json::parse(lint_json({file}))["files"][0]["summary"]["together"],
            nlohmann::json::parse(R"({
    "all_tasks": false,
    "tasks": ["HOVER", "BLINK", "LAND", "MOVE"], "never_run": ["SPIN"],
    "possible": [["HOVER", "BLINK"], ["BLINK", "LAND"], ["BLINK", "MOVE"]],
    "excluded": 1, "excluded_indirectly": 2, "excluded_in_each_situation": 0,
    "excluded_by_situation": 0, "undecided": 0})"));
}

}  // namespace
}  // namespace cbc::together_report_test
