#include "compile/compile.h"

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "catalog/allowed_values.h"
#include "compiled/compiled_catalog.h"
#include "compiled/log_cost.h"
#include "unit/compiled_fixture.h"

namespace cbc::compile_test {
namespace {

/// By group.
std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog) {
  std::vector<ConstraintCount> counts;
  for (const CatalogNumbers& group : summarize(catalog).groups) {
    counts.push_back(group.constraints);
  }
  return counts;
}

using test::behavior_id;
using test::compile_text;
using test::task_id;

template <typename Items>
std::string list(const Items& items) {
  std::string text;
  for (const auto& item : items) text += fmt::format("{}{}", text.empty() ? "" : " ", item);
  return text;
}

TEST(Compile, KeepsTheDeclaredParametersInCatalogOrder) {
  // Groups, and so the numbers of the tasks, are in another order.
  const CompiledCatalog catalog = compile_text(R"(
tasks:
- {task: A, parameters: [{parameter: p, allowed_values: [0, 30]}, {parameter: q}]}
- {task: B}
- {task: C, parameters: [{parameter: r, allowed_values: point_list}]}
behaviors:
- {behavior: a, task: A, requires: [{task: C}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
- {behavior: d, task: IMPLICIT}
)");
  std::string text;
  for (std::uint32_t task = 0; task < catalog.task_names.size(); ++task) {
    text += std::string(catalog.task_names[task]) + ":";
    for (const Parameter& parameter : parameters_of(catalog, task)) {
      text += " " + parameter.name + (parameter.allowed_is_list ? "[" : "(");
      for (const std::string& value : parameter.allowed_values) text += value + ",";
    }
    text += "\n";
  }
  EXPECT_EQ(text, "A: p[0,30, q(\nB:\nC: r(point_list,\nIMPLICIT:\n");
}

std::string tasks_of_groups(const CompiledCatalog& catalog) {
  std::string text;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    text += group == 0 ? "" : " |";
    for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
      EXPECT_EQ(catalog.tasks[task].group, group);
      text += " " + std::string(catalog.name_of_task(task));
    }
  }
  return text;
}

std::string behaviors_of_groups(const CompiledCatalog& catalog) {
  std::string text;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    text += group == 0 ? "" : " |";
    for (BehaviorId behavior = catalog.group_behaviors[group];
         behavior < catalog.group_behaviors[group + 1]; ++behavior) {
      text += " " + std::string(catalog.name_of_behavior(behavior));
    }
  }
  return text;
}

std::string requirements_of(const CompiledCatalog& catalog, std::string_view behavior) {
  std::string text;
  for (const CompiledRequirement& rule : catalog.requirements[behavior_id(catalog, behavior)]) {
    text += " " + std::string(catalog.name_of_task(rule.task)) + ":" +
            std::to_string(rule.minimum_performance) + "@" + std::to_string(catalog.line_of(rule));
    EXPECT_EQ(rule.minimum_cost, log_cost(rule.minimum_performance));
  }
  return text;
}

TEST(Compile, AnEmptyCatalogHasNoGroups) {
  const CompiledCatalog catalog = compile(Catalog{});
  EXPECT_EQ(catalog.group_count(), 0U);
  EXPECT_EQ(list(catalog.group_tasks), "0");
  EXPECT_EQ(most_in_a_group(catalog.group_tasks), 0U);
  EXPECT_EQ(most_values_in_a_group(catalog), 0U);
}

// A shares nothing; B, D and G share a requirement, an exclusivity list and a behavior.
constexpr const char* grouped = R"(
tasks:
- {task: A}
- {task: B}
- {task: C}
- {task: D}
- {task: E}
- {task: G}
behaviors:
- {behavior: g, tasks: [{task: G}, {task: D}]}
- {behavior: c, task: C}
- {behavior: e, task: E}
- {behavior: b, task: B, requires: [{task: D}]}
- {behavior: a, task: A}
exclusivity_constraints:
- mutually_exclusive: [E, C]
)";

TEST(Compile, GroupsAreOrderedByTheirFirstTaskAndKeepCatalogOrder) {
  const CompiledCatalog catalog = compile_text(grouped);
  EXPECT_EQ(tasks_of_groups(catalog), " A | B D G | C E");
  EXPECT_EQ(behaviors_of_groups(catalog), " a | g b | c e");
  EXPECT_EQ(most_in_a_group(catalog.group_tasks), 3U);
  EXPECT_EQ(most_values_in_a_group(catalog), 3U);
}

TEST(Compile, AttributesReachTheTasks) {
  const CompiledCatalog catalog = compile_text(R"(
tasks:
- {task: A, execution_goal: keep_running, start_on_request: false, reactive_start: true}
- {task: B, timeout: 2.5, minimum_performance: 72}
behaviors:
- {behavior: a, task: A, timeout: 1}
- {behavior: b, task: B}
)");
  const CompiledTask& a = catalog.tasks[task_id(catalog, "A")];
  EXPECT_TRUE(a.keep_running);
  EXPECT_FALSE(a.start_on_request);
  EXPECT_TRUE(a.reactive_start);
  EXPECT_EQ(a.timeout, 0);
  EXPECT_EQ(a.minimum_performance, 0U);
  EXPECT_FALSE(a.has_performance_rules);
  const CompiledTask& b = catalog.tasks[task_id(catalog, "B")];
  EXPECT_FALSE(b.keep_running);
  EXPECT_TRUE(b.start_on_request);
  EXPECT_FALSE(b.reactive_start);
  EXPECT_EQ(b.timeout, 2'500'000);
  EXPECT_EQ(b.minimum_performance, 720'000U);
  EXPECT_EQ(b.minimum_cost, log_cost(720'000));
  EXPECT_TRUE(b.has_performance_rules);
  EXPECT_EQ(catalog.behaviors[behavior_id(catalog, "a")].timeout, 1'000'000);
  EXPECT_EQ(catalog.behaviors[behavior_id(catalog, "b")].timeout, 0);
}

TEST(Compile, OfRequirementsOfTheSameTaskTheStrongestStays) {
  const CompiledCatalog catalog = compile_text(R"(behaviors:
- behavior: a
  task: A
  requires:
  - {task: C, minimum_performance: 50}
  - {task: B}
  - {task: C, minimum_performance: 70}
  - {task: C}
- {behavior: b, task: B}
- {behavior: c, task: C}
)");
  EXPECT_EQ(requirements_of(catalog, "a"), " B:0@6 C:700000@7");
  EXPECT_EQ(count_constraints(catalog)[0].requirements, 2U);
}

TEST(Compile, OverlappingListsAreCountedOnce) {
  const CompiledCatalog catalog = compile_text(R"(
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E, minimum_performance: 1}, {task: F}]
behaviors: []
exclusivity_constraints:
- mutually_exclusive: [A, B, C]
- mutually_exclusive: [C, B, D]
- mutually_exclusive: [B, C]
- mutually_exclusive: [F, E]
)");
  const std::vector<ConstraintCount> counts = count_constraints(catalog);
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].exclusive_pairs, 5U);
  EXPECT_EQ(counts[0].task_minimums, 0U);
  EXPECT_EQ(counts[1].exclusive_pairs, 1U);
  EXPECT_EQ(counts[1].task_minimums, 1U);
  EXPECT_EQ(counts[1].total(), 2U);
}

/// The pairs of tasks that some list has, one by one.
std::size_t count_pairs(const std::vector<std::vector<std::size_t>>& lists) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const std::vector<std::size_t>& list : lists) {
    for (const std::size_t a : list) {
      for (const std::size_t b : list) {
        if (a < b) pairs.emplace(a, b);
      }
    }
  }
  return pairs.size();
}

TEST(Compile, PairsOfAnyListsAreCountedOnce) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    const std::size_t tasks = 2 + random() % 12;
    std::vector<std::vector<std::size_t>> lists(1 + random() % 6);
    std::string text = "behaviors: []\ntasks:\n";
    for (std::size_t task = 0; task < tasks; ++task) text += fmt::format("- task: T{}\n", task);
    text += "exclusivity_constraints:\n";
    for (std::vector<std::size_t>& list : lists) {
      text += "- mutually_exclusive:\n";
      for (std::size_t i = random() % 5 + 1; i > 0; --i) {
        list.push_back(random() % tasks);
        text += fmt::format("  - T{}\n", list.back());
      }
    }
    std::uint64_t sum = 0;
    for (const ConstraintCount& count : count_constraints(compile_text(text))) {
      sum += count.exclusive_pairs;
    }
    EXPECT_EQ(sum, count_pairs(lists)) << text;
  }
}

TEST(Compile, AListOfManyTasksHasAllTheirPairs) {
  std::string text = "behaviors: []\ntasks:\n";
  std::string list = "exclusivity_constraints:\n- mutually_exclusive: [T0, T0";
  for (std::size_t task = 0; task < 30'000; ++task) {
    text += fmt::format("- task: T{}\n", task);
    if (task > 0) list += fmt::format(", T{}", task);
  }
  const CompiledCatalog catalog = compile_text(text + list + "]\n- mutually_exclusive: [T7]\n");
  EXPECT_EQ(count_constraints(catalog)[0].exclusive_pairs, 30'000U * 29'999U / 2);
}

}  // namespace
}  // namespace cbc::compile_test
