#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/compiled_file.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/rounds.h"
#include "support/shared_folder.h"
#include "unit/compiled_fixture.h"
#include "unit/editable_catalog.h"
#include "unit/random_problems.h"

namespace cbc::verify_test {
namespace {

using test::compile_text;
using test::describe_compiled;
using test::difference;
using test::EditableCatalog;
using test::Random;

std::string fault_of(const CompiledCatalog& catalog) {
  return find_fault(catalog).value_or("no fault");
}

// Catalogs without a fault -----------------------------------------------------------------------

/// Verifies the catalogs of a folder that can be compiled; their number.
std::size_t verify_folder(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for (const std::filesystem::path& file : test::catalog_files(folder)) {
    Diagnostics diagnostics;
    const auto catalog = read_catalog(test::read_file(file), file.string(), diagnostics);
    if (!catalog) continue;
    EXPECT_EQ(fault_of(compile(*catalog)), "no fault") << file;
    ++count;
  }
  return count;
}

TEST(Verify, OwnCatalogsHaveNoFault) { EXPECT_GE(verify_folder(CBC_SOURCE_DIR "/catalogs"), 2U); }

TEST(Verify, PublishedCatalogsHaveNoFault) {
  const std::filesystem::path folder = test::shared_catalogs();
  if (verify_folder(folder) == 0) GTEST_SKIP() << "no catalogs in " << folder;
  verify_folder(test::shared_folder() / "generated");
}

TEST(Verify, AnEmptyCatalogHasNoFault) { EXPECT_EQ(fault_of(compile(Catalog{})), "no fault"); }

TEST(Verify, ACatalogWithoutArraysHasOne) { EXPECT_NE(fault_of(CompiledCatalog{}), "no fault"); }

TEST(Verify, NamesMayHaveAllThatYamlCanWrite) {
  const CompiledCatalog catalog = compile_text(R"(
tasks:
- {task: "a\0b\n\x01", parameters: [{parameter: é, allowed_values: [""]}]}
behaviors:
- {behavior: "日本 €", task: "a\0b\n\x01", package: ""}
- {behavior: "\U0010FFFF", task: "\uFFFE"}
)");
  EXPECT_EQ(fault_of(catalog), "no fault");
}

TEST(Verify, TheSourceMayHaveAnyName) {
  Catalog catalog;
  catalog.file = "caf\xE9.yaml";
  catalog.tasks.emplace_back().name = "é";
  EXPECT_EQ(fault_of(compile(catalog)), "no fault");
}

/// A random catalog with all that catalogs can have.
Catalog random_rich_catalog(Random& random) {
  test::Shape shape;
  shape.tasks = 1 + static_cast<std::uint32_t>(random.below(12));
  shape.most_behaviors = random.percent(10) ? 140 : 4;
  shape.most_requirements = 3;
  shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(6));
  shape.most_exclusive = 4;
  shape.several_tasks = 30;
  shape.any_percent = 30;
  Catalog catalog = test::random_catalog(random, shape);
  catalog.file = "random é.yaml";
  random.shuffle(catalog.tasks);  // names are numbers in order otherwise
  for (Task& task : catalog.tasks) {
    if (random.percent(30)) task.timeout = random.between(1, longest_time);
    if (random.percent(30)) task.execution_goal = ExecutionGoal::keep_running;
    task.reactive_start = !task.start_on_request && random.percent(50);
    task.minimum_performance_range.begin.line = static_cast<std::uint32_t>(random.below(1'000));
    for (std::size_t i = random.below(3); i > 0; --i) {
      Parameter& parameter = task.parameters.emplace_back();
      parameter.name = fmt::format("p{}", random.below(4));
      parameter.allowed_is_list = random.percent(50);
      const std::size_t most = parameter.allowed_is_list ? 3 : 1;
      for (std::size_t k = random.below(most + 1); k > 0; --k) {
        parameter.allowed_values.push_back(fmt::format("é{}", random.below(5)));
      }
    }
  }
  for (Behavior& behavior : catalog.behaviors) {
    if (random.percent(30)) behavior.timeout = random.between(1, longest_time);
    if (random.percent(50)) behavior.package = fmt::format("package {}", random.below(3));
    for (Requirement& requirement : behavior.requirements) {
      requirement.range.begin.line = static_cast<std::uint32_t>(random.below(1'000));
    }
  }
  for (ExclusivityList& list : catalog.exclusivity) {
    list.range.begin.line = static_cast<std::uint32_t>(random.below(1'000));
  }
  return catalog;
}

TEST(Verify, RandomCatalogsHaveNoFault) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const CompiledCatalog catalog = compile(random_rich_catalog(random));
    ASSERT_EQ(fault_of(catalog), "no fault") << i;
    // What the tests below rely on.
    ASSERT_EQ(difference(compile(describe_compiled(catalog)), catalog), "") << i;
    ASSERT_EQ(difference(EditableCatalog(catalog).catalog(), catalog), "") << i;
  }
}

// Faults made by hand ----------------------------------------------------------------------------

// Groups and TaskIds: A 0, C 1, E 2, G 3 | B 4, D 5 | F 6 | W 7, X 8, Y 9. F has no behavior.
// BehaviorIds: a1 0, a2 1, a3 2, c1 3, e1 4, g1 5 | b1 6, d1 7, d2 8 | w0 9 to w69 78, x1 79,
// y1 80. ValueIds: A: a1 0, a2 1, a3 2; C: a1 3, c1 4; E: e1 5; G: g1 6; B: b1 7; D: d1 8, d2 9; W:
// w0 10 to w69 79; X: x1 80; Y: y1 81. Arcs: A to E 0, C to E 1, B to D 2, W to X 3 (two words), W
// to Y 4 (two words). Texts: names of tasks 0 to 9, of behaviors 10 to 90 (in catalog order), the
// source 91, and more.
CompiledCatalog rich_catalog() {
  std::string yaml = R"(
default_values: {behaviors: {package: basic}}
tasks:
- task: A
  timeout: 15
  minimum_performance: 36
  parameters:
  - {parameter: height, allowed_values: [0, 30]}
  - {parameter: mode, allowed_values: string}
- {task: B, start_on_request: FALSE, reactive_start: TRUE, reactive_priority: 2}
- {task: C, execution_goal: keep_running, start_on_request: FALSE}
- {task: D, parameters: [{parameter: mode}]}
- {task: E, resume: TRUE}
- {task: F}
- {task: G}
- {task: W}
- {task: X}
- {task: Y}
behaviors:
- {behavior: b1, task: B, requires: [{task: D, minimum_performance: 72.5}]}
- {behavior: a1, tasks: [{task: A, suitability: 90}, {task: C, suitability: 80}],
   requires: [{task: E, minimum_performance: 50}]}
- {behavior: a2, task: A, suitability: 70, requires: [{task: E}], package: other}
- {behavior: a3, task: A, suitability: 70}
- {behavior: c1, task: C, suitability: 60, timeout: 2.5}
- {behavior: e1, task: E, situation: {LIGHT: [dusk, day], GPS: true}}
- {behavior: g1, task: G, situation: {LIGHT: night}}
- {behavior: d1, task: D, retry: after_repair}
- {behavior: d2, task: D, suitability: 90, situation: {GPS: false}}
- {behavior: x1, task: X}
- {behavior: y1, task: Y}
exclusivity_constraints:
- {mutually_exclusive: [A, C, E], at_most: 2}
- mutually_exclusive: [C, A]
- mutually_exclusive: [G, C]
- mutually_exclusive: [X, Y]
situation:
- {variable: LIGHT, values: [day, dusk, night]}
- {variable: GPS}
)";
  std::string more;
  for (int i = 0; i < 70; ++i) {
    more += fmt::format("- {{behavior: w{:02}, task: W{}}}\n", i,
                        i % 2 == 0 ? ", requires: [{task: X}]"
                        : i == 69  ? ", requires: [{task: Y}]"
                                   : "");
  }
  yaml.insert(yaml.find("- {behavior: x1"), more);
  return compile_text(yaml);
}

struct Damage {
  const char* message;
  void (*make)(EditableCatalog&);
};

void expect_faults(const std::vector<Damage>& damages) {
  const CompiledCatalog catalog = rich_catalog();
  ASSERT_EQ(fault_of(catalog), "no fault");
  for (const Damage& damage : damages) {
    EditableCatalog edited(catalog);
    damage.make(edited);
    EXPECT_EQ(fault_of(edited.catalog()), damage.message);
  }
}

TEST(Verify, RefusesArraysThatDoNotFit) {
  expect_faults({
      {"'task_ids' has 9 entries, expected 10", [](auto& c) { c.arrays.task_ids.pop_back(); }},
      {"'group_behaviors' has 6 entries, expected 5",
       [](auto& c) { c.arrays.group_behaviors.emplace_back(81); }},
      {"'group_tasks' has 0 entries, expected 5",
       [](auto& c) {
         c.arrays.group_tasks.clear();
         c.arrays.group_behaviors.clear();
       }},
      {"'value_tasks' has 83 entries, expected 82",
       [](auto& c) { c.arrays.value_tasks.emplace_back(9); }},
      {"there are 0 begins of texts, expected 93 for the names and the source",
       [](auto& c) { c.arrays.texts.begin.clear(); }},
      {"there are 92 begins of texts, expected 93 for the names and the source",
       [](auto& c) { c.arrays.texts.begin.resize(92); }},
      {"'values' has 0 begins of rows, expected 11",
       [](auto& c) { c.arrays.values.begin.clear(); }},
      {"'cliques' has 4 begins of rows, expected 3",
       [](auto& c) { c.arrays.clique_lines.pop_back(); }},
      {"entry 0 of 'arcs_begin' does not follow from the other arrays",
       [](auto& c) { c.arrays.arcs.begin[0] = 1; }},
      {"a row of 'requirements' ends before it begins",
       [](auto& c) { c.arrays.requirements.begin[2] = 0; }},
      {"entry 4 of 'incoming_begin' does not follow from the other arrays",
       [](auto& c) { c.arrays.incoming.begin[4] = none; }},
      {"the last row of 'cliques' ends at 5, expected 6",
       [](auto& c) { c.arrays.cliques.begin.back() = 5; }},
      {"the last row of 'texts' ends at 306, expected 307",
       [](auto& c) { c.arrays.texts.items.push_back('x'); }},
      {"entry 81 of 'performs_begin' does not follow from the other arrays",
       [](auto& c) {
         c.arrays.performs.begin.back() = 81;
         c.arrays.performs.items.pop_back();
       }},
      {"entry 4 of 'group_tasks' does not follow from the other arrays",
       [](auto& c) { c.arrays.group_tasks.back() = TaskId(11); }},
      {"entry 10 of 'incoming_begin' does not follow from the other arrays",
       [](auto& c) {
         ++c.arrays.incoming.begin.back();
         c.arrays.incoming.items.push_back(4);
       }},
  });
}

TEST(Verify, RefusesWhatIsNotUtf8AnywhereInTheTexts) {
  const CompiledCatalog catalog = compile_text(
      "behaviors:\n- {behavior: FOLLOW_PATH_WITH_PID_CONTROL, task: FOLLOW_PATH, package: "
      "quadrotor_motion_with_pid_control}\n");
  const std::size_t size = EditableCatalog(catalog).arrays.texts.items.size();
  std::size_t refused = 0;
  for (std::size_t place = 0; place < size; ++place) {
    EditableCatalog edited(catalog);
    edited.arrays.texts.items[place] = '\xFF';
    if (fault_of(edited.catalog()).ends_with(", is not UTF-8")) ++refused;
  }
  EXPECT_GT(size, 70U);
  EXPECT_EQ(refused, size - catalog.file.size()) << "only the name of the source may have any byte";
}

TEST(Verify, RefusesTexts) {
  expect_faults({
      {"text 0, '\\xff', is not UTF-8", [](auto& c) { c.arrays.texts.items[0] = '\xFF'; }},
      // Each of the two texts has a half of the character.
      {"text 0, '\\xc3', is not UTF-8",
       [](auto& c) {
         c.arrays.texts.items[0] = '\xC3';
         c.arrays.texts.items[1] = '\xA9';
       }},
      {"the name of task 0 is empty", [](auto& c) { c.arrays.texts.begin[1] = 0; }},
      {"the name of task 2 is empty", [](auto& c) { c.arrays.texts.begin[2] = 3; }},
      {"two tasks have the name 'B'", [](auto& c) { c.arrays.texts.items[0] = 'B'; }},
      {"two behaviors have the name 'w00'",
       [](auto& c) { c.arrays.texts.items[c.arrays.texts.begin[10 + 11] - 1] = '0'; }},
      {"'tasks_by_name' has 'D' before 'C'",
       [](auto& c) { std::swap(c.arrays.tasks_by_name[2], c.arrays.tasks_by_name[3]); }},
      {"two tasks have the name 'C'", [](auto& c) { c.arrays.tasks_by_name[3] = 2; }},
      {"'behaviors_by_name' has 81 of 81", [](auto& c) { c.arrays.behaviors_by_name[5] = 81; }},
      {"'behavior_packages' has text 1000 of 106",
       [](auto& c) { c.arrays.behavior_packages[3] = 1'000; }},
      {"'allowed_values' has text 4294967295 of 106",
       [](auto& c) { c.arrays.allowed_values[2] = none; }},
  });
}

TEST(Verify, RefusesParameters) {
  expect_faults({
      {"the name of parameter 1 is text 106 of 106",
       [](auto& c) { c.arrays.parameters.items[1].name = 106; }},
      {"the name of parameter 0 is empty",
       [](auto& c) {
         const auto end = static_cast<std::uint32_t>(c.arrays.texts.items.size());
         c.arrays.texts.begin.push_back(end);
         c.arrays.parameters.items[0].name = 106;
       }},
      {"allowed_is_list of parameter 0 is 2, expected 0 or 1",
       [](auto& c) { c.arrays.parameters.items[0].allowed_is_list = 2; }},
      {"parameter 0 has 2 types, expected at most one",
       [](auto& c) { c.arrays.parameters.items[0].allowed_is_list = 0; }},
      {"the allowed values of parameter 1 begin at 1, expected 2",
       [](auto& c) { c.arrays.parameters.items[1].first_allowed = 1; }},
      {"'allowed_values' has 3 entries, expected 4",
       [](auto& c) { c.arrays.parameters.items[2].allowed_count = 1; }},
      {"'allowed_values' has 3 entries, expected 4294967298",
       [](auto& c) {
         c.arrays.parameters.items[2].allowed_is_list = 1;
         c.arrays.parameters.items[2].allowed_count = none;
         c.arrays.parameters.items[1].allowed_count = 1;
       }},
  });
}

TEST(Verify, RefusesGroups) {
  expect_faults({
      {"task 4: its place in the catalog is 10 of 10",
       [](auto& c) { c.arrays.tasks[4].catalog_index = 10; }},
      {"entry 1 of 'task_ids' does not follow from the other arrays",
       [](auto& c) { c.arrays.tasks[1].catalog_index = 0; }},
      {"entry 2 of 'task_ids' does not follow from the other arrays",
       [](auto& c) {
         std::swap(c.arrays.tasks[1].catalog_index, c.arrays.tasks[2].catalog_index);
         std::swap(c.arrays.task_ids[2], c.arrays.task_ids[4]);
       }},
      {"entry 1 of 'task_ids' does not follow from the other arrays",
       [](auto& c) {  // B and F
         std::swap(c.arrays.tasks[4].catalog_index, c.arrays.tasks[6].catalog_index);
         std::swap(c.arrays.tasks[4].catalog_index, c.arrays.tasks[5].catalog_index);
         std::swap(c.arrays.task_ids[1], c.arrays.task_ids[5]);
         const std::array ids{0, 6, 1, 4, 2, 5, 3, 7, 8, 9};
         c.arrays.task_ids = std::vector<TaskId>(ids.begin(), ids.end());
       }},
      {"behavior 0: its place in the catalog is 4294967295 of 81",
       [](auto& c) { c.arrays.behaviors[0].catalog_index = none; }},
      {"entry 0 of 'behavior_ids' does not follow from the other arrays",
       [](auto& c) { c.arrays.behaviors[7].catalog_index = 8; }},
      {"entry 2 of 'behavior_ids' does not follow from the other arrays",
       [](auto& c) {
         std::swap(c.arrays.behaviors[1].catalog_index, c.arrays.behaviors[2].catalog_index);
         std::swap(c.arrays.behavior_ids[2], c.arrays.behavior_ids[3]);
       }},
      {"entry 8 of 'tasks' does not follow from the other arrays",
       [](auto& c) { c.arrays.tasks[8].group = GroupId(7); }},
  });
}

TEST(Verify, RefusesAttributes) {
  expect_faults({
      {"task 0: a flag is neither 0 nor 1",
       [](auto& c) { c.arrays.tasks[0].start_on_request = 2; }},
      {"task 3: a flag is neither 0 nor 1",
       [](auto& c) { c.arrays.tasks[3].reactive_start = 255; }},
      {"task 3: a flag is neither 0 nor 1", [](auto& c) { c.arrays.tasks[3].keep_running = 2; }},
      {"task 4 has both reactive_start and start_on_request",
       [](auto& c) { c.arrays.tasks[4].start_on_request = 1; }},
      {"task 0: its timeout of -1 us is out of range",
       [](auto& c) { c.arrays.tasks[0].timeout = -1; }},
      {"task 0: its timeout of 1000000000000001 us is out of range",
       [](auto& c) { c.arrays.tasks[0].timeout = longest_time + 1; }},
      {"behavior 3: its timeout of -2500000 us is out of range",
       [](auto& c) { c.arrays.behaviors[3].timeout = -2'500'000; }},
      {"task 2: its minimum performance of 1000001 millionths is over 1",
       [](auto& c) { c.arrays.tasks[2].minimum_performance = 1'000'001; }},
      {"task 0: the cost of its minimum performance is wrong",
       [](auto& c) { ++c.arrays.tasks[0].minimum_cost; }},
      {"task 0: the cost of its minimum performance is wrong",
       [](auto& c) { ++c.arrays.tasks[0].minimum_performance; }},
      // C has a minimum through the behavior that it shares with A only.
  });
}

TEST(Verify, RefusesValues) {
  expect_faults({
      {"behavior 6 performs no task",
       [](auto& c) { c.arrays.values.items[7].behavior = BehaviorId(5); }},
      {"task 0 has a value with behavior 4294967295 of 81",
       [](auto& c) { c.arrays.values.items[0].behavior = none; }},
      {"task 5 has a value with a suitability of 2000000 millionths, which is over 1",
       [](auto& c) { c.arrays.values.items[8].suitability = 2'000'000; }},
      {"task 5 has a value with a wrong cost", [](auto& c) { --c.arrays.values.items[9].cost; }},
      {"task 5 has a value with a wrong cost",
       [](auto& c) { c.arrays.values.items[9].suitability = 910'000; }},
      {"entry 4 of 'value_tasks' does not follow from the other arrays",
       [](auto& c) { c.arrays.value_tasks[4] = TaskId(2); }},
      {"the values of task 0 are not in rank order",
       [](auto& c) { std::swap(c.arrays.values.items[0], c.arrays.values.items[1]); }},
      {"the values of task 0 are not in rank order",
       [](auto& c) { std::swap(c.arrays.values.items[1], c.arrays.values.items[2]); }},
      {"the values of task 0 are not in rank order",
       [](auto& c) { c.arrays.values.items[2].behavior = BehaviorId(1); }},
      {"entry 7 of 'words' does not follow from the other arrays",
       [](auto& c) { ++c.arrays.words[7]; }},
      {"entry 2 of 'performs' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.performs.items[2], c.arrays.performs.items[3]); }},
      {"entry 5 of 'performs' does not follow from the other arrays",
       [](auto& c) { c.arrays.performs.items[5] = ValueId(82); }},
      {"behavior 2 performs no task",
       [](auto& c) {  // a3 performs nothing, c1 two tasks
         --c.arrays.performs.begin[3];
         c.arrays.values.items[2].behavior = BehaviorId(3);
       }},
      {"entry 0 of 'performs' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.performs.items[0], c.arrays.performs.items[1]); }},
      {"behavior 0 performs task 0 twice",
       [](auto& c) {  // a1 performs A twice, and a2 what a1 did: C
         c.arrays.values.items[1].behavior = BehaviorId(0);
         c.arrays.values.items[3].behavior = BehaviorId(1);
         c.arrays.performs.items[1] = ValueId(1);
         c.arrays.performs.items[2] = ValueId(3);
       }},
  });
}

TEST(Verify, RefusesRequirements) {
  expect_faults({
      {"behavior 0 requires task 4294967295 of 10",
       [](auto& c) { c.arrays.requirements.items[0].task = none; }},
      {"behavior 0 requires 1000001 millionths of task 2, which is over 1",
       [](auto& c) { c.arrays.requirements.items[0].minimum_performance = 1'000'001; }},
      {"behavior 6: the cost of what it requires of task 5 is wrong",
       [](auto& c) { c.arrays.requirements.items[2].minimum_cost = 0; }},
      {"the tasks that behavior 0 requires do not ascend",
       [](auto& c) { c.arrays.requirements.begin[1] = 2; }},
      {"entry 0 of 'behaviors' does not follow from the other arrays",
       [](auto& c) { c.arrays.behaviors[0].level = 0; }},
      // a2 requires the task that it performs.
      {"the requirements are cyclic",
       [](auto& c) {
         c.arrays.requirements.items[1].task = TaskId(0);
         c.arrays.masks.push_back(0);
       }},
  });
}

TEST(Verify, RefusesArcs) {
  expect_faults({
      {"entry 0 of 'arcs' does not follow from the other arrays",
       [](auto& c) { c.arrays.arcs.items[0].source = TaskId(1); }},
      {"entry 3 of 'arcs' does not follow from the other arrays",
       [](auto& c) {  // in another order
         std::swap(c.arrays.arcs.items[3].target, c.arrays.arcs.items[4].target);
       }},
      {"entry 0 of 'masks' does not follow from the other arrays",
       [](auto& c) { c.arrays.masks[0] = 1; }},
      {"entry 6 of 'masks' does not follow from the other arrays",
       [](auto& c) { c.arrays.masks[6] |= std::uint64_t{1} << 63; }},
      {"more than 6 masks are needed", [](auto& c) { c.arrays.masks.pop_back(); }},
      {"'masks' has 8 entries, expected 7", [](auto& c) { c.arrays.masks.push_back(0); }},
      {"entry 0 of 'incoming' does not follow from the other arrays",
       [](auto& c) { c.arrays.incoming.items[0] = 2; }},
      {"entry 0 of 'incoming' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.incoming.items[0], c.arrays.incoming.items[1]); }},
  });
}

TEST(Verify, RefusesLevelsAndOrder) {
  expect_faults({
      {"entry 0 of 'topological_order' does not follow from the other arrays",
       [](auto& c) { c.arrays.topological_order[0] = TaskId(10); }},
      {"entry 3 of 'topological_order' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.topological_order[3], c.arrays.topological_order[4]); }},
      {"entry 0 of 'topological_order' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.topological_order[0], c.arrays.topological_order[1]); }},
      {"entry 1 of 'topological_order' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.topological_order[1], c.arrays.topological_order[2]); }},
  });
}

TEST(Verify, RefusesCliques) {
  expect_faults({
      {"clique 0 has 1 tasks, expected at least 2", [](auto& c) { c.arrays.cliques.begin[1] = 1; }},
      {"clique 0 has 0 tasks, expected at least 2", [](auto& c) { c.arrays.cliques.begin[1] = 0; }},
      {"clique 2 has 0 tasks, expected at least 2", [](auto& c) { c.arrays.cliques.begin[2] = 6; }},
      {"the tasks of clique 2 do not ascend",
       [](auto& c) { c.arrays.cliques.items[4] = TaskId(10); }},
      {"the tasks of clique 0 do not ascend",
       [](auto& c) { std::swap(c.arrays.cliques.items[0], c.arrays.cliques.items[1]); }},
      {"the tasks of clique 0 do not ascend",
       [](auto& c) { c.arrays.cliques.items[1] = TaskId(0); }},
      {"clique 2 has task 4294967295 of 10", [](auto& c) { c.arrays.cliques.items[5] = none; }},
      {"cliques 0 and 1 are not in order",
       [](auto& c) {  // the same twice
         c.arrays.cliques.items[2] = TaskId(0);
         c.arrays.cliques.items[3] = TaskId(1);
       }},
      {"cliques 0 and 1 are not in order",
       [](auto& c) {
         const std::array tasks{1, 3, 0, 1, 8, 9};
         c.arrays.cliques.items = std::vector<TaskId>(tasks.begin(), tasks.end());
         c.arrays.task_cliques.items = {1, 0, 1, 0, 2, 2};
       }},
      {"entry 1 of 'task_cliques' does not follow from the other arrays",
       [](auto& c) { std::swap(c.arrays.task_cliques.items[1], c.arrays.task_cliques.items[2]); }},
      {"entry 5 of 'task_cliques' does not follow from the other arrays",
       [](auto& c) { c.arrays.task_cliques.items[5] = 3; }},
      {"entry 1 of 'task_cliques_begin' does not follow from the other arrays",
       [](auto& c) { c.arrays.task_cliques.begin[1] = 0; }},
  });
}

TEST(Verify, RefusesSituationVariables) {
  expect_faults({
      {"variable 0 has 1 values, expected 2 or more",
       [](auto& c) {
         c.arrays.variables[0].value_count = 1;
         c.arrays.variables[1].first_value = 1;
         c.arrays.variable_values.resize(3);
       }},
      {"'variable_values' has 4 entries, expected 5",
       [](auto& c) { c.arrays.variable_values.pop_back(); }},
      {"the values of variable 1 begin at 2, expected 3",
       [](auto& c) { c.arrays.variables[1].first_value = 2; }},
      {"variable 1 has no name", [](auto& c) { c.arrays.variables[1].name = none; }},
      {"variable 1: a flag is neither 0 nor 1",
       [](auto& c) { c.arrays.variables[1].is_boolean = 2; }},
      {"variable 0 is a flag, but its values are not true and false",
       [](auto& c) { c.arrays.variables[0].is_boolean = 1; }},
      {"variable 0 has a value twice",
       [](auto& c) { c.arrays.variable_values[1] = c.arrays.variable_values[0]; }},
      {"variable 0 has a value twice",
       [](auto& c) { c.arrays.variable_values[2] = c.arrays.variable_values[0]; }},
      {"the name 'LIGHT' of a variable is not unique",
       [](auto& c) { c.arrays.variables[1].name = c.arrays.variables[0].name; }},
      {"the name 'b1' of a variable is not unique",
       [](auto& c) { c.arrays.variables[1].name = 10; }},
      {"'fitting_values' do not ascend",
       [](auto& c) { std::swap(c.arrays.fitting_values[0], c.arrays.fitting_values[1]); }},
      {"'fitting_values' do not ascend",
       [](auto& c) { c.arrays.fitting_values[1] = c.arrays.fitting_values[0]; }},
  });
  const CompiledCatalog catalog = rich_catalog();
  const std::uint32_t last_variable = catalog.fitting_values.back().variable;
  using Change = void (*)(FittingValue&, std::uint32_t);
  const std::pair<Change, std::size_t> counts[] = {
      {[](FittingValue& of, std::uint32_t number) { of.behavior = BehaviorId(number); },
       catalog.behaviors.size()},
      {[](FittingValue& of, std::uint32_t number) { of.variable = number; },
       catalog.variables.size()},
      {[](FittingValue& of, std::uint32_t number) { of.value = number; },
       catalog.variables[last_variable].value_count}};
  for (const auto& [change, count] : counts) {
    for (const std::uint32_t number : {static_cast<std::uint32_t>(count), std::uint32_t{none}}) {
      EditableCatalog edited(rich_catalog());
      change(edited.arrays.fitting_values.back(), number);
      EXPECT_NE(fault_of(edited.catalog()).find("but there is no such behavior"),
                std::string::npos);
    }
  }
}

TEST(Verify, RefusesTwoGroupsInOne) {
  // F and the group of W.
  EditableCatalog edited(rich_catalog());
  GrowingCatalog& arrays = edited.arrays;
  arrays.group_tasks.erase(arrays.group_tasks.begin() + 3);
  arrays.group_behaviors.erase(arrays.group_behaviors.begin() + 3);
  for (TaskId task(7); task < 10; ++task) arrays.tasks[task].group = GroupId(2);
  EXPECT_EQ(fault_of(edited.catalog()), "'group_tasks' has 4 entries, expected 5");
}

TEST(Verify, TasksAreConnectedByRequirementsCliquesAndBehaviors) {
  EXPECT_EQ(fault_of(compile_text("behaviors:\n"
                                  "- {behavior: a, task: A, requires: [{task: D}]}\n"
                                  "- {behavior: b, tasks: [{task: B}, {task: C}]}\n"
                                  "- {behavior: d, task: D}\n"
                                  "- {behavior: e, tasks: [{task: E}, {task: C}]}\n"
                                  "exclusivity_constraints:\n"
                                  "- {mutually_exclusive: [D, E]}\n")),
            "no fault");
}

TEST(Verify, RefusesEveryArrayThatIsShorterOrLonger) {
  const CompiledCatalog catalog = rich_catalog();
  EditableCatalog edited(catalog);
  std::size_t arrays = 0;
  edited.for_each_array([&](std::string_view name, auto& array) {
    const auto original = array;
    ASSERT_FALSE(array.empty()) << name;
    array.pop_back();
    // Nothing depends on how often behaviors name values.
    EXPECT_EQ(fault_of(edited.catalog()) == "no fault", name == "fitting_values") << name;
    array.clear();
    EXPECT_EQ(fault_of(edited.catalog()) == "no fault", name == "fitting_values") << name;
    array = original;
    array.push_back(original.back());
    // A text that nobody uses does no harm.
    EXPECT_EQ(fault_of(edited.catalog()) == "no fault", name == "texts_begin") << name;
    array = original;
    ++arrays;
  });
  EXPECT_EQ(arrays, 46U);
  EXPECT_EQ(fault_of(edited.catalog()), "no fault");
}

// Changes of single numbers ----------------------------------------------------------------------

/// What a catalog may say in one way or another, while all else stays as it is. Of degrees that is
/// so because 0 and 1 have the same cost.
const std::set<std::string_view> free_fields{
    "texts_begin",
    "texts",
    "behavior_packages",
    "parameters_begin",
    "parameter.name",
    "parameter.allowed_is_list",
    "allowed_values",
    "task.timeout",
    "task.start_on_request",
    "task.reactive_start",
    "task.keep_running",
    "task.minimum_performance",
    "task.minimum_line",
    "behavior.timeout",
    "value.suitability",
    "requirement.minimum_performance",
    "requirement_lines",
    "clique_lines",
    "variable.name",
    "variable.is_boolean",
    "variable_values",
    "fitting.behavior",
    "fitting.variable",
    "fitting.value",
    "task_rules",
    "retries",
    "improve_lines",
    "retry_lines",
    "limits",
};

/// Counts, by field, the changes that were accepted and those that were refused.
class Changes {
 public:
  /// `numbers` are those of `edited`; the number is as before afterwards.
  void make(const EditableCatalog& edited, const EditableCatalog::Number& number,
            std::uint64_t value) {
    const std::uint64_t before = number.get();
    number.set(value);
    if (number.get() != before) judge(edited.catalog(), number.field);
    number.set(before);
  }

  /// That no test is empty: what is derived was refused at least once.
  void expect_refusals(std::size_t fields) const {
    EXPECT_EQ(counts_.size(), fields);
    for (const auto& [field, count] : counts_) {
      EXPECT_TRUE(count.refused > 0 || free_fields.contains(field)) << field;
    }
  }

  void expect_other_catalogs() const {
    for (const std::string_view field : free_fields) {
      EXPECT_GT(counts_.at(field).accepted, 0U) << field;
    }
  }

 private:
  struct Count {
    std::size_t accepted = 0;
    std::size_t refused = 0;
  };

  void judge(const CompiledCatalog& changed, std::string_view field) {
    if (find_fault(changed)) {
      ++counts_[field].refused;
      return;
    }
    ++counts_[field].accepted;
    EXPECT_TRUE(free_fields.contains(field)) << field;
    EXPECT_EQ(difference(compile(describe_compiled(changed)), changed), "") << field;
  }

  std::map<std::string_view, Count> counts_;
};

TEST(Verify, RefusesEveryChangeOfWhatIsDerived) {
  EditableCatalog edited(rich_catalog());
  Changes changes;
  for (const EditableCatalog::Number& number : edited.numbers()) {
    const std::uint64_t before = number.get();
    for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1}, before - 1, before + 1,
                                      before ^ 128, std::uint64_t{one_million}, UINT64_MAX}) {
      changes.make(edited, number, value);
    }
  }
  changes.expect_refusals(72);
  changes.expect_other_catalogs();
}

TEST(Verify, RandomChangesMakeAFaultOrAnotherCatalog) {
  Random random(2);
  Changes changes;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    EditableCatalog edited(compile(random_rich_catalog(random)));
    const std::vector<EditableCatalog::Number> numbers = edited.numbers();
    for (int change = 0; change < 250; ++change) {
      const EditableCatalog::Number& number = random.pick(numbers);
      const std::array values{random.next(),
                              std::uint64_t{random.below(20)},
                              number.get() + static_cast<std::uint64_t>(random.between(-3, 3)),
                              number.get() ^ (std::uint64_t{1} << random.below(64)),
                              random.pick(numbers).get(),
                              random.percent(50) ? std::uint64_t{0} : std::uint64_t{one_million}};
      changes.make(edited, number, values.at(random.below(values.size())));
    }
  }
  changes.expect_refusals(55);  // without situation variables
}

TEST(Verify, SeveralRandomChangesMakeAFaultOrAnotherCatalog) {
  Random random(3);
  std::size_t accepted = 0;
  for (int i = 0; i < test::rounds(5'000); ++i) {
    SCOPED_TRACE(i);
    test::Shape shape;
    shape.tasks = 3;
    EditableCatalog edited(compile(test::random_catalog(random, shape)));
    const std::vector<EditableCatalog::Number> numbers = edited.numbers();
    for (int change = 0; change < 2; ++change) {
      random.pick(numbers).set(random.below(4));
    }
    const CompiledCatalog changed = edited.catalog();
    if (find_fault(changed)) continue;
    ++accepted;
    EXPECT_EQ(difference(compile(describe_compiled(changed)), changed), "");
  }
  EXPECT_GT(accepted, test::rounds(20U));
}

}  // namespace
}  // namespace cbc::verify_test
