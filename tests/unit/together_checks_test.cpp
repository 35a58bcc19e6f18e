// The rules never-started, blocked-reactive and can-run-together.
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/check/severity_settings.h"
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
