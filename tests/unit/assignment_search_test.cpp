// What the questions of lint's proofs take: so much that their number is bounded.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ask/ask.h"
#include "ask/liveness.h"
#include "unit/compiled_fixture.h"

namespace cbc::assignment_search_test {
namespace {

constexpr std::uint64_t most_nodes = 100'000;

/// Each bound of a performance goes down the whole chain.
TEST(AssignmentSearch, BoundsOfPerformancesCount) {
  constexpr int length = 1600;
  std::string text = "behaviors:\n";
  for (int task = 0; task < length; ++task) {
    const std::string number = std::to_string(task);
    text += "- {behavior: B" + number + ", task: T" + number + ", suitability: 99.9";
    if (task + 1 < length) {
      text += ", requires: [{task: T" + std::to_string(task + 1) + ", minimum_performance: 1}]";
    }
    text += "}\n";
  }
  AssignmentSearch search(test::compile_text(text), most_nodes, Effort(most_effort_of_assignments));
  const std::vector<TaskId> tasks = tasks_by_level(search.catalog());
  std::size_t asked = 0;
  while (asked < tasks.size() && !search.is_exhausted()) {
    (void)search.best_performance(tasks[asked++], false);
  }
  EXPECT_TRUE(search.is_exhausted());
  EXPECT_GT(asked, tasks.size() / 4) << "ordinary catalogs must be far from it";
  EXPECT_EQ(search.best_performance(tasks.front(), false).exists, Feasibility::unknown);
}

/// Each question looks at the conditions of all behaviors of the group.
TEST(AssignmentSearch, ConditionsCount) {
  std::string text = "situation: [{variable: V}]\nbehaviors:\n";
  for (int behavior = 0; behavior < 20'000; ++behavior) {
    text += "- {behavior: B" + std::to_string(behavior) + ", task: T, situation: {V: true}}\n";
  }
  AssignmentSearch search(test::compile_text(text), most_nodes, Effort(most_effort_of_assignments));
  const SituationSpace space(search.catalog(), {}, {});
  Ask ask(search, space);
  const Asked runs_with_first = {{GroupId(0), {{Demand::Kind::has, TaskId(0), 0}}}};
  EXPECT_EQ(ask.find(runs_with_first, {1, 0}), Feasibility::yes);
  int asked = 0;
  while (asked < 10'000 && ask.find(runs_with_first, {0, 1}) == Feasibility::no) ++asked;
  EXPECT_TRUE(search.is_exhausted());
  EXPECT_GT(asked, 1000);
}

}  // namespace
}  // namespace cbc::assignment_search_test
