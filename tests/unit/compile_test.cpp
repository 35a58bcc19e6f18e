#include "core/compile/compile.h"

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/compiled/compiled_catalog.h"
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

using test::compile_text;

TEST(Compile, AnEmptyCatalogHasNoGroups) {
  const CompiledCatalog catalog = compile(Catalog{});
  EXPECT_EQ(catalog.group_count(), 0U);
  EXPECT_EQ(most_in_a_group(catalog.group_tasks), 0U);
  EXPECT_EQ(most_values_in_a_group(catalog), 0U);
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
  std::string text;
  for (const CompiledRequirement& rule : catalog.requirements[test::behavior_id(catalog, "a")]) {
    text += fmt::format(" {}:{}@{}", catalog.name_of_task(rule.task), rule.minimum_performance,
                        catalog.line_of(rule));
  }
  EXPECT_EQ(text, " B:0@6 C:700000@7");
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
