// The search that learns: problems that branch and bound alone does not finish.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/solver/checker.h"
#include "runtime/solver/solver.h"
#include "runtime/solver/trail.h"
#include "support/rounds.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::learning_search_test {
namespace {

struct Answer {
  SearchResult result;
  Assignment solution;
  std::string text;
};

Answer solve(const CompiledCatalog& catalog, const Problem& problem, std::uint64_t bounded_nodes) {
  SearchOptions options;
  options.bounded_nodes = bounded_nodes;
  options.max_nodes = 20'000;
  Solver solver(catalog, options);
  Answer answer;
  answer.result = solver.solve(problem, answer.solution);
  if (has_solution(answer.result.status)) answer.text = test::show(catalog, answer.solution);
  return answer;
}

/// A task that requires three others, each of which fits into one of `holes`, and 20 that have two
/// ways each and nothing to do with it. A minimum performance keeps all of it together.
CompiledCatalog catalog_with_holes(int holes) {
  std::string behaviors;
  std::string required = "{task: A}, {task: B}, {task: C}";
  for (int i = 0; i < 20; ++i) {
    required += fmt::format(", {{task: P{}}}", i);
    for (const char way : {'Q', 'R'}) {
      behaviors += fmt::format(
          "- {{behavior: p{0}{1}, task: P{0}, requires: [{{task: {1}{0}}}]}}\n"
          "- {{behavior: {1}{0}, task: {1}{0}, suitability: 90}}\n",
          i, way);
    }
  }
  std::string lists;
  for (int hole = 0; hole < holes; ++hole) {
    lists += fmt::format("- mutually_exclusive: [A{0}, B{0}, C{0}]\n", hole);
    for (const char task : {'A', 'B', 'C'}) {
      behaviors += fmt::format(
          "- {{behavior: {0}_in_{1}, task: {0}, requires: [{{task: {0}{1}}}]}}\n"
          "- {{behavior: {0}{1}, task: {0}{1}}}\n",
          task, hole);
    }
  }
  return test::compile_text(
      fmt::format("default_values: {{tasks: {{start_on_request: false}}}}\n"
                  "behaviors:\n- {{behavior: all, task: ALL, requires: [{}]}}\n{}"
                  "tasks:\n- {{task: ALL, minimum_performance: 1}}\nexclusivity_constraints:\n{}",
                  required, behaviors, lists));
}

TEST(LearningSearch, RefutesWhatBacktrackingDoesNot) {
  const CompiledCatalog catalog = catalog_with_holes(2);
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "ALL");
  EXPECT_EQ(solve(catalog, problem, UINT64_MAX).result.status, SearchStatus::unknown);
  const Answer learned = solve(catalog, problem, SearchOptions{}.bounded_nodes);
  EXPECT_EQ(learned.result.status, SearchStatus::infeasible);
  EXPECT_LT(learned.result.nodes, 500U);
}

TEST(LearningSearch, DropsTheRequestThatHasNoPlace) {
  const CompiledCatalog catalog = catalog_with_holes(2);
  Problem problem = test::open_problem(catalog);
  for (const char* task : {"P0", "C", "A", "B", "P1"}) test::request(problem, catalog, task);
  const Answer learned = solve(catalog, problem, 0);
  EXPECT_EQ(learned.result.status, SearchStatus::optimal);
  EXPECT_EQ(learned.text.find("B="), std::string::npos) << learned.text;
  for (const char* task : {"P0=", "C=", "A=", "P1="}) {
    EXPECT_NE(learned.text.find(task), std::string::npos) << learned.text;
  }
}

TEST(LearningSearch, EndsLikeBranchAndBoundWithTheFirstSolutionIfAnyWillDo) {
  const CompiledCatalog catalog = catalog_with_holes(3);
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "ALL");
  for (const std::uint64_t bounded_nodes : {std::uint64_t{0}, UINT64_MAX}) {
    SearchOptions options;
    options.any_solution = true;
    options.easy_nodes = 0;
    options.bounded_nodes = bounded_nodes;
    Solver solver(catalog, options);
    Assignment solution;
    const SearchResult result = solver.solve(problem, solution);
    EXPECT_TRUE(has_solution(result.status));
    EXPECT_EQ(result.solutions, 1U);
    EXPECT_EQ(Checker(catalog).find_violation(problem, solution), std::nullopt);
  }
}

/// `tasks` that each need another one of `places`, for all of which `ALL` asks. `degrees`: their
/// suitabilities by task and place, in percent.
CompiledCatalog assignment_catalog(std::size_t tasks, std::size_t places,
                                   const std::vector<std::vector<int>>& degrees) {
  std::string required;
  std::string behaviors;
  for (std::size_t task = 0; task < tasks; ++task) {
    required += fmt::format("{}{{task: T{}}}", task > 0 ? ", " : "", task);
    for (std::size_t place = 0; place < places; ++place) {
      behaviors += fmt::format(
          "- {{behavior: t{0}_{1}, task: T{0}, suitability: {2}, requires: [{{task: P{0}_{1}}}]}}\n"
          "- {{behavior: p{0}_{1}, task: P{0}_{1}}}\n",
          task, place, degrees.empty() ? 100 : degrees[task][place]);
    }
  }
  std::string lists;
  for (std::size_t place = 0; place < places; ++place) {
    std::string list;
    for (std::size_t task = 0; task < tasks; ++task) {
      list += fmt::format("{}P{}_{}", task > 0 ? ", " : "", task, place);
    }
    lists += fmt::format("- mutually_exclusive: [{}]\n", list);
  }
  return test::compile_text(
      fmt::format("default_values: {{tasks: {{start_on_request: false}}}}\n"
                  "behaviors:\n- {{behavior: all, task: ALL, requires: [{}]}}\n{}"
                  "tasks: [{{task: ALL}}]\nexclusivity_constraints:\n{}",
                  required, behaviors, lists));
}

/// Thousands of conflicts: it restarts, and forgets no-goods. The effort is no more than it was
/// when it was measured: see search_effort_test.cpp.
TEST(LearningSearch, RefutesOneTaskMoreThanPlaces) {
  std::uint64_t nodes = 0;
  std::uint64_t propagations = 0;
  for (std::size_t places = 2; places <= 7; ++places) {
    const CompiledCatalog catalog = assignment_catalog(places + 1, places, {});
    Problem problem = test::open_problem(catalog);
    test::demand(problem, catalog, "ALL");
    const Answer learned = solve(catalog, problem, 0);
    EXPECT_EQ(learned.result.status, SearchStatus::infeasible) << places;
    nodes += learned.result.nodes;
    propagations += learned.result.propagations;
  }
  EXPECT_LE(nodes, 10'508U);
  EXPECT_LE(propagations, 456'666U);
}

TEST(LearningSearch, FindsTheBestAssignment) {
  test::Random random(1);
  constexpr std::size_t size = 6;
  for (int round = 0; round < test::rounds(10); ++round) {
    std::vector<std::vector<int>> degrees(size, std::vector<int>(size));
    for (std::vector<int>& of_task : degrees) {
      for (int& degree : of_task) degree = 50 + static_cast<int>(random.below(51));
    }
    std::vector<std::size_t> places(size);
    std::iota(places.begin(), places.end(), 0U);
    std::int64_t best = 0;
    do {
      std::int64_t product = 1;
      for (std::size_t task = 0; task < size; ++task) product *= degrees[task][places[task]];
      best = std::max(best, product);
    } while (std::next_permutation(places.begin(), places.end()));

    const CompiledCatalog catalog = assignment_catalog(size, size, degrees);
    Problem problem = test::open_problem(catalog);
    test::demand(problem, catalog, "ALL");
    const Answer learned = solve(catalog, problem, 0);
    EXPECT_EQ(learned.result.status, SearchStatus::optimal);
    std::int64_t product = 1;
    for (std::size_t task = 0; task < size; ++task) {
      const LocalTask local = test::local_task(catalog, fmt::format("T{}", task));
      const Value& value =
          catalog.values[catalog.group_tasks[problem.group] + local][learned.solution[local]];
      product *= value.suitability / 10'000;
    }
    EXPECT_EQ(product, best);
  }
}

TEST(Nogoods, ForgetThoseUsedLeast) {
  Nogoods nogoods;
  nogoods.clear(8);
  for (Literal literal = 0; literal < 8; literal += 2) {
    const std::array<Literal, 3> clause{literal, literal + 2, literal + 4};
    const std::uint32_t number = nogoods.add(clause, 3);
    if (literal >= 4) nogoods.note_use(number);
  }
  const std::array<Literal, 2> short_clause{1, 3};
  static_cast<void>(nogoods.add(short_clause, 2));
  nogoods.forget_half();
  ASSERT_EQ(nogoods.size(), 3U);
  EXPECT_EQ(nogoods.literals(0)[0], 4U);
  EXPECT_EQ(nogoods.literals(1)[0], 6U);
  EXPECT_EQ(nogoods.literals(2)[0], 1U) << "few levels";
  const auto count_implied_by = [&nogoods](Literal literal) {
    std::size_t count = 0;
    const std::vector<std::int8_t> all_false(16, -1);
    static_cast<void>(
        nogoods.follow(literal, all_false, [&](Literal, std::uint32_t) { return ++count > 0; }));
    return count;
  };
  EXPECT_EQ(count_implied_by(negate(0)), 0U);
  EXPECT_EQ(count_implied_by(negate(6)), 2U);
}

}  // namespace
}  // namespace cbc::learning_search_test
