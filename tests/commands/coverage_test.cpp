// What the reports of coverage say, and how they are merged.
#include "coverage/coverage.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "coverage/engine/goals.h"
#include "coverage/report/coverage_report.h"
#include "unit/compiled_fixture.h"

namespace cbc::coverage_test {
namespace {

constexpr std::string_view robot = R"(
situation:
- {variable: LIGHT, values: [day, night]}
behaviors:
- {behavior: DRIVE_FAST, task: DRIVE, suitability: 90, situation: {LIGHT: day},
   requires: [{task: LOCALIZE, minimum_performance: 80}]}
- {behavior: DRIVE_SLOWLY, task: DRIVE, suitability: 50, timeout: 20}
- {behavior: GPS, task: LOCALIZE}
- {behavior: ODOMETRY, task: LOCALIZE, suitability: 60}
- {behavior: DOCK_NOW, task: DOCK}
- {behavior: BLINK_ON, task: BLINK}
- {behavior: BEEP_NOW, task: BEEP}
tasks:
- {task: DRIVE}
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- {task: DOCK, timeout: 10}
- {task: BLINK, reactive_start: true, execution_goal: keep_running}
- {task: BEEP}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, DOCK]
- mutually_exclusive: [DOCK, BLINK]
)";

TEST(CoverageCount, RoundsDown) {
  EXPECT_EQ(describe_percent({3, 2}), "66.6 %");
  EXPECT_EQ(describe_percent({100'000, 99'999}), "99.9 %");
  EXPECT_EQ(describe_percent({7, 7}), "100.0 %");
  EXPECT_EQ(describe_percent({}), "\u2013");
}

CatalogCoverage coverage_of(std::string_view text) {
  auto catalog = std::make_shared<const CompiledCatalog>(test::compile_text(text));
  std::vector<Goal> goals = find_goals(*catalog);
  return {std::move(catalog), std::string(text), std::move(goals)};
}

TEST(CoverageMerge, CountsAMissionOnce) {
  CatalogCoverage one = coverage_of(robot);
  std::vector<std::uint8_t> met(one.goals().size(), 0);
  met[0] = 1;
  one.add("a.yaml", met);
  met[1] = 1;
  one.add("b.yaml", met);
  const std::string json = coverage_to_json({{one}});
  CatalogCoverage other = coverage_of(robot);
  met[0] = 0;
  met[2] = 1;
  other.add("b.yaml", met);
  ASSERT_EQ(add_coverage_json(json, other), "");
  ASSERT_EQ(add_coverage_json(json, other), "") << "twice is as once";
  EXPECT_EQ(other.missions(), (std::vector<std::string>{"b.yaml", "a.yaml"}));
  EXPECT_EQ(other.missions_of(0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(other.missions_of(1), std::vector<std::uint32_t>{0});
  EXPECT_EQ(other.missions_of(2), std::vector<std::uint32_t>{0});
  EXPECT_FALSE(other.is_met(3));
}

TEST(CoverageMerge, SaysWhatIsWrong) {
  const std::string json = coverage_to_json({{coverage_of(robot)}});
  const auto fault = [](std::string text, const std::string& from = "",
                        const std::string& to = "") {
    CatalogCoverage coverage = coverage_of(robot);
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return add_coverage_json(text, coverage);
  };
  EXPECT_EQ(fault(json), "");
  EXPECT_NE(fault("{").find("it is not JSON"), std::string::npos);
  EXPECT_EQ(fault("[]"), "it is not an object");
  EXPECT_EQ(fault(json, "cbc.coverage/1", "cbc.sweep/1"), "its schema is not 'cbc.coverage/1'");
  EXPECT_NE(fault(json, "\"task\":\"DRIVE\"", "\"task\":\"FLY\"").find("does not know"),
            std::string::npos);
  EXPECT_NE(fault(json, "\"met_by\":[]", "\"met_by\":[\"x\"]").find("does not have 'x'"),
            std::string::npos);
  EXPECT_NE(fault(json, "\"digest\":\"", "\"digest\":\"0").find("another version"),
            std::string::npos);
  EXPECT_EQ(fault(json, "\"catalog\":\"", "\"catalog\":\"elsewhere/"), "")
      << "the text is the same";
  EXPECT_NE(fault(R"({"schema":"cbc.coverage/1","catalogs":[]})").find("it has nothing about"),
            std::string::npos);
}

}  // namespace
}  // namespace cbc::coverage_test
