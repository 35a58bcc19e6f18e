// What a model can hold, and which requests interact, compared with the definition.
#include "explore/model/model.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "explore/properties/explore.h"
#include "runtime/base/disjoint_sets.h"
#include "runtime/compiled/compiled_catalog.h"
#include "support/exclusive_tasks.h"
#include "support/rounds.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"
#include "versions/lockstep/same_as.h"

namespace cbc::model_test {
namespace {

using test::compile_text;
using test::Random;

std::vector<GroupId> all_groups(const CompiledCatalog& catalog) {
  std::vector<GroupId> groups;
  for (GroupId group(0); group < catalog.group_count(); ++group) groups.push_back(group);
  return groups;
}

std::string behaviors_of_one_task(std::size_t count) {
  std::string text = "situation: [{variable: V}]\nbehaviors:\n";
  for (std::size_t place = 0; place < count; ++place) {
    text += "- {behavior: B" + std::to_string(place) + ", task: T, situation: {V: true}}\n";
  }
  return text + "- {behavior: LAST, task: T}\ntasks: [{task: T}]\n";
}

/// A cell has 16 bits. In the last state that it cannot hold, only the last behavior fits.
TEST(Model, RefusesMoreBehaviorsThanACellHolds) {
  for (const std::size_t count :
       {Model::most_in_cell - 1, Model::most_in_cell, std::size_t{65'535}}) {
    const CompiledCatalog catalog = compile_text(behaviors_of_one_task(count));
    Assumptions assumptions = default_assumptions(catalog);
    assumptions.variables.clear();
    assumptions.initially.variables.push_back({0, 1});
    Property never_runs;
    never_runs.kind = Property::Kind::never;
    never_runs.condition = StateCondition::of_task(StateCondition::Kind::running, TaskId(0));
    const Exploration exploration = explore(catalog, {GroupId(0)}, assumptions, {&never_runs}, {});
    if (count < Model::most_in_cell) {
      EXPECT_FALSE(exploration.error);
      EXPECT_EQ(exploration.verdicts[0].result, Verdict::Result::violated) << count;
    } else {
      ASSERT_TRUE(exploration.error) << count;
      EXPECT_TRUE(exploration.error->starts_with("too large to explore: ")) << *exploration.error;
      EXPECT_NE(exploration.verdicts[0].result, Verdict::Result::proved) << count;
    }
  }
}

TEST(Model, RefusesMorePrioritiesThanACellHolds) {
  const CompiledCatalog catalog =
      compile_text("behaviors: [{behavior: B, task: T}]\ntasks: [{task: T}]\n");
  Assumptions assumptions = default_assumptions(catalog);
  auto& priorities = assumptions.start[0].priorities;
  for (std::int32_t priority = 2; priorities.size() < Model::most_in_cell - 1; ++priority) {
    priorities.push_back(priority);
  }
  EXPECT_FALSE(Model(catalog, {GroupId(0)}, assumptions).find_obstacle());
  priorities.push_back(1'000'000);  // and that of reactive starts
  EXPECT_TRUE(Model(catalog, {GroupId(0)}, assumptions).find_obstacle());
}

TEST(Model, RefusesMoreValuesThanACellHolds) {
  std::string values = "a";
  for (std::size_t value = 0; value < Model::most_in_cell; ++value) {
    values += ", v" + std::to_string(value);
  }
  const CompiledCatalog catalog =
      compile_text("situation: [{variable: V, values: [" + values +
                   "]}]\nbehaviors: [{behavior: B, task: T, situation: {V: a}}]\n");
  EXPECT_TRUE(Model(catalog, {GroupId(0)}, default_assumptions(catalog)).find_obstacle());
}

/// For each value there is a set of the behaviors that do not fit.
TEST(Model, RefusesTooManyBehaviorsTimesValues) {
  std::string values = "v0";
  for (int value = 1; value < 33'500; ++value) values += ", v" + std::to_string(value);
  std::string text = "situation: [{variable: V, values: [" + values + "]}]\nbehaviors:\n";
  for (int behavior = 0; behavior < 32'064; ++behavior) {
    text += "- {behavior: B" + std::to_string(behavior) + ", task: T, situation: {V: v0}}\n";
  }
  const CompiledCatalog catalog = compile_text(text);
  EXPECT_TRUE(Model(catalog, {GroupId(0)}, default_assumptions(catalog)).find_obstacle());
}

TEST(Model, RefusesMoreTasksThanACellHolds) {
  const CompiledCatalog catalog = compile_text(test::exclusive_tasks(Model::most_in_cell + 1));
  ASSERT_EQ(catalog.group_count(), 1U);
  EXPECT_TRUE(Model(catalog, {GroupId(0)}, default_assumptions(catalog)).find_obstacle());
}

/// What is found in the first moves stays true when a limit comes right after them.
TEST(Model, KeepsADifferenceThatALimitFollows) {
  const std::string common =
      ", {behavior: B, task: U}]\nexclusivity_constraints: [{mutually_exclusive: [T, U]}]\n";
  const CompiledCatalog before = compile_text("behaviors: [{behavior: OLD, task: T}" + common);
  const CompiledCatalog after = compile_text("behaviors: [{behavior: NEW, task: T}" + common);
  ExplorationOptions options;
  int looks = 0;
  // Before the pair of groups, and before its first state.
  options.budget.is_stopped = [&looks] { return ++looks > 2; };
  ComparisonScope scope;
  scope.allow_missing = true;  // or else the behaviors are looked for first
  const CatalogComparison comparison =
      compare_catalogs(before, after, common_assumptions(before, after), options, scope);
  EXPECT_EQ(comparison.result, Verdict::Result::violated);
  EXPECT_TRUE(comparison.end);
  ASSERT_NE(comparison.first_difference(), nullptr);
  EXPECT_EQ(comparison.first_difference()->moves.size(), 1U);
}

/// Going through all old moves for each new one would take hours here.
TEST(Model, PairsVeryManyMoves) {
  const CompiledCatalog catalog = compile_text(behaviors_of_one_task(Model::most_in_cell - 1));
  ExplorationOptions options;
  options.budget.max_states = 1;
  const CatalogComparison comparison =
      compare_catalogs(catalog, catalog, common_assumptions(catalog, catalog), options, {});
  EXPECT_FALSE(comparison.error);
  EXPECT_EQ(comparison.result, Verdict::Result::undecided);
}

/// The classes as Model::interaction_classes() defines them, pair by pair.
std::vector<std::uint32_t> plain_classes(const Model& model) {
  const CompiledCatalog& catalog = model.catalog();
  const auto count = static_cast<std::uint32_t>(model.tasks().size());
  std::vector<std::set<TaskId>> needs(count);
  std::vector<std::set<TaskId>> rivals(count);
  std::vector<bool> has_minimum(count, false);
  for (std::uint32_t task = 0; task < count; ++task) {
    std::vector<TaskId> open{model.tasks()[task].id};
    while (!open.empty()) {
      const TaskId needed = open.back();
      open.pop_back();
      if (!needs[task].insert(needed).second) continue;
      if (catalog.tasks[needed].has_performance_rules != 0) has_minimum[task] = true;
      for (const std::uint32_t clique : catalog.task_cliques[needed]) {
        for (const TaskId rival : catalog.cliques[clique]) {
          if (rival != needed) rivals[task].insert(rival);
        }
      }
      for (const Arc& arc : catalog.arcs[needed]) open.push_back(arc.target);
    }
  }
  const auto meet = [](const std::set<TaskId>& a, const std::set<TaskId>& b) {
    return std::any_of(a.begin(), a.end(), [&](TaskId task) { return b.contains(task); });
  };
  std::set<std::uint32_t> requestable(model.reactive().begin(), model.reactive().end());
  for (const Assumptions::Start& start : model.assumptions().start) {
    requestable.insert(model.find_task(start.task));
  }
  DisjointSets classes(count);
  for (const std::uint32_t a : requestable) {
    for (const std::uint32_t b : requestable) {
      if (a == b || model.tasks()[a].group != model.tasks()[b].group) continue;
      const bool shares_minimum = (has_minimum[a] || has_minimum[b]) && meet(needs[a], needs[b]);
      if (shares_minimum || meet(rivals[a], needs[b])) classes.join(a, b);
    }
  }
  std::vector<std::uint32_t> result = classes.numbers();
  for (std::uint32_t task = 0; task < count; ++task) {
    if (!requestable.contains(task)) result[task] = none;
  }
  return result;
}

TEST(Model, InteractionsAreThoseOfTheDefinition) {
  Random random(7);
  std::size_t several = 0;
  for (int round = 0; round < test::rounds(1'000); ++round) {
    test::Shape shape;
    shape.tasks = 2 + static_cast<std::uint32_t>(random.below(11));
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Assumptions assumptions = default_assumptions(catalog);
    const Model model(catalog, all_groups(catalog), assumptions);
    const std::vector<std::uint32_t> expected = plain_classes(model);
    ASSERT_EQ(model.interaction_classes(), expected) << round;
    for (std::uint32_t task = 0; task < model.tasks().size(); ++task) {
      ASSERT_EQ(model.find_task(model.tasks()[task].id), task);
    }
    std::set<std::uint32_t> classes(expected.begin(), expected.end());
    classes.erase(none);
    if (classes.size() > catalog.group_count()) ++several;
  }
  EXPECT_GT(several, test::rounds(50));
}

}  // namespace
}  // namespace cbc::model_test
