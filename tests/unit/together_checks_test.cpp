// The rules never-started, blocked-reactive and can-run-together.
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/check/controls.h"
#include "core/yaml/document.h"
#include "unit/findings.h"

namespace cbc::together_checks_test {
namespace {

std::string lint(std::string_view yaml, std::string_view settings_text = "",
                 std::uint64_t max_nodes = LintOptions().max_nodes) {
  Diagnostics diagnostics;
  const SeveritySettings settings =
      read_settings(settings_text, ".cbc.yaml", diagnostics).value_or(SeveritySettings());
  const auto document = yaml::parse(yaml, "a.yaml", diagnostics);
  EXPECT_TRUE(document) << show(diagnostics);
  if (!document) return {};
  LintOptions options;
  options.max_nodes = max_nodes;
  options.never_together = settings.never_together();
  static_cast<void>(lint_catalog(*document, options, diagnostics));
  return show(diagnostics);
}

TEST(NeverStarted, IsATaskThatOnlyARequestStarts) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C}
- {behavior: d, task: D}
tasks:
- {task: A, start_on_request: FALSE, execution_goal: keep_running}
- {task: B}
- {task: C, start_on_request: FALSE, execution_goal: keep_running}
- {task: D, reactive_start: TRUE}
)"),
            "7:10-11 warning never-started: task 'A' never starts without a request: "
            "start_on_request is false, but it has no reactive_start, and no behavior requires "
            "it\n");
}

TEST(NeverStarted, IsReportedOnceWhereAllTasksAreLikeThat) {
  EXPECT_EQ(lint(R"(default_values: {tasks: {start_on_request: FALSE}}
behaviors: [{behavior: a, task: A}, {behavior: b, task: B}, {behavior: c, task: C}]
tasks: [{task: A}, {task: B}, {task: C}]
)"),
            "3:16-17 warning never-started: task 'A' never starts without a request: "
            "start_on_request is false, but it has no reactive_start, and no behavior requires it; "
            "the same is true of 2 other tasks\n");
}

TEST(NeverStarted, IsNotReportedWhereARequirementMayNotHaveBeenUnderstood) {
  const std::string findings = lint(R"(behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B, requires: [{task: AA}]}
tasks: [{task: A, start_on_request: FALSE}, {task: B}]
)");
  EXPECT_NE(findings.find("undefined-task"), std::string::npos);
  EXPECT_EQ(findings.find("never-started"), std::string::npos);
}

const std::string hovering = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: PID}]}
- {behavior: FLY_TAKE_OFF, task: TAKE_OFF, requires: [{task: DF}]}
- {behavior: FLY_LAND, task: LAND, requires: [{task: DF}]}
- {behavior: PID_CONTROLLER, task: PID}
- {behavior: DF_CONTROLLER, task: DF}
- {behavior: BLINK, task: BLINK}
tasks:
- {task: HOVER, reactive_start: TRUE}
- {task: TAKE_OFF, start_on_request: TRUE}
- {task: LAND, start_on_request: TRUE}
- {task: BLINK, start_on_request: TRUE}
- task: PID
- task: DF
exclusivity_constraints:
- mutually_exclusive: [PID, DF]
)";

TEST(BlockedReactive, HasTheChainBetweenTheTasks) {
  EXPECT_EQ(lint(hovering),
            "11:10-15 note blocked-reactive: reactive task 'HOVER' cannot run beside 'TAKE_OFF' or "
            "'LAND', though no exclusivity list says so: what they require does\n"
            "  4:61-64 behavior 'HOVER_WITH_PID' requires 'PID'\n"
            "  5:62-64 behavior 'FLY_TAKE_OFF' requires 'DF'\n"
            "  6:54-56 behavior 'FLY_LAND' requires 'DF'\n"
            "  18:3-21 'PID' excludes 'DF'\n");
}

TEST(BlockedReactive, IsNotWhatAListSays) {
  EXPECT_EQ(lint(hovering + "- mutually_exclusive: [HOVER, LAND, TAKE_OFF]\n"), "");
}

TEST(BlockedReactive, HasAnotherWay) {
  std::string text = hovering;
  text.insert(
      text.find("- {behavior: FLY_TAKE_OFF"),
      "- {behavior: HOVER_WITH_DF, task: HOVER, requires: [{task: DF}], suitability: 50}\n");
  EXPECT_EQ(lint(text), "");
}

TEST(BlockedReactive, IsNotADeadTask) {
  // HOVER can never run at all, which is another finding.
  const std::string findings = lint(R"(behaviors:
- {behavior: hover, task: HOVER, requires: [{task: PID}, {task: DF}]}
- {behavior: pid, task: PID}
- {behavior: df, task: DF}
- {behavior: land, task: LAND, requires: [{task: DF}]}
default_values: {tasks: {execution_goal: keep_running, start_on_request: FALSE}}
tasks:
- {task: HOVER, reactive_start: TRUE}
- task: PID
- task: DF
- {task: LAND, start_on_request: TRUE}
exclusivity_constraints:
- mutually_exclusive: [PID, DF]
)");
  EXPECT_NE(findings.find("conflicting-requirements"), std::string::npos);
  EXPECT_EQ(findings.find("blocked-reactive"), std::string::npos);
}

TEST(BlockedReactive, NamesFiveTasksOfMany) {
  std::string text =
      "default_values: {tasks: {execution_goal: keep_running}}\nbehaviors:\n"
      "- {behavior: h, task: H, requires: [{task: P}]}\n"
      "- {behavior: p, task: P}\n- {behavior: d, task: D}\n";
  std::string tasks =
      "tasks:\n- {task: H, reactive_start: TRUE}\n"
      "- {task: P, start_on_request: FALSE}\n"
      "- {task: D, start_on_request: FALSE}\n";
  for (const char* number : {"1", "2", "3", "4", "5", "6", "7"}) {
    text += std::string("- {behavior: t") + number + ", task: T" + number +
            ", requires: [{task: D}]}\n";
    tasks += std::string("- task: T") + number + "\n";
  }
  const std::string findings =
      lint(text + tasks + "exclusivity_constraints:\n- mutually_exclusive: [P, D]\n");
  EXPECT_NE(findings.find("'H' cannot run beside 'T1', 'T2', 'T3', 'T4', 'T5' or 2 more, though"),
            std::string::npos)
      << findings;
}

const std::string flying = R"(behaviors:
- {behavior: LAND_SLOWLY, task: LAND}
- {behavior: FOLLOW_WITH_PID, task: FOLLOW_PATH, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: LAND
- task: FOLLOW_PATH
- {task: LOCALIZE, start_on_request: FALSE, execution_goal: keep_running}
- task: HOVER
exclusivity_constraints:
- mutually_exclusive: [LAND, HOVER]
)";

TEST(CanRunTogether, TasksOfDifferentGroups) {
  EXPECT_EQ(lint(flying, "never_together:\n- [LAND, FOLLOW_PATH]\n"),
            "7:9-13 error can-run-together: 'LAND' can run beside 'FOLLOW_PATH': 'LAND' with "
            "'LAND_SLOWLY', 'FOLLOW_PATH' with 'FOLLOW_WITH_PID'\n"
            "  8:9-20 'FOLLOW_PATH' is defined here\n"
            "  2:4-21 these tasks must never run together\n");
}

TEST(CanRunTogether, IsDecidedForEachTwoTasksOfAList) {
  // LAND and LOCALIZE exclude one another here, so FOLLOW_PATH never runs beside LAND.
  EXPECT_EQ(lint(flying + "- mutually_exclusive: [LAND, LOCALIZE]\n",
                 "never_together: [[HOVER, LAND, FOLLOW_PATH]]\n"),
            "10:9-14 error can-run-together: 'HOVER' can run beside 'FOLLOW_PATH': 'HOVER' with "
            "'HOVER_WITH_PID', 'FOLLOW_PATH' with 'FOLLOW_WITH_PID'\n"
            "  8:9-20 'FOLLOW_PATH' is defined here\n"
            "  1:19-43 these tasks must never run together\n");
}

TEST(CanRunTogether, IsNotAboutTasksOfDifferentSituations) {
  const std::string text = R"(situation: [{variable: LIGHT, values: [day, night]}]
behaviors:
- {behavior: a, task: A, situation: {LIGHT: day}}
- {behavior: b, task: B, situation: {LIGHT: night}}
- {behavior: b2, task: B, situation: {LIGHT: day}, suitability: 50}
tasks: [{task: A}, {task: B}]
)";
  EXPECT_EQ(lint(text, "never_together: [[A, B]]\n"),
            "6:16-17 error can-run-together: 'A' can run beside 'B': 'A' with 'a', 'B' with 'b2'\n"
            "  6:27-28 'B' is defined here\n"
            "  1:19-23 these tasks must never run together\n");
  std::string without = text;
  without.erase(without.find("- {behavior: b2"),
                text.find("tasks:") - text.find("- {behavior: b2"));
  EXPECT_EQ(lint(without, "never_together: [[A, B]]\n"), "");
}

TEST(CanRunTogether, SaysWhetherATaskOrABehaviorIsMeant) {
  EXPECT_EQ(lint("behaviors: [{behavior: LAND, task: LAND}, {behavior: BLINK, task: SIGNAL}]\n"
                 "tasks: [{task: LAND}, {task: SIGNAL}]\n",
                 "never_together: [[LAND, SIGNAL]]\n"),
            "2:16-20 error can-run-together: task 'LAND' can run beside 'SIGNAL': task 'LAND' with "
            "behavior 'LAND', 'SIGNAL' with 'BLINK'\n"
            "  2:30-36 'SIGNAL' is defined here\n"
            "  1:19-31 these tasks must never run together\n");
}

TEST(CanRunTogether, PassesOverNamesOfOtherCatalogs) {
  EXPECT_EQ(lint(flying, "never_together: [[LAND, DIVE], [DIVE, DOCK]]\n"), "");
}

}  // namespace
}  // namespace cbc::together_checks_test
