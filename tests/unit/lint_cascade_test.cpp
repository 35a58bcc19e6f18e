#include <string>

#include <gtest/gtest.h>

#include "lint/lint.h"
#include "unit/findings.h"

// What could not be understood is not judged: one fault gives one finding.

namespace cbc {
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
  // By default the task would achieve a goal, and by its own word it starts reactively.
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

TEST(LintCascade, EntriesOfTasksThatCouldNotBeRead) {
  constexpr const char* behaviors =
      "behaviors:\n"
      "- {behavior: A, task: X, requires: [{task: Y}]}\n"
      "- {behavior: B, task: Y}\n";
  EXPECT_EQ(
      findings(std::string("tasks: [{task: X}, {execution_goal: keep_running}]\n") + behaviors),
      "1:20-21 error missing-key: missing key 'task' in a task\n");
  EXPECT_EQ(findings(std::string("tasks: [{task: X}]\n"
                                 "tasks: [{task: Y, execution_goal: keep_running}]\n") +
                     behaviors),
            "2:1-6 error duplicate-key: 'tasks' is given twice\n"
            "  1:1-6 first given here\n");
}

TEST(LintCascade, TasksOfABehaviorThatCouldNotBeRead) {
  EXPECT_EQ(findings("tasks: [{task: X, execution_goal: keep_running}, {task: Y}]\n"
                     "behaviors:\n"
                     "- {behavior: A, timeout: 3, tasks: [{task: X}, {suitability: 80}]}\n"),
            "3:48-49 error missing-key: missing key 'task' in a task of a behavior\n");
}

TEST(LintCascade, ExclusivityListsWithUndefinedNames) {
  constexpr const char* behaviors =
      "tasks: [{task: X}, {task: Y}]\n"
      "behaviors: [{behavior: A, task: X}, {behavior: B, task: Y}]\n"
      "exclusivity_constraints:\n"
      "- mutually_exclusive: [X, Y]\n";
  EXPECT_EQ(findings(std::string(behaviors) + "- mutually_exclusive: [X, MOON]\n"),
            "5:27-31 error undefined-task: task 'MOON', named in an exclusivity list, is not "
            "defined\n");
  EXPECT_EQ(findings(std::string(behaviors) + "- mutually_exclusive: [X, Y, []]\n"),
            "5:30-31 error wrong-type: 'mutually_exclusive' must be a list of names of tasks, "
            "found an empty list\n");
}

}  // namespace
}  // namespace cbc
