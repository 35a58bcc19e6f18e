#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/diagnostic/rules.h"
#include "unit/findings.h"

// What could not be understood is not judged: one fault gives one finding.

namespace cbc::lint_cascade_test {
namespace {

std::string findings(const std::string& text) {
  Diagnostics diagnostics;
  if (const auto document = yaml::parse(text, "a.yaml", diagnostics)) {
    static_cast<void>(lint_catalog(*document, {}, diagnostics));
  }
  return show(diagnostics);
}

TEST(LintCascade, AttributesThatCouldNotBeRead) {
  constexpr const char* behaviors =
      "behaviors:\n"
      "- {behavior: A, task: X, requires: [{task: Y}]}\n"
      "- {behavior: B, task: Y, timeout: 3}\n";
  // The task has achieve_goal by default, and says itself that it starts reactively.
  EXPECT_EQ(findings(std::string("tasks:\n"
                                 "- task: X\n"
                                 "- {task: Y, execution_goal: forever, reactive_start: TRUE}\n") +
                     behaviors),
            "3:29-36 error invalid-value: 'execution_goal' must be achieve_goal or keep_running, "
            "found 'forever'\n");
  EXPECT_EQ(findings(std::string("default_values: {tasks: {start_on_request: 3, "
                                 "reactive_start: TRUE, execution_goal: keep_running}}\n"
                                 "tasks: [{task: X}, {task: Y}]\n") +
                     behaviors),
            "1:44-45 error wrong-type: 'start_on_request' must be true or false, found '3'\n");
}

// A_WITH_WINGS may have been meant to perform A, but hardly G.
TEST(LintCascade, OtherFaultsAreFoundBesideABehaviorWithoutTask) {
  EXPECT_EQ(findings("behaviors:\n- {behavior: A_WITH_WINGS}\ntasks: [{task: A}, {task: G}]\n"),
            "2:14-26 error missing-key: missing key 'task' in behavior 'A_WITH_WINGS'\n"
            "3:27-28 warning task-without-behavior: no behavior performs task 'G'\n");
}

/// What is found if findings of exclusive-requirement are not reported.
std::string findings_behind(const std::string& text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "a.yaml", diagnostics);
  LintOptions options;
  options.control = [](std::vector<Diagnostic> all) {
    std::erase_if(all, [](const Diagnostic& finding) {
      return finding.rule == rule::exclusive_requirement.name;
    });
    return all;
  };
  static_cast<void>(lint_catalog(*document, options, diagnostics));
  std::string rules;
  for (const Diagnostic& finding : diagnostics.all()) {
    rules += std::to_string(finding.range.begin.line) + " " + std::string(finding.rule) + "\n";
  }
  return rules;
}

TEST(LintCascade, WhatIsBehindAnAllowedFinding) {
  const std::string others =
      "- {behavior: B, task: Y}\n"
      "- {behavior: C, task: Z}\n"
      "default_values: {tasks: {execution_goal: keep_running, start_on_request: FALSE}}\n"
      "tasks: [{task: X, start_on_request: TRUE}, {task: Y}, {task: Z, start_on_request: TRUE}]\n"
      "exclusivity_constraints: [{mutually_exclusive: [X, Y, Z]}]\n";
  // The only behavior of its task, one of two, and one with two such requirements.
  EXPECT_EQ(findings_behind("behaviors:\n"
                            "- {behavior: A, task: X, requires: [{task: Y}]}\n" +
                            others),
            "2 exclusive-requirement\n6 dead-task\n");
  EXPECT_EQ(findings_behind("behaviors:\n"
                            "- {behavior: A, task: X, requires: [{task: Y}]}\n"
                            "- {behavior: D, task: X}\n" +
                            others),
            "2 exclusive-requirement\n2 dead-behavior\n");
  EXPECT_EQ(findings_behind("behaviors:\n"
                            "- {behavior: A, task: X, requires: [{task: Y}, {task: Z}]}\n"
                            "- {behavior: D, task: X}\n" +
                            others),
            "2 exclusive-requirement\n2 exclusive-requirement\n2 conflicting-requirements\n");
}

TEST(LintCascade, GoalsThatAreNotGiven) {
  const auto is_off = [](const std::string& tasks) {
    const std::string text =
        "behaviors:\n"
        "- {behavior: A, task: X, requires: [{task: Y}]}\n"
        "- {behavior: B, task: Y}\n" +
        tasks;
    Diagnostics diagnostics;
    const auto document = yaml::parse(text, "a.yaml", diagnostics);
    static_cast<void>(lint_catalog(*document, {.depth = CheckDepth::rules}, diagnostics));
    EXPECT_EQ(diagnostics.all().size(), 1U);
    EXPECT_EQ(diagnostics.all().front().rule, rule::required_goal.name);
    return diagnostics.all().front().is_off;
  };
  EXPECT_TRUE(is_off("tasks: [{task: X}, {task: Y}]\n"));
  EXPECT_FALSE(is_off("tasks: [{task: X}, {task: Y, execution_goal: achieve_goal}]\n"));
  EXPECT_FALSE(is_off("tasks: [{task: X, execution_goal: keep_running}, {task: Y}]\n"));
  EXPECT_FALSE(
      is_off("default_values: {tasks: {execution_goal: achieve_goal}}\n"
             "tasks: [{task: X}, {task: Y}]\n"));
}

/// A chain of tasks, each of which requires the next one. `more`: constraints.
std::string chain_of(int length, const std::string& more) {
  std::string text =
      "default_values: {tasks: {start_on_request: false, execution_goal: keep_running}}\n"
      "behaviors:\n";
  for (int task = 0; task < length; ++task) {
    text += "- {behavior: B" + std::to_string(task) + ", task: T" + std::to_string(task);
    if (task + 1 < length) text += ", requires: [{task: T" + std::to_string(task + 1) + "}]";
    text += "}\n";
  }
  text += "tasks:\n- {task: T0, start_on_request: true}\n";
  for (int task = 1; task < length; ++task) text += "- task: T" + std::to_string(task) + "\n";
  return text + more;
}

// What takes time or memory with the square of the length ends at a limit, with a note.

TEST(LintCascade, LongChainsAreDecided) { EXPECT_EQ(findings(chain_of(30'000, "")), ""); }

TEST(LintCascade, LongChainsAboveADeadTaskHaveOneFinding) {
  constexpr int length = 30'000;
  const std::string shown = findings(
      chain_of(length, "exclusivity_constraints:\n- mutually_exclusive: [T15000, T15002]\n"));
  EXPECT_EQ(shown,
            "45004:9-15 warning dead-task: task 'T15000' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  15003:54-60 behavior 'B15000' requires 'T15001'\n"
            "  15004:54-60 behavior 'B15001' requires 'T15002'\n"
            "  60005:3-21 'T15000' excludes 'T15002'\n");
}

}  // namespace
}  // namespace cbc::lint_cascade_test
