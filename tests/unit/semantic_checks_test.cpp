#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/diagnostic/rules.h"
#include "core/yaml/document.h"
#include "unit/findings.h"

namespace cbc::semantic_checks_test {
namespace {

/// All findings, but for never-started, on a catalog whose tasks start by themselves and go on. Its
/// text begins at line 2.
std::string lint(const std::string& yaml, std::uint64_t max_nodes = LintOptions().max_nodes) {
  const std::string defaults =
      "default_values: {tasks: {execution_goal: keep_running, start_on_request: FALSE}}\n";
  Diagnostics diagnostics;
  const auto document = yaml::parse(defaults + yaml, "a.yaml", diagnostics);
  EXPECT_TRUE(document) << show(diagnostics);
  if (!document) return {};
  LintOptions options;
  options.max_nodes = max_nodes;
  const CheckedCatalog result = lint_catalog(*document, options, diagnostics);
  EXPECT_TRUE(result.compiled) << show(diagnostics);
  Diagnostics shown;
  for (Diagnostic& finding : diagnostics.release()) {
    if (finding.rule != rule::never_started) shown.add(std::move(finding));
  }
  return show(shown);
}

TEST(SemanticChecks, SayNothingAboutAGoodCatalog) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a1, task: A, requires: [{task: B, minimum_performance: 81}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b, task: B, suitability: 90, requires: [{task: D, minimum_performance: 90}]}
- {behavior: c, task: C}
- {behavior: d, task: D, suitability: 90}
tasks: [{task: A}, {task: B, minimum_performance: 81}, {task: C}, {task: D}]
exclusivity_constraints:
- mutually_exclusive: [B, C]
)"),
            "");
}

// exclusive-requirement and conflicting-requirements

TEST(SemanticChecks, ExclusiveRequirementIsNotExplainedAgain) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B}
- {behavior: c, task: C, requires: [{task: A}]}
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [A, B]
)"),
            "3:44-45 error exclusive-requirement: behavior 'a' requires 'B', which excludes 'A', "
            "the task it performs\n"
            "  8:3-21 mutually exclusive by this list\n");
}

TEST(SemanticChecks, ConflictingRequirements) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C}, {task: D}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
- {behavior: d, task: D}
- {behavior: e, task: E, requires: [{task: A}]}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}]
exclusivity_constraints:
- mutually_exclusive: [C, B]
)"),
            "3:55-56 warning conflicting-requirements: behavior 'a' requires both 'B' and 'C', "
            "which exclude one another, so it can never be active\n"
            "  3:44-45 'B' is required here\n"
            "  10:3-21 mutually exclusive by this list\n");
}

TEST(SemanticChecks, RequirementsOfDifferentBehaviorsDoNotConflict) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [B, C]
)"),
            "");
}

TEST(SemanticChecks, ConflictWithATaskThatIsExclusiveIsNoFindingOfItsOwn) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [A, B]
- mutually_exclusive: [B, C]
)"),
            "3:44-45 error exclusive-requirement: behavior 'a' requires 'B', which excludes 'A', "
            "the task it performs\n"
            "  8:3-21 mutually exclusive by this list\n");
}

// unreachable-performance

TEST(SemanticChecks, UnreachablePerformanceOfARequirement) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 72.0001}]}
- {behavior: b1, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 71}
- {behavior: c, task: C, suitability: 80}
- {behavior: d, task: D, requires: [{task: A}]}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}]
)"),
            "3:68-75 warning unreachable-performance: behavior 'a' requires 'B' with at least "
            "72.0001 %, but the best that can be reached is 72 %\n");
}

TEST(SemanticChecks, PerformanceThatIsJustReached) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 72}]}
- {behavior: b, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 80}
tasks: [{task: A}, {task: B}, {task: C}]
)"),
            "");
}

TEST(SemanticChecks, BestPerformanceIsThatWhichTheOtherConstraintsAllow) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 80}]}
- {behavior: b1, task: B, suitability: 100, requires: [{task: C}, {task: D}]}
- {behavior: b2, task: B, suitability: 33.3333, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 33.3333}
- {behavior: d, task: D, requires: [{task: E}]}
- {behavior: e, task: E}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}]
exclusivity_constraints:
- mutually_exclusive: [C, E]
)"),
            "3:68-70 warning unreachable-performance: behavior 'a' requires 'B' with at least 80 "
            "%, but the best that can be reached is 11.111 %\n"
            "4:14-16 warning dead-behavior: behavior 'b1' can never be active: together these "
            "constraints exclude it\n"
            "  4:63-64 behavior 'b1' requires 'C'\n"
            "  4:74-75 behavior 'b1' requires 'D'\n"
            "  7:44-45 behavior 'd' requires 'E'\n"
            "  11:3-21 'C' excludes 'E'\n");
}

TEST(SemanticChecks, UnreachablePerformanceOfATask) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b1, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 60}
- {behavior: c, task: C, suitability: 80}
tasks:
- task: A
- {task: B, minimum_performance: 73}
- task: C
)"),
            "9:34-36 warning unreachable-performance: task 'B' must perform with at least 73 %, "
            "but the best that can be reached is 72 %\n");
}

// The second fault is still there when the first is mended.
TEST(SemanticChecks, MinimumOfATaskThatCannotRunAnywayIsAFaultOfItsOwn) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, suitability: 50, requires: [{task: B}]}
- {behavior: b, task: B}
tasks:
- {task: A, minimum_performance: 60}
- task: B
exclusivity_constraints:
- mutually_exclusive: [A, B]
)"),
            "3:61-62 error exclusive-requirement: behavior 'a' requires 'B', which excludes 'A', "
            "the task it performs\n"
            "  9:3-21 mutually exclusive by this list\n"
            "6:10-11 warning dead-task: task 'A' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  6:34-36 'A' runs with at least 60 %\n");
}

// dead-behavior and dead-task

TEST(SemanticChecks, DeadBehavior) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a1, task: A, requires: [{task: B}, {task: D}]}
- {behavior: a2, task: A}
- {behavior: b, task: B, requires: [{task: C, minimum_performance: 50}]}
- {behavior: c1, task: C, suitability: 40}
- {behavior: c2, task: C, suitability: 60, requires: [{task: E}]}
- {behavior: d, task: D}
- {behavior: e, task: E}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}]
exclusivity_constraints:
- mutually_exclusive: [D, E]
)"),
            "3:14-16 warning dead-behavior: behavior 'a1' can never be active: together these "
            "constraints exclude it\n"
            "  3:45-46 behavior 'a1' requires 'B'\n"
            "  3:56-57 behavior 'a1' requires 'D'\n"
            "  5:44-45 behavior 'b' requires 'C'\n"
            "  7:62-63 behavior 'c2' requires 'E'\n"
            "  5:68-70 behavior 'b' requires 'C' with at least 50 %\n"
            "  12:3-21 'D' excludes 'E'\n");
}

TEST(SemanticChecks, BehaviorThatHasAWayOutIsNotDead) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [A, C]
)"),
            "");
}

TEST(SemanticChecks, DeadTask) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b, task: B, requires: [{task: D}]}
- {behavior: c, task: C, requires: [{task: D}]}
- {behavior: d, task: D}
- {behavior: e, task: E, requires: [{task: A}]}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}]
exclusivity_constraints:
- mutually_exclusive: [A, D]
)"),
            "9:16-17 warning dead-task: task 'A' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  3:45-46 behavior 'a1' requires 'B'\n"
            "  4:45-46 behavior 'a2' requires 'C'\n"
            "  5:44-45 behavior 'b' requires 'D'\n"
            "  6:44-45 behavior 'c' requires 'D'\n"
            "  11:3-21 'A' excludes 'D'\n");
}

TEST(SemanticChecks, TaskWithoutBehaviorExplainsWhatRequiresIt) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: c, task: C, requires: [{task: A}]}
tasks: [{task: A}, {task: B}, {task: C}]
)"),
            "5:27-28 warning task-without-behavior: no behavior performs task 'B'\n");
}

TEST(SemanticChecks, FaultsThatAreIndependentAreFoundTogether) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B, requires: [{task: C}, {task: D}]}
- {behavior: c, task: C}
- {behavior: d, task: D}
- {behavior: e, task: E, requires: [{task: B}, {task: F}]}
- {behavior: f, task: F, requires: [{task: G}]}
- {behavior: g, task: G}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}, {task: F}, {task: G}]
exclusivity_constraints:
- mutually_exclusive: [C, D]
- mutually_exclusive: [E, G]
)"),
            "4:55-56 warning conflicting-requirements: behavior 'b' requires both 'C' and 'D', "
            "which exclude one another, so it can never be active\n"
            "  4:44-45 'C' is required here\n"
            "  12:3-21 mutually exclusive by this list\n"
            "10:60-61 warning dead-task: task 'E' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  7:55-56 behavior 'e' requires 'F'\n"
            "  8:44-45 behavior 'f' requires 'G'\n"
            "  13:3-21 'E' excludes 'G'\n");
}

TEST(SemanticChecks, DeadBehaviorOfSeveralTasksExplainsAllOfThem) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: ab
  tasks: [{task: A}, {task: B}]
  requires: [{task: C}, {task: D}]
- {behavior: c, task: C, requires: [{task: E}]}
- {behavior: d, task: D}
- {behavior: e, task: E}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}]
exclusivity_constraints:
- mutually_exclusive: [D, E]
)"),
            "3:13-15 warning dead-behavior: behavior 'ab' can never be active: together these "
            "constraints exclude it\n"
            "  5:21-22 behavior 'ab' requires 'C'\n"
            "  5:32-33 behavior 'ab' requires 'D'\n"
            "  6:44-45 behavior 'c' requires 'E'\n"
            "  11:3-21 'D' excludes 'E'\n");
}

TEST(SemanticChecks, BehaviorIsNotDeadThatCanPerformOneOfItsTasks) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: ab
  tasks: [{task: A}, {task: B}]
  requires: [{task: C}]
- {behavior: b, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [B, C]
)"),
            "");
}

// A task that only such a behavior performs is dead, though the behavior is not.
TEST(SemanticChecks, DeadTaskOfALiveBehavior) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: ab
  tasks: [{task: A}, {task: B}]
  requires: [{task: C}]
- {behavior: c, task: C}
- {behavior: d, task: D, requires: [{task: B}]}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}]
exclusivity_constraints:
- mutually_exclusive: [B, C]
)"),
            "8:27-28 warning dead-task: task 'B' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  5:21-22 behavior 'ab' requires 'C'\n"
            "  10:3-21 'B' excludes 'C'\n");
}

// A mistake about one task of a behavior does not hide what the behavior does to others as another
// task.
TEST(SemanticChecks, MinimumOfOneTaskDoesNotExplainAnother) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: ab
  tasks: [{task: A, suitability: 50}, {task: B}]
  requires: [{task: C}]
- {behavior: c, task: C}
- {behavior: d, task: D, requires: [{task: B}]}
tasks: [{task: A, minimum_performance: 60}, {task: B}, {task: C}, {task: D}]
exclusivity_constraints:
- mutually_exclusive: [C, D]
)"),
            "8:40-42 warning unreachable-performance: task 'A' must perform with at least 60 %, "
            "but the best that can be reached is 50 %\n"
            "8:74-75 warning dead-task: task 'D' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  7:44-45 behavior 'd' requires 'B'\n"
            "  5:21-22 behavior 'ab' requires 'C'\n"
            "  10:3-21 'C' excludes 'D'\n");
}

// requires-on-request

TEST(SemanticChecks, RequiresOnRequest) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B, requires: [{task: D}, {task: E}]}
- {behavior: c, task: C, requires: [{task: D}]}
- {behavior: d, task: D}
- {behavior: e, task: E}
tasks:
- task: A
- {task: B, start_on_request: TRUE}
- task: C
- {task: D, start_on_request: TRUE}
- {task: E, start_on_request: TRUE}
)"),
            "3:44-45 warning requires-on-request: behavior 'a' requires 'B', which starts "
            "only on request: request 'D', then 'B' first\n"
            "  11:10-11 'B' is defined here\n"
            "5:45-46 warning requires-on-request: behavior 'b2' requires 'D', which starts "
            "only on request: request 'D' first\n"
            "  13:10-11 'D' is defined here\n"
            "5:56-57 warning requires-on-request: behavior 'b2' requires 'E', which starts "
            "only on request: request 'E' first\n"
            "  14:10-11 'E' is defined here\n"
            "6:44-45 warning requires-on-request: behavior 'c' requires 'D', which starts "
            "only on request: request 'D' first\n"
            "  13:10-11 'D' is defined here\n");
}

TEST(SemanticChecks, DeadBehaviorNeedsNoRequest) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B, start_on_request: TRUE}, {task: C}]
exclusivity_constraints:
- mutually_exclusive: [B, C]
)"),
            "3:55-56 warning conflicting-requirements: behavior 'a' requires both 'B' and 'C', "
            "which exclude one another, so it can never be active\n"
            "  3:44-45 'B' is required here\n"
            "  8:3-21 mutually exclusive by this list\n");
}

// redundant-requirement

TEST(SemanticChecks, RedundantRequirement) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: C}, {task: B}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B, requires: [{task: D}]}
- {behavior: c, task: C}
- {behavior: d, task: D, requires: [{task: C}]}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}]
)"),
            "3:44-45 note redundant-requirement: the requirement of 'C' is redundant: wherever "
            "behavior 'a' is active, 'C' runs anyway\n"
            "  3:55-56 behavior 'a' requires 'B'\n"
            "  5:45-46 behavior 'b2' requires 'D'\n"
            "  4:45-46 behavior 'b1' requires 'C'\n"
            "  7:44-45 behavior 'd' requires 'C'\n");
}

TEST(SemanticChecks, RequirementThatSomeChoiceDoesNotMeetIsNotRedundant) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: C}, {task: B}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B}
- {behavior: c, task: C}
tasks: [{task: A}, {task: B}, {task: C}]
)"),
            "");
}

TEST(SemanticChecks, RedundantMinimum) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: a
  task: A
  requires:
  - {task: B}
  - {task: C, minimum_performance: 80}
- {behavior: b, task: B, requires: [{task: C, minimum_performance: 81}]}
- {behavior: c1, task: C, suitability: 70}
- {behavior: c2, task: C, suitability: 90}
tasks: [{task: A}, {task: B}, {task: C}]
)"),
            "7:12-13 note redundant-requirement: the requirement of 'C' is redundant: wherever "
            "behavior 'a' is active, 'C' performs with at least 80 % "
            "anyway\n"
            "  6:12-13 behavior 'a' requires 'B'\n"
            "  8:44-45 behavior 'b' requires 'C'\n"
            "  8:68-70 behavior 'b' requires 'C' with at least 81 %\n");
}

// A task that the required one depends on may run without being required, and lower its
// performance.
TEST(SemanticChecks, ReasonOfARedundantMinimumIsWhatHoldsItUp) {
  EXPECT_EQ(lint(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C, minimum_performance: 60}]}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C, requires: [{task: D}]}
- {behavior: d1, task: D, suitability: 50}
- {behavior: d2, task: D, suitability: 70}
tasks: [{task: A}, {task: B}, {task: C, minimum_performance: 60}, {task: D}]
)"),
            "3:55-56 note redundant-requirement: the requirement of 'C' is redundant: wherever "
            "behavior 'a' is active, 'C' performs with at least 60 % "
            "anyway\n"
            "  3:44-45 behavior 'a' requires 'B'\n"
            "  4:44-45 behavior 'b' requires 'C'\n"
            "  8:62-64 'C' runs with at least 60 %\n");
}

TEST(SemanticChecks, RepeatedRequirement) {
  EXPECT_EQ(lint(R"(behaviors:
- behavior: a
  task: A
  requires:
  - {task: B, minimum_performance: 50}
  - {task: B, minimum_performance: 60}
  - {task: B}
  - {task: B, minimum_performance: 60}
- {behavior: b1, task: B, suitability: 55}
- {behavior: b2, task: B, suitability: 65}
tasks: [{task: A}, {task: B}]
)"),
            "6:12-13 note redundant-requirement: the requirement of 'B' is redundant: wherever "
            "behavior 'a' is active, 'B' performs with at least 50 % "
            "anyway\n"
            "  7:12-13 it is required here already\n"
            "8:12-13 note redundant-requirement: the requirement of 'B' is redundant: wherever "
            "behavior 'a' is active, 'B' runs anyway\n"
            "  7:12-13 it is required here already\n"
            "9:12-13 note redundant-requirement: the requirement of 'B' is redundant: wherever "
            "behavior 'a' is active, 'B' performs with at least 60 % "
            "anyway\n"
            "  7:12-13 it is required here already\n");
}

// undecided

// Something that requires four tasks, each of which needs one of three places.
std::string four_tasks_in_three_places() {
  std::string behaviors = "behaviors:\n- {behavior: a, task: A, requires: [";
  std::string tasks = "tasks: [{task: A}";
  std::vector<std::string> lists(3);
  for (const std::string name : {"B", "C", "D", "E"}) {
    behaviors += (name == "B" ? "{task: " : ", {task: ") + name + "}";
    tasks += ", {task: " + name + "}";
  }
  behaviors += "]}\n";
  for (const std::string name : {"B", "C", "D", "E"}) {
    for (std::size_t i = 0; i < lists.size(); ++i) {
      const std::string place = name + std::to_string(i);
      behaviors += "- {behavior: use_" + place + ", task: " + name +
                   ", requires: [{task: " + place + "}]}\n- {behavior: be_" + place +
                   ", task: " + place + "}\n";
      tasks += ", {task: " + place + "}";
      lists[i] += (lists[i].empty() ? "" : ", ") + place;
    }
  }
  std::string text = behaviors + tasks + "]\nexclusivity_constraints:\n";
  for (const std::string& list : lists) text += "- mutually_exclusive: [" + list + "]\n";
  return text;
}

TEST(SemanticChecks, OfManyTasksToRequestSomeAreNamed) {
  std::string text = "behaviors:\n- {behavior: b0, task: T0}\n";
  for (int i = 1; i <= 12; ++i) {
    const std::string name = std::to_string(i);
    text += "- {behavior: b" + name + ", task: T" + name + ", requires: [{task: T" +
            std::to_string(i - 1) + "}]}\n";
  }
  text += "tasks:\n";
  for (int i = 0; i <= 12; ++i) {
    text += "- {task: T" + std::to_string(i) + ", start_on_request: TRUE}\n";
  }
  const std::string found = lint(text);
  EXPECT_NE(found.find("requires 'T9', which starts only on request: request 'T0', then 'T1', then "
                       "'T2', then 'T3', then 'T4', then 'T5', then 'T6', then 'T7', then 'T8', "
                       "then 'T9' first\n"),
            std::string::npos);
  EXPECT_NE(found.find("requires 'T11', which starts only on request: request 'T0', then 'T1', "
                       "then 'T2', then 'T3', then 'T4', then 'T5', then 'T6', then 'T7', then "
                       "'T8', then 2 more, then 'T11' first\n"),
            std::string::npos);
}

// Each behavior requires all later tasks, so that performances are products of many.
TEST(SemanticChecks, DenseRequirementsComeToAnEnd) {
  std::string text = "behaviors:\n";
  for (int i = 0; i < 60; ++i) {
    const std::string name = std::to_string(i);
    text += "- {behavior: b" + name + ", task: T" + name + ", suitability: 99.9, requires: [";
    for (int j = i + 1; j < 60; ++j) {
      text += "{task: T" + std::to_string(j) + ", minimum_performance: 2}, ";
    }
    text += "]}\n";
  }
  EXPECT_EQ(lint(text).find("dead-"), std::string::npos);
}

TEST(SemanticChecks, WhatTakesTooLongIsUndecided) {
  const std::string hard = four_tasks_in_three_places();
  EXPECT_EQ(lint(hard, 1),
            "3:14-15 note undecided: whether behavior 'a' can be active could not be decided "
            "with --max-nodes 1\n");
  const std::string decided = lint(hard);
  EXPECT_EQ(decided.substr(0, decided.find(':', 8)), "28:16-17 warning dead-task");
  // What is required, what each of the places is used for, and the pairs that exclude one another.
  EXPECT_EQ(std::count(decided.begin(), decided.end(), '\n'), 1 + 4 + 12 + 18);
}

TEST(SemanticChecks, BestPerformanceThatTakesTooLongIsUndecided) {
  const std::string hard = R"(behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 90}]}
- {behavior: b, task: B, suitability: 80, requires: [{task: C}, {task: D}]}
- {behavior: c1, task: C, suitability: 90, requires: [{task: E}]}
- {behavior: c2, task: C, suitability: 80}
- {behavior: d1, task: D, suitability: 90, requires: [{task: F}]}
- {behavior: d2, task: D, suitability: 70}
- {behavior: e, task: E}
- {behavior: f, task: F}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}, {task: F}]
exclusivity_constraints:
- mutually_exclusive: [E, F]
)";
  EXPECT_EQ(lint(hard, 1),
            "3:68-70 note undecided: whether 'B' can reach 90 % could not be decided with "
            "--max-nodes 1\n"
            "11:16-17 warning dead-task: task 'A' can never run: together these constraints "
            "exclude all of its behaviors\n"
            "  3:44-45 behavior 'a' requires 'B'\n"
            "  3:68-70 behavior 'a' requires 'B' with at least 90 %\n");
  EXPECT_EQ(lint(hard),
            "3:68-70 warning unreachable-performance: behavior 'a' requires 'B' with at least 90 "
            "%, but the best that can be reached is 57.6 %\n");
}

}  // namespace
}  // namespace cbc::semantic_checks_test
