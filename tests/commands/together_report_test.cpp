// The table of tasks that can run together, where it is large, limited or hostile.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ask/together.h"
#include "graph/report/tables.h"
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

}  // namespace
}  // namespace cbc::together_report_test
