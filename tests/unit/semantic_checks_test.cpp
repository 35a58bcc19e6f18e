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
    if (finding.rule != rule::never_started && !finding.is_off) shown.add(std::move(finding));
  }
  return show(shown);
}

// exclusive-requirement and conflicting-requirements

// unreachable-performance

// dead-behavior and dead-task

// requires-on-request

// redundant-requirement

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
