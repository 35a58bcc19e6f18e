#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "unit/findings.h"

namespace cbc::catalog_reader_test {
namespace {

std::string findings(std::string_view text) {
  Diagnostics diagnostics;
  const auto catalog = read_catalog(text, "a.yaml", diagnostics);
  EXPECT_EQ(catalog.has_value(), !diagnostics.has_errors()) << text;
  return show(diagnostics);
}

// A catalog that is expected to have no errors.
Catalog read(std::string_view text) {
  Diagnostics diagnostics;
  auto catalog = read_catalog(text, "a.yaml", diagnostics);
  EXPECT_TRUE(catalog.has_value()) << show(diagnostics);
  return catalog.value_or(Catalog{});
}

// Tasks and what performs them, in the order of the catalog.
std::string describe(const Catalog& catalog) {
  std::string text;
  for (const Task& task : catalog.tasks) {
    text += "task " + task.name + (task.implicit ? " implicit" : "") +
            (task.start_on_request ? " on_request" : "");
    if (task.timeout) text += " timeout " + std::to_string(*task.timeout);
    for (const Parameter& parameter : task.parameters) text += " " + parameter.name + "()";
    text += "\n";
  }
  for (const Behavior& behavior : catalog.behaviors) {
    text += "behavior " + behavior.name;
    for (const Performance& performance : behavior.performs) {
      text += " performs " + catalog.tasks[performance.task].name + " " +
              std::to_string(performance.suitability);
    }
    text += "\n";
  }
  return text;
}

// What is read ---------------------------------------------------------------------------------

TEST(CatalogReader, DefaultsMayBeMappings) {
  EXPECT_EQ(describe(read("default_values: {tasks: {timeout: 3, start_on_request: no}, behaviors: "
                          "{suitability: 60}}\nbehaviors: [{behavior: B, task: X}]\n")),
            "task X implicit timeout 3000000\nbehavior B performs X 600000\n");
  // Each key may have a list entry of its own.
  EXPECT_EQ(describe(read("default_values:\n- tasks:\n  - timeout: 3\n  - start_on_request: no\n"
                          "behaviors: [{behavior: B, task: X}]\n")),
            "task X implicit timeout 3000000\nbehavior B performs X 1000000\n");
}

TEST(CatalogReader, NullIsAbsent) {
  EXPECT_EQ(findings(R"(default_values: {tasks: {timeout: ~}, behaviors: {suitability: }}
behaviors:
- behavior: B
  task: X
  tasks: ~
  package:
  suitability: ~
  timeout: null
  requires:
tasks:
- task: X
  execution_goal:
  start_on_request:
  reactive_start: ~
  timeout:
  minimum_performance:
  parameters:
- task: Y
  parameters: [{parameter: a, allowed_values: }]
exclusivity_constraints: ~
)"),
            "");
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X}]\ntasks:\ndefault_values:\n"), "");
}

TEST(CatalogReader, KeysThatBeginWithXAreTheUsersOwn) {
  EXPECT_EQ(findings(R"(x-version: {a: [1]}
behaviors:
- behavior: B
  x-owner: me
  x-owner: you
  tasks: [{task: X, x-: 1}]
tasks:
- task: X
  x-: ~
)"),
            "");
}

TEST(CatalogReader, NamesAreAnyScalars) {
  EXPECT_EQ(
      describe(read("behaviors:\n- {behavior: 12, task: yes}\n- {behavior: 'null', task: é b}\n")),
      "task yes implicit on_request\ntask é b implicit on_request\n"
      "behavior 12 performs yes 1000000\nbehavior null performs é b 1000000\n");
  EXPECT_EQ(describe(read("behaviors: [{behavior: A, task: A}]")),
            "task A implicit on_request\nbehavior A performs A 1000000\n");
}

// Start flags ----------------------------------------------------------------------------------

// The flags of task X: R for start_on_request, A for reactive_start.
std::string flags(const std::string& defaults, const std::string& task) {
  const Catalog catalog = read("default_values: {tasks: {" + defaults +
                               "}}\nbehaviors: []\ntasks: [{task: X, " + task + "}]\n");
  if (catalog.tasks.empty()) return "error";
  return std::string(catalog.tasks[0].start_on_request ? "R" : "-") +
         (catalog.tasks[0].reactive_start ? "A" : "-");
}

TEST(CatalogReader, StartFlags) {
  EXPECT_EQ(flags("", ""), "R-");
  EXPECT_EQ(flags("", "reactive_start: TRUE"), "-A");
  EXPECT_EQ(flags("start_on_request: TRUE", "reactive_start: TRUE"), "-A");
  EXPECT_EQ(flags("start_on_request: FALSE", "reactive_start: FALSE"), "--");
  EXPECT_EQ(flags("start_on_request: FALSE", "start_on_request: TRUE"), "R-");
  EXPECT_EQ(flags("start_on_request: FALSE, reactive_start: TRUE", ""), "-A");
  EXPECT_EQ(flags("start_on_request: FALSE, reactive_start: TRUE", "reactive_start: FALSE"), "--");
  EXPECT_EQ(flags("start_on_request: TRUE, reactive_start: TRUE", "reactive_start: TRUE"), "-A");
  EXPECT_EQ(flags("start_on_request: TRUE, reactive_start: TRUE", "reactive_start: FALSE"), "R-");
  EXPECT_EQ(flags("reactive_start: TRUE", "start_on_request: FALSE"), "-A");
}

TEST(CatalogReader, OlderStartFlags) {
  EXPECT_EQ(flags("automatic_activation: FALSE, default: FALSE", "default: TRUE"), "-A");
  EXPECT_EQ(flags("", "automatic_activation: TRUE"), "--");
  EXPECT_EQ(flags("automatic_activation: TRUE", ""), "--");
  EXPECT_EQ(flags("automatic_activation: TRUE", "automatic_activation: FALSE"), "R-");
}

// Keys -----------------------------------------------------------------------------------------

TEST(CatalogReader, UnknownKeys) {
  EXPECT_EQ(findings("behaviors:\n- behavior: B\n  task: X\n  suitablity: 30\n  color: red\n"),
            "4:3-13 error unknown-key: unknown key 'suitablity' in behavior 'B'; did you mean "
            "'suitability'?\n"
            "5:3-8 warning unknown-key: unknown key 'color' in behavior 'B'\n");
  EXPECT_EQ(findings("behaviors: []\nTasks: []\n"),
            "2:1-6 error unknown-key: unknown key 'Tasks' in a catalog; did you mean 'tasks'?\n");
  // An older name is no suggestion.
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, eficacy: 3}]\n"),
            "1:36-43 error unknown-key: unknown key 'eficacy' in behavior 'B'; did you mean "
            "'suitability'?\n");
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, package:p}]\n"),
            "1:36-45 error unknown-key: unknown key 'package:p' in behavior 'B': is a space "
            "missing after ':'?\n");
  EXPECT_EQ(findings("default_values: {tasks: {suitability: 3}, tsks: 3}\nbehaviors: []\n"),
            "1:26-37 warning unknown-key: unknown key 'suitability' in the defaults of tasks\n"
            "1:43-47 warning unknown-key: unknown key 'tsks' in default_values\n");
  // A key that is there already is not meant.
  EXPECT_EQ(findings("default_values: {tsks: 3}\nbehaviors: []\n"),
            "1:18-22 error unknown-key: unknown key 'tsks' in default_values; did you mean "
            "'tasks'?\n");
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, efficacy: 3, sutability: 3}]\n"),
            "1:36-44 warning deprecated-key: 'efficacy' is an older name: write 'suitability'\n"
            "1:49-59 warning unknown-key: unknown key 'sutability' in behavior 'B'\n");
}

TEST(CatalogReader, KeysAtTheWrongLevel) {
  EXPECT_EQ(findings("behaviors: []\ntasks:\n- task: X\n  parameters:\n  - parameter: p\n"
                     "  allowed_values: string\n"),
            "6:3-17 warning unknown-key: unknown key 'allowed_values' in task 'X': it belongs to a "
            "parameter, one level down\n");
  EXPECT_EQ(findings("behaviors:\n- behavior: B\n  task: X\n  requires:\n  - task: Y\n"
                     "    package: p\ntasks: [{task: Y}]\n"),
            "6:5-12 warning unknown-key: unknown key 'package' in a requirement: it belongs to a "
            "behavior, one level up\n");
  // A list of tasks is no task at the wrong level.
  EXPECT_EQ(findings("behaviors: []\ntask:\n- task: X\n"),
            "2:1-5 error unknown-key: unknown key 'task' in a catalog; did you mean 'tasks'?\n");
  EXPECT_EQ(findings("behaviors: []\ntask: X\n"),
            "2:1-5 warning unknown-key: unknown key 'task' in a catalog: it belongs to a behavior, "
            "one level down\n");
}

TEST(CatalogReader, ABehaviorHasAHundredTasksAtMost) {
  const auto with_tasks = [](int count) {
    std::string text = "behaviors:\n- behavior: B\n  tasks:\n";
    for (int i = 0; i < count; ++i) text += "  - task: T" + std::to_string(i) + "\n";
    return findings(text);
  };
  EXPECT_EQ(with_tasks(100), "");
  EXPECT_EQ(with_tasks(101),
            "3:3-8 error invalid-value: a behavior may have at most 100 tasks, found 101\n");
}

// Values ---------------------------------------------------------------------------------------

TEST(CatalogReader, WrongTypesOfSections) {
  EXPECT_EQ(findings("hello"),
            "1:1-6 error wrong-type: a catalog must be a mapping with the key 'behaviors', found "
            "'hello'\n");
  EXPECT_EQ(findings("- behaviors: []"),
            "1:1-2 error wrong-type: a catalog must be a mapping with the key 'behaviors', found a "
            "list\n");
  EXPECT_EQ(findings("default_values: 3\nbehaviors: {}\ntasks: x\nexclusivity_constraints: 'y'\n"),
            "1:17-18 error wrong-type: 'default_values' must be a mapping, or a list of mappings, "
            "found '3'\n"
            "2:12-13 error wrong-type: 'behaviors' must be a list of behaviors, found an empty "
            "mapping\n"
            "3:8-9 error wrong-type: 'tasks' must be a list of tasks, found 'x'\n"
            "4:26-29 error wrong-type: 'exclusivity_constraints' must be a list of "
            "'mutually_exclusive' lists, found 'y' in quotes\n");
  EXPECT_EQ(findings("default_values: [3, {tasks: [4], behaviors: 5}]\nbehaviors: []\n"),
            "1:18-19 error wrong-type: an entry of 'default_values' must be a mapping, found '3'\n"
            "1:30-31 error wrong-type: an entry of 'tasks' must be a mapping, found '4'\n"
            "1:45-46 error wrong-type: 'behaviors' must be a mapping, or a list of mappings, found "
            "'5'\n");
}

TEST(CatalogReader, WrongTypesOfEntries) {
  EXPECT_EQ(
      findings("behaviors:\n-\n- B\n- {behavior: C, task: X, requires: [Y, ~]}\ntasks: [Y, [Z]]\n"
               "exclusivity_constraints: [[X, Y]]\n"),
      "2:1-2 error wrong-type: a behavior must be a mapping ('behavior: NAME'), found "
      "nothing\n"
      "3:3-4 error wrong-type: a behavior must be a mapping ('behavior: NAME'), found 'B'\n"
      "4:37-38 error wrong-type: a requirement must be a mapping ('task: NAME'), found 'Y'\n"
      "4:40-41 error wrong-type: a requirement must be a mapping ('task: NAME'), found "
      "nothing\n"
      "5:9-10 error wrong-type: a task must be a mapping ('task: NAME'), found 'Y'\n"
      "5:12-13 error wrong-type: a task must be a mapping ('task: NAME'), found a list\n"
      "6:27-28 error wrong-type: an exclusivity constraint must be a mapping "
      "('mutually_exclusive: [A, B]'), found a list\n");
  EXPECT_EQ(
      findings("behaviors:\n- {behavior: B, tasks: [X]}\n- {behavior: C, tasks: X}\n"
               "- {behavior: D, task: X, requires: {task: X}}\n"),
      "2:25-26 error wrong-type: a task of a behavior must be a mapping ('task: NAME'), found "
      "'X'\n"
      "3:24-25 error wrong-type: 'tasks' must be a list of tasks, found 'X'\n"
      "4:36-37 error wrong-type: 'requires' must be a list of requirements, found a "
      "mapping\n");
}

TEST(CatalogReader, WrongNames) {
  EXPECT_EQ(
      findings("behaviors:\n- {behavior: [B], task: {}}\n- {behavior: '', task: \"\"}\n"),
      "2:14-15 error wrong-type: 'behavior' must be the name of a behavior, found a list\n"
      "2:25-26 error wrong-type: 'task' must be the name of a task, found an empty mapping\n"
      "3:14-16 error invalid-value: 'behavior' must be the name of a behavior, found an empty "
      "text\n"
      "3:24-26 error invalid-value: 'task' must be the name of a task, found an empty "
      "text\n");
  EXPECT_EQ(
      findings("behaviors: [{behavior: B, task: X, package: []}]\n"
               "exclusivity_constraints:\n- mutually_exclusive: [X, ~, [X]]\n"
               "- mutually_exclusive: X\n"),
      "1:45-46 error wrong-type: 'package' must be the name of a package, found an empty "
      "list\n"
      "3:27-28 error wrong-type: 'mutually_exclusive' must be a list of names of tasks, found "
      "nothing\n"
      "3:30-31 error wrong-type: 'mutually_exclusive' must be a list of names of tasks, found "
      "a list\n"
      "4:23-24 error wrong-type: 'mutually_exclusive' must be a list of names of tasks, found "
      "'X'\n");
}

TEST(CatalogReader, ValuesOfTasks) {
  EXPECT_EQ(findings("behaviors: []\ntasks:\n- task: X\n  start_on_request: 'TRUE'\n"
                     "  reactive_start: 1\n  execution_goal: achieve\n  minimum_performance: 101\n"
                     "  parameters: {parameter: p}\n"),
            "4:21-27 error wrong-type: 'start_on_request' must be true or false, found 'TRUE' in "
            "quotes\n"
            "5:19-20 error wrong-type: 'reactive_start' must be true or false, found '1'\n"
            "6:19-26 error invalid-value: 'execution_goal' must be achieve_goal or keep_running, "
            "found 'achieve'; did you mean 'achieve_goal'?\n"
            "7:24-27 error invalid-value: 'minimum_performance' must be a number from 0 to 100 "
            "(percent), found '101'\n"
            "8:15-16 error wrong-type: 'parameters' must be a list of parameters, found a "
            "mapping\n");
  EXPECT_EQ(
      findings("behaviors: []\ntasks:\n- {task: X, category: 3, parameters: [p, {parameter: p,"
               " allowed_values: {}}, {parameter: q, allowed_values: [1, [2], ~]}]}\n"),
      "3:13-21 warning deprecated-key: 'category' is an older name: write 'execution_goal'\n"
      "3:23-24 error invalid-value: 'category' must be goal_based or recurrent, found '3'\n"
      "3:39-40 error wrong-type: a parameter must be a mapping ('parameter: NAME'), found "
      "'p'\n"
      "3:73-74 error wrong-type: 'allowed_values' must be a list of values, or the name of a "
      "type, found an empty mapping\n"
      "3:113-114 error wrong-type: 'allowed_values' must be a list of plain values, found a "
      "list\n"
      "3:118-119 error wrong-type: 'allowed_values' must be a list of plain values, found "
      "nothing\n");
}

// Names ----------------------------------------------------------------------------------------

TEST(CatalogReader, DuplicateTasksHaveThePlaceOfTheFirstAndTheAttributesOfTheLast) {
  const std::string text = R"(default_values: {tasks: {timeout: 15}}
behaviors: []
tasks:
- {task: X, timeout: 180, execution_goal: keep_running, minimum_performance: 3}
- {task: Y}
- {task: X, start_on_request: no, parameters: [{parameter: p}]}
- {task: Y, timeout: 15}
)";
  EXPECT_EQ(describe(read(text)),
            "task X timeout 15000000 p()\ntask Y on_request timeout 15000000\n");
  EXPECT_EQ(show(read(text).tasks.at(0).range), "4:10-11");
  EXPECT_EQ(findings(text),
            "6:10-11 warning duplicate-task: task 'X' is listed twice; the last entry counts: "
            "execution_goal achieve_goal, was keep_running; start_on_request FALSE, was TRUE; "
            "timeout 15 s, was 180 s; minimum_performance none, was 3 %; other parameters\n"
            "  4:10-11 first listed here\n"
            "7:10-11 warning duplicate-task: task 'Y' is listed twice, with the same attributes\n"
            "  5:10-11 first listed here\n");
}

TEST(CatalogReader, OnlyTheLastEntryOfATaskHasFlags) {
  const std::string both = "- {task: X, start_on_request: yes, reactive_start: yes}\n";
  EXPECT_EQ(findings("behaviors: []\ntasks:\n" + both + "- {task: X}\n"),
            "4:10-11 warning duplicate-task: task 'X' is listed twice; the last entry counts: "
            "reactive_start FALSE, was TRUE\n  3:10-11 first listed here\n");
}

TEST(CatalogReader, UndefinedTasks) {
  EXPECT_EQ(findings(R"(behaviors:
- behavior: B
  task: HOVER
  requires:
  - task: HOVR
  - task: SELF_LOCALIZE_NON_EXISTENT
  - task: B
tasks:
- task: SELF_LOCALIZE
exclusivity_constraints:
- mutually_exclusive: [HOVER, MOON]
)"),
            // A behavior does not require what it performs.
            "5:11-15 error undefined-task: task 'HOVR', required by behavior 'B', is not defined\n"
            "6:11-37 error undefined-task: task 'SELF_LOCALIZE_NON_EXISTENT', required by behavior "
            "'B', is not defined; did you mean 'SELF_LOCALIZE'?\n"
            "7:11-12 error undefined-task: task 'B', required by behavior 'B', is not defined: "
            "there is a behavior of this name, but no task\n"
            "11:31-35 error undefined-task: task 'MOON', named in an exclusivity list, is not "
            "defined\n");
}

TEST(CatalogReader, UndefinedTasksThatOtherFindingsExplain) {
  // The section that may define them could not be read.
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, requires: [{task: MOON}]}]\ntasks: 3\n"),
            "2:8-9 error wrong-type: 'tasks' must be a list of tasks, found '3'\n");
  // The entry that may define it has no name.
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, requires: [{task: MOON}]}]\n"
                     "tasks: [{timeout: 3}]\n"),
            "2:9-10 error missing-key: missing key 'task' in a task\n");
  // The name is there, though in the wrong form.
  EXPECT_EQ(findings("behaviors: [{behavior: B, task: X, requires: [{task: MOON}, {task: SUN}]}]\n"
                     "tasks: [{task: [MOON]}, SUN]\n"),
            "2:16-17 error wrong-type: 'task' must be the name of a task, found a list\n"
            "2:25-28 error wrong-type: a task must be a mapping ('task: NAME'), found 'SUN'\n");
  // The behavior that may define it has no task.
  EXPECT_EQ(
      findings("behaviors:\n- behavior: A\n- {behavior: B, task: X, requires: [{task: MOON}]}\n"),
      "2:13-14 error missing-key: missing key 'task' in behavior 'A'\n");
  EXPECT_EQ(findings("behaviors:\n- {behavior: A, tasks: []}\n"
                     "- {behavior: B, task: X, requires: [{task: MOON}]}\n"),
            "2:17-22 error invalid-value: a behavior must have at least one task\n");
  EXPECT_EQ(findings("behaviors:\n- {behavior: A, tasks: [{suitability: 3}]}\n"
                     "- {behavior: B, task: X, requires: [{task: MOON}]}\n"),
            "2:25-26 error missing-key: missing key 'task' in a task of a behavior\n");
  // One of two sections of tasks is not read.
  EXPECT_EQ(findings("tasks: [{task: X}]\ntasks: [{task: MOON}]\n"
                     "behaviors: [{behavior: B, task: X, requires: [{task: MOON}]}]\n"),
            "2:1-6 error duplicate-key: 'tasks' is given twice\n"
            "  1:1-6 first given here\n");
}

TEST(CatalogReader, AliasesGiveOneFinding) {
  EXPECT_EQ(findings("behaviors:\n- {behavior: A, task: X, requires: &r [{task: MOON, suit: 3}]}\n"
                     "- {behavior: A2, task: X, requires: *r}\n"),
            "2:47-51 error undefined-task: task 'MOON', required by behavior 'A', is not defined\n"
            "2:53-57 warning unknown-key: unknown key 'suit' in a requirement\n");
}

// Requirements ---------------------------------------------------------------------------------

TEST(CatalogReader, AShortestCycleThroughTheFirstOfEachSetOfTasks) {
  EXPECT_EQ(findings(R"(behaviors:
- {behavior: A, task: P, requires: [{task: Q}]}
- {behavior: B, task: Q, requires: [{task: R}, {task: X}]}
- {behavior: C, task: R, requires: [{task: P}, {task: Q}]}
- {behavior: D, task: X, requires: [{task: Y}]}
- {behavior: E, task: Y, requires: [{task: X}]}
)"),
            "2:44-45 error requirement-cycle: tasks require one another: 'P' -> 'Q' -> 'R' -> 'P'\n"
            "  2:44-45 behavior 'A', which performs 'P', requires 'Q'\n"
            "  3:44-45 behavior 'B', which performs 'Q', requires 'R'\n"
            "  4:44-45 behavior 'C', which performs 'R', requires 'P'\n"
            "5:44-45 error requirement-cycle: tasks require one another: 'X' -> 'Y' -> 'X'\n"
            "  5:44-45 behavior 'D', which performs 'X', requires 'Y'\n"
            "  6:44-45 behavior 'E', which performs 'Y', requires 'X'\n");
}

TEST(CatalogReader, LongCyclesAreShownByTheirBeginning) {
  std::string text = "behaviors:\n";
  for (int i = 0; i < 12; ++i) {
    text += "- {behavior: B" + std::to_string(i) + ", task: T" + std::to_string(i) +
            ", requires: [{task: T" + std::to_string((i + 1) % 12) + "}]}\n";
  }
  const std::string found = findings(text);
  EXPECT_EQ(found.substr(0, found.find('\n')),
            "2:46-48 error requirement-cycle: tasks require one another: 'T0' -> 'T1' -> 'T2' -> "
            "'T3' -> 'T4' -> 'T5' -> 'T6' -> 'T7' -> 'T8' -> 'T9' -> ... -> 'T0'");
  // All steps are in the notes.
  EXPECT_NE(found.find("13:48-50 behavior 'B11', which performs 'T11', requires 'T0'"),
            std::string::npos);
}

TEST(CatalogReader, ARequirementMustExcludeAllTasksOfABehavior) {
  const std::string behaviors =
      "behaviors:\n- {behavior: A, tasks: [{task: X}, {task: Y}], requires: [{task: Z}]}\n"
      "- {behavior: B, task: Z}\nexclusivity_constraints:\n- mutually_exclusive: [X, Z]\n";
  EXPECT_EQ(findings(behaviors), "");
  EXPECT_EQ(findings(behaviors + "- mutually_exclusive: [Z, Y]\n"),
            "2:66-67 error exclusive-requirement: behavior 'A' requires 'Z', which excludes every "
            "task it performs\n"
            "  5:3-21 mutually exclusive by this list\n");
}

// All at once ----------------------------------------------------------------------------------

TEST(CatalogReader, LargeCatalogsTakeLinearTime) {
  // Chains, shared lists and unknown names that would take minutes if anything were quadratic.
  constexpr int tasks = 1'500;
  std::string text = "behaviors:\n";
  for (int i = 0; i < tasks; ++i) {
    text += "- {behavior: b" + std::to_string(i) + ", task: t" + std::to_string(i) +
            ", requires: [{task: t" + std::to_string((i + 1) % tasks) + "}, {task: unknown" +
            std::to_string(i) + "}]}\n";
  }
  text += "exclusivity_constraints:\n";
  for (int i = 0; i < tasks; ++i)
    text += "- mutually_exclusive: [t0, t" + std::to_string(i) + "]\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_catalog(text, "a.yaml", diagnostics).has_value());
  // The unknown ones, one cycle, and t0 that excludes what it requires and what requires it.
  EXPECT_EQ(diagnostics.all().size(), tasks + 1U + 2U);
}

}  // namespace
}  // namespace cbc::catalog_reader_test
