#include "core/compile/compile.h"

#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/catalog/allowed_values.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/log_cost.h"
#include "support/read_file.h"
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

std::string values_of(const CompiledCatalog& catalog, std::string_view task) {
  std::string text;
  for (const Value& value : catalog.values[task_id(catalog, task)]) {
    text += " " + std::string(catalog.name_of_behavior(value.behavior)) + ":" +
            std::to_string(value.suitability);
    EXPECT_EQ(value.cost, log_cost(value.suitability));
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

std::string cliques(const CompiledCatalog& catalog) {
  std::string text;
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    text += clique == 0 ? "" : " |";
    for (const TaskId task : catalog.cliques[clique])
      text += " " + std::string(catalog.name_of_task(task));
  }
  return text;
}

std::string levels(const CompiledCatalog& catalog) {
  std::string text;
  for (const TaskId task : catalog.task_ids) {
    text += " " + std::string(catalog.name_of_task(task)) + ":" +
            std::to_string(catalog.tasks[task].level);
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    text += " " + std::string(catalog.name_of_behavior(behavior)) + ":" +
            std::to_string(catalog.behaviors[behavior].level);
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

TEST(Compile, NamesAndIdsTranslateBetweenCatalogOrderAndGroups) {
  const CompiledCatalog catalog = compile_text(grouped);
  EXPECT_EQ(catalog.file, "a.yaml");
  EXPECT_EQ(list(catalog.task_names), "A B C D E G");
  EXPECT_EQ(list(catalog.task_ids), "0 1 4 2 5 3");
  EXPECT_EQ(list(catalog.behavior_names), "g c e b a");
  EXPECT_EQ(list(catalog.behavior_ids), "1 3 4 2 0");
  for (std::uint32_t index = 0; index < 6; ++index) {
    EXPECT_EQ(catalog.tasks[catalog.task_ids[index]].catalog_index, index);
  }
  for (std::uint32_t index = 0; index < 5; ++index) {
    EXPECT_EQ(catalog.behaviors[catalog.behavior_ids[index]].catalog_index, index);
  }
}

TEST(Compile, ATaskListedOnceOrNeverJoinsItsGroupThroughABehaviorOfSeveralTasks) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
- {behavior: y, tasks: [{task: C}, {task: B}]}
)");
  EXPECT_EQ(tasks_of_groups(catalog), " A B C");
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

TEST(Compile, ABehaviorThatRequiresAPerformanceGivesItsTaskPerformanceRules) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: C, minimum_performance: 1}]}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C}
)");
  EXPECT_TRUE(catalog.tasks[task_id(catalog, "A")].has_performance_rules);
  EXPECT_FALSE(catalog.tasks[task_id(catalog, "B")].has_performance_rules);
  EXPECT_FALSE(catalog.tasks[task_id(catalog, "C")].has_performance_rules);
}

TEST(Compile, ValuesStandInRankOrder) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: low, task: A, suitability: 50}
- {behavior: first, task: A, suitability: 90}
- {behavior: best, task: A, suitability: 90.0001}
- {behavior: second, tasks: [{task: B, suitability: 10}, {task: A, suitability: 90}]}
- {behavior: none_at_all, task: A, suitability: 0}
)");
  EXPECT_EQ(values_of(catalog, "A"),
            " best:900001 first:900000 second:900000 low:500000 none_at_all:0");
  EXPECT_EQ(values_of(catalog, "B"), " second:100000");
}

TEST(Compile, EachBehaviorKnowsItsValues) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: x, tasks: [{task: B}, {task: A}]}
- {behavior: y, task: A, suitability: 50}
)");
  std::string text;
  for (BehaviorId behavior = 0; behavior < 2; ++behavior) {
    for (const ValueId value : catalog.performs[behavior]) {
      EXPECT_EQ(catalog.values.items[value].behavior, behavior);
      text += " " + std::string(catalog.name_of_behavior(behavior)) +
              std::string(catalog.name_of_task(catalog.task_of(value)));
    }
  }
  EXPECT_EQ(text, " xB xA yA");
}

TEST(Compile, TasksWithoutBehaviorHaveNoValuesAndNoWords) {
  const CompiledCatalog catalog = compile_text(R"(
tasks:
- {task: A}
- {task: B}
behaviors:
- {behavior: b, task: B, requires: [{task: A}]}
)");
  EXPECT_EQ(values_of(catalog, "A"), "");
  EXPECT_EQ(list(catalog.words), "0 0 1");
  EXPECT_EQ(levels(catalog), " A:0 B:1 b:1");
}

TEST(Compile, MoreThanSixtyFourBehaviorsOfATaskTakeSeveralWords) {
  std::string text = "behaviors:\n";
  for (int i = 0; i < 130; ++i) {
    text += "- {behavior: a" + std::to_string(i) +
            ", task: A, suitability: " + std::to_string(100 - i % 3) +
            (i % 2 == 1 ? ", requires: [{task: B}]}\n" : "}\n");
  }
  text += "- {behavior: b, task: B}\n";
  const CompiledCatalog catalog = compile_text(text);
  EXPECT_EQ(list(catalog.words), "0 3 4");
  const TaskId a = task_id(catalog, "A");
  ASSERT_EQ(catalog.arcs[a].size(), 1U);
  const Arc& arc = catalog.arcs[a][0];
  const auto values = catalog.values[a];
  ASSERT_EQ(values.size(), 130U);
  for (std::size_t place = 0; place < values.size(); ++place) {
    const bool requires_b = catalog.behaviors[values[place].behavior].catalog_index % 2 == 1;
    EXPECT_EQ((catalog.masks[arc.mask + place / 64] >> (place % 64)) & 1, requires_b ? 1U : 0U);
  }
  EXPECT_EQ(catalog.masks[arc.mask + 2] >> 2, 0U) << "bits beyond the values";
}

TEST(Compile, ArcsSayWhichValuesRequireATask) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: a1, task: A, suitability: 70, requires: [{task: B}, {task: C}]}
- {behavior: a2, task: A, suitability: 80}
- {behavior: a3, task: A, suitability: 90, requires: [{task: C}]}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C}
)");
  std::string text;
  for (const Arc& arc : catalog.arcs.items) {
    text += " " + std::string(catalog.name_of_task(arc.source)) +
            std::string(catalog.name_of_task(arc.target)) + ":" +
            std::to_string(catalog.masks[arc.mask]);
  }
  // In rank order the values of A are a3, a2, a1.
  EXPECT_EQ(text, " AC:5 AB:4 BC:1");
  text.clear();
  for (TaskId task = 0; task < 3; ++task) {
    text += " " + std::string(catalog.name_of_task(task)) + ":";
    for (const std::uint32_t number : catalog.incoming[task]) {
      EXPECT_EQ(catalog.arcs.items[number].target, task);
      text += std::string(catalog.name_of_task(catalog.arcs.items[number].source));
    }
  }
  EXPECT_EQ(text, " A: B:A C:AB");
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

TEST(Compile, RequirementsAreSortedByTask) {
  const CompiledCatalog catalog = compile_text(R"(
tasks: [{task: B}, {task: C}, {task: A}]
behaviors:
- {behavior: a, task: A, requires: [{task: C}, {task: B}]}
)");
  EXPECT_EQ(requirements_of(catalog, "a"), " B:0@4 C:0@4");
}

TEST(Compile, LevelsAreOneMoreThanTheHighestRequired) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: C}]}
- {behavior: a2, task: A, requires: [{task: B}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B}
- {behavior: c, task: C}
)");
  // a1 requires only C, of level 0; the level of B is that of b1, whatever is chosen.
  EXPECT_EQ(levels(catalog), " A:2 B:1 C:0 a1:1 a2:2 b1:1 b2:0 c:0");
}

TEST(Compile, ABehaviorOfSeveralTasksLiftsAllOfThem) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}], requires: [{task: C}]}
- {behavior: a, task: A, requires: [{task: D}]}
- {behavior: c, task: C, requires: [{task: E}]}
- {behavior: d, task: D, requires: [{task: B}]}
- {behavior: e, task: E}
)");
  EXPECT_EQ(levels(catalog), " A:4 B:2 C:1 D:3 E:0 x:2 a:4 c:1 d:3 e:0");
}

TEST(Compile, CliquesHaveDistinctTasksAreDistinctAndHaveTwoAtLeast) {
  const CompiledCatalog catalog = compile_text(R"(
tasks: [{task: A}, {task: B}, {task: C}]
behaviors: []
exclusivity_constraints:
- mutually_exclusive: [C, A]
- mutually_exclusive: [B, B]
- mutually_exclusive: [A, C, A]
- mutually_exclusive: [B]
- mutually_exclusive: [A, B, C]
)");
  // Lists of fewer than two tasks say nothing.
  EXPECT_EQ(cliques(catalog), " A B C | A C");
  std::string text;
  for (TaskId task = 0; task < 3; ++task) {
    for (const std::uint32_t clique : catalog.task_cliques[task]) {
      text += " " + std::string(catalog.name_of_task(task)) + std::to_string(clique);
    }
  }
  EXPECT_EQ(text, " A0 A1 B0 C0 C1");
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

TEST(Compile, TheReferenceCatalogHasThirtyThreeConstraints) {
  const CompiledCatalog catalog =
      compile_text(test::read_file(CBC_SOURCE_DIR "/catalogs/quadrotor.yaml"));
  EXPECT_EQ(catalog.tasks.size(), 21U);
  EXPECT_EQ(catalog.behaviors.size(), 26U);
  ConstraintCount sum;
  for (const ConstraintCount& count : count_constraints(catalog)) {
    sum.exclusive_pairs += count.exclusive_pairs;
    sum.requirements += count.requirements;
    sum.task_minimums += count.task_minimums;
  }
  EXPECT_EQ(sum.exclusive_pairs, 17U);
  EXPECT_EQ(sum.requirements, 16U);
  EXPECT_EQ(sum.total(), 33U);
  EXPECT_EQ(catalog.group_count(), 9U);
  EXPECT_EQ(catalog.group_tasks[1], 13U) << "motion, control and localization hang together";
}

}  // namespace
}  // namespace cbc::compile_test
