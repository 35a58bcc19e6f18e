// Each kind of goal: a mission that meets it, and one that just misses it.
#include "coverage/engine/coverage.h"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_monitor.h"
#include "coverage/engine/goals.h"
#include "coverage/report/coverage_report.h"
#include "unit/compiled_fixture.h"

namespace cbc::coverage_test {
namespace {

using Texts = std::set<std::string>;

class Watched final : public RunListener {
 public:
  explicit Watched(GoalMonitor& watch) : watch_(watch) {}
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    watch_.on_decision(record, circumstances, solution);
  }
  void on_event(const EventRecord& record, const Step* /*step*/, const State& state) override {
    watch_.on_event(record, state);
  }

 private:
  GoalMonitor& watch_;
};

struct Mission {
  Texts met;
  std::uint64_t solved = 0;
};

Mission run_mission(const CompiledCatalog& catalog, std::string_view script_text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(script_text, "script.yaml", diagnostics);
  const auto script = read_script(*document, catalog, Severity::warning, diagnostics);
  EXPECT_TRUE(script.has_value());
  const std::vector<Goal> goals = find_goals(catalog);
  GoalMonitor watch(catalog, goals, {});
  State first(catalog);
  first.change_situation(script->situation.availability, script->situation.variables);
  watch.begin(first);
  Watched watched(watch);
  static_cast<void>(run_script(catalog, *script, {}, watched));
  Mission mission;
  for (std::size_t goal = 0; goal < goals.size(); ++goal) {
    if (watch.met()[goal] != 0) mission.met.insert(describe(catalog, goals[goal]));
  }
  mission.solved = watch.solved();
  return mission;
}

Texts goals_of(const CompiledCatalog& catalog) {
  Texts texts;
  for (const Goal& goal : find_goals(catalog)) texts.insert(describe(catalog, goal));
  return texts;
}

/// The first script meets the goal, the second one does not.
void expect_tells_apart(std::string_view catalog_text, const std::string& goal,
                        std::string_view meets, std::string_view misses) {
  const CompiledCatalog catalog = test::compile_text(catalog_text);
  ASSERT_TRUE(goals_of(catalog).contains(goal)) << goal;
  EXPECT_TRUE(run_mission(catalog, meets).met.contains(goal)) << goal;
  EXPECT_FALSE(run_mission(catalog, misses).met.contains(goal)) << goal;
}

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

TEST(Goals, AreThoseOfTheCatalog) {
  EXPECT_EQ(goals_of(test::compile_text(robot)).size(),
            find_goals(test::compile_text(robot)).size());
  const Texts goals = goals_of(test::compile_text(robot));
  for (const char* const senseless :
       {"behavior GPS achieved its goal", "behavior DOCK_NOW was replaced",
        "task DRIVE ran into its timeout", "behavior GPS began to fit the situation",
        "a start of BEEP displaced a lower priority",
        "a start of LOCALIZE displaced a lower priority", "task DRIVE started by itself"}) {
    EXPECT_FALSE(goals.contains(senseless)) << senseless;
  }
  // Tasks; active, failed, succeeded, replaced; requirements, minimum, pairs, timeouts; reactive,
  // values, fitting; priorities.
  EXPECT_EQ(goals.size(), 5U + 7 + 7 + 4 + 4 + 2 + 1 + 2 + 2 + 3 + 2 + 2 + 3 * 2);
}

TEST(Goals, OfTasksAndBehaviors) {
  expect_tells_apart(robot, "task DOCK ran", "- start: DOCK", "- {start: DRIVE}");
  expect_tells_apart(robot, "task LOCALIZE ran", "- start: DRIVE",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}]");
  expect_tells_apart(robot, "behavior DRIVE_SLOWLY was active",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}]", "- start: DRIVE");
  expect_tells_apart(robot, "behavior DOCK_NOW achieved its goal",
                     "[{start: DOCK}, {finish: DOCK_NOW}]", "[{start: DOCK}, {stop: DOCK}]");
  expect_tells_apart(robot, "behavior DOCK_NOW failed",
                     "[{start: DOCK}, {finish: DOCK_NOW, cause: wrong_progress}]",
                     "[{start: DOCK}, {finish: DOCK_NOW, cause: situation_change}]");
  expect_tells_apart(robot, "behavior DOCK_NOW failed", "[{fault: DOCK_NOW}, {start: DOCK}]",
                     "[{start: DOCK}, {fault: DOCK_NOW}]");
  expect_tells_apart(robot, "behavior DRIVE_FAST was replaced",
                     "[{start: DRIVE}, {finish: DRIVE_FAST, cause: process_failure}]",
                     "[{start: DRIVE}, {stop: DRIVE}]");
}

TEST(Goals, OfRequirements) {
  const std::string used = "DRIVE_FAST was active with LOCALIZE, which it requires";
  const std::string matters = "it matters that DRIVE_FAST requires LOCALIZE";
  expect_tells_apart(robot, used, "- start: DRIVE",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}]");
  expect_tells_apart(robot, matters, "- start: DRIVE",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}]");
  // With a request of its own the required task runs all the same.
  expect_tells_apart(robot, matters, "- start: DRIVE", "[{start: LOCALIZE}, {start: DRIVE}]");
  EXPECT_TRUE(run_mission(test::compile_text(robot), "[{start: LOCALIZE}, {start: DRIVE}]")
                  .met.contains(used));
}

TEST(Goals, OfMinimums) {
  expect_tells_apart(robot, "the minimum that DRIVE_FAST requires of LOCALIZE matters",
                     "[{situation: {GPS: false}}, {start: DRIVE}]", "- start: DRIVE");
  expect_tells_apart(R"(
behaviors: [{behavior: GPS, task: LOCALIZE, suitability: 70}, {behavior: SLAM, task: LOCALIZE}]
tasks: [{task: LOCALIZE, minimum_performance: 80}]
)",
                     "the minimum of LOCALIZE matters",
                     "[{situation: {SLAM: false}}, {start: LOCALIZE}]", "- start: LOCALIZE");
}

TEST(Goals, OfExclusions) {
  const std::string goal = "it matters that DRIVE excludes DOCK";
  expect_tells_apart(robot, goal, "[{start: DRIVE}, {start: DOCK}]",
                     "[{start: DRIVE}, {stop: DRIVE}, {start: DOCK}]");
  expect_tells_apart(robot, goal, "[{start: DRIVE, priority: 2}, {start: DOCK}]",
                     "[{start: DRIVE, priority: 2}, {finish: DRIVE_FAST}, {start: DOCK}]");
  // Two lists that do the same: neither alone makes a difference.
  const CompiledCatalog twice = test::compile_text(R"(
behaviors:
- {behavior: A_BY, task: A, requires: [{task: S}]}
- {behavior: B_BY, task: B}
- {behavior: S_BY, task: S}
tasks: [{task: A}, {task: B}, {task: S, start_on_request: false}]
exclusivity_constraints: [{mutually_exclusive: [A, B]}, {mutually_exclusive: [S, B]}]
)");
  const Texts met = run_mission(twice, "[{start: A}, {start: B}]").met;
  EXPECT_FALSE(met.contains("it matters that A excludes B"));
  EXPECT_FALSE(met.contains("it matters that B excludes S"));
}

TEST(Goals, OfTimeouts) {
  expect_tells_apart(robot, "task DOCK ran into its timeout", "[{start: DOCK}, {wait: 10.1}]",
                     "[{start: DOCK}, {wait: 9.9}]");
  expect_tells_apart(robot, "task DOCK ran into its timeout", "[{start: DOCK}, {wait: 10.1}]",
                     "[{start: DOCK}, {finish: DOCK_NOW, cause: time_out}]");
  expect_tells_apart(robot, "behavior DRIVE_SLOWLY ran into its timeout",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}, {wait: 21}]",
                     "[{start: DRIVE}, {wait: 21}]");
}

TEST(Goals, OfReactiveTasks) {
  expect_tells_apart(robot, "task BLINK started by itself", "- wait: 1", "- start: BLINK");
  expect_tells_apart(robot, "task BLINK gave way", "[{wait: 1}, {start: DOCK}]",
                     "[{wait: 1}, {stop: BLINK}, {start: DOCK}]");
  const std::string returned = "task BLINK returned by itself after it gave way";
  expect_tells_apart(robot, returned, "[{wait: 1}, {start: DOCK}, {stop: DOCK}, {wait: 1}]",
                     "[{wait: 1}, {start: DOCK}, {stop: DOCK}]");
  expect_tells_apart(robot, returned, "[{wait: 1}, {start: DOCK}, {stop: DOCK}, {wait: 1}]",
                     "[{start: DOCK}, {stop: DOCK}, {wait: 1}]");
}

TEST(Goals, OfTheSituation) {
  expect_tells_apart(robot, "LIGHT was night", "- situation: {LIGHT: night}", "- start: DRIVE");
  expect_tells_apart(robot, "LIGHT was day", "- start: DRIVE",
                     "{situation: {LIGHT: night}, events: [{start: DRIVE}]}");
  expect_tells_apart(robot, "behavior DRIVE_FAST began to fit the situation",
                     "[{situation: {LIGHT: night}}, {situation: {LIGHT: day}}]",
                     "- situation: {LIGHT: night}");
  expect_tells_apart(robot, "behavior DRIVE_FAST ceased to fit while active",
                     "[{start: DRIVE}, {situation: {LIGHT: night}}]",
                     "[{situation: {LIGHT: night}}, {start: DRIVE}]");
}

TEST(Goals, OfPriorities) {
  expect_tells_apart(robot, "a start of DOCK displaced a lower priority",
                     "[{start: DRIVE}, {start: DOCK, priority: 2}]",
                     "[{start: DRIVE}, {start: DOCK}]");
  expect_tells_apart(robot, "a start of DOCK displaced an equal priority",
                     "[{start: DRIVE}, {start: DOCK}]",
                     "[{start: DRIVE}, {start: DOCK, priority: 2}]");
  const std::string rejected = "a start of DOCK was rejected for a higher priority";
  expect_tells_apart(robot, rejected, "[{start: DRIVE, priority: 2}, {start: DOCK}]",
                     "[{start: DRIVE}, {start: DOCK}]");
  // Rejected, but whatever the priority: and its own request is not another task's.
  expect_tells_apart(
      robot, rejected, "[{start: DRIVE, priority: 2}, {start: DOCK}]",
      "[{situation: {DOCK_NOW: false}}, {start: DRIVE, priority: 2}, {start: DOCK}]");
  expect_tells_apart(robot, rejected, "[{start: DRIVE, priority: 2}, {start: DOCK}]",
                     "[{start: DOCK, priority: 2}, {start: DOCK}]");
}

TEST(Goals, AskOnlyWhereAConstraintMayMatter) {
  // DOCK cannot run, as it starts on request only. What remains are the requirement of DRIVE_FAST,
  // its minimum, and DRIVE with DOCK at the second event.
  const CompiledCatalog catalog = test::compile_text(robot);
  EXPECT_EQ(run_mission(catalog, "- start: DRIVE").solved, 2U);
  EXPECT_EQ(run_mission(catalog, "- start: BEEP").solved, 0U);
}

TEST(Goals, HaveLines) {
  Diagnostics diagnostics;
  const auto source = read_catalog(R"(behaviors:
- behavior: A_BY
  task: A
  timeout: 5
  requires:
  - task: S
    minimum_performance: 50
- behavior: B_BY
  task: B
  situation: {V: true}
- {behavior: S_BY, task: S}
tasks:
- task: A
- task: B
  timeout: 3
- task: S
  minimum_performance: 10
exclusivity_constraints:
- mutually_exclusive:
  - A
  - B
situation:
- variable: V
)",
                                   "catalog.yaml", diagnostics);
  ASSERT_TRUE(source.has_value());
  const CompiledCatalog catalog = compile(*source);
  std::vector<Goal> goals = find_goals(catalog);
  add_lines(*source, catalog, goals);
  std::map<std::string, std::vector<std::uint32_t>> lines;
  for (const Goal& goal : goals) lines[describe(catalog, goal)] = goal.lines;
  using Lines = std::vector<std::uint32_t>;
  EXPECT_EQ(lines.at("task B ran"), Lines{14});
  EXPECT_EQ(lines.at("behavior A_BY failed"), Lines{2});
  EXPECT_EQ(lines.at("it matters that A_BY requires S"), Lines{6});
  EXPECT_EQ(lines.at("the minimum that A_BY requires of S matters"), Lines{7});
  EXPECT_EQ(lines.at("the minimum of S matters"), Lines{17});
  EXPECT_EQ(lines.at("it matters that A excludes B"), (Lines{20, 21}));
  EXPECT_EQ(lines.at("behavior A_BY ran into its timeout"), Lines{4});
  EXPECT_EQ(lines.at("task B ran into its timeout"), Lines{15});
  EXPECT_EQ(lines.at("V was true"), Lines{23});
  EXPECT_EQ(lines.at("behavior B_BY began to fit the situation"), Lines{10});
}

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

TEST(CoverageFormats, FollowTheEndOfTheName) {
  EXPECT_EQ(coverage_format_of("a/b.json").name, "json");
  EXPECT_EQ(coverage_format_of("coverage.html").name, "html");
  EXPECT_EQ(coverage_format_of("coverage.info").name, "lcov");
  EXPECT_EQ(coverage_format_of("coverage.lcov").name, "lcov");
  EXPECT_EQ(coverage_format_of("coverage.txt").name, "text");
  EXPECT_EQ(coverage_format_of("json").name, "text");
}

}  // namespace
}  // namespace cbc::coverage_test
