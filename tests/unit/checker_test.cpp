#include "runtime/solver/checker.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::checker_test {
namespace {

using test::compile_text;
using test::open_problem;

/// What is wrong with an answer ("A=a B=b"), or "right".
std::string check(const CompiledCatalog& catalog, const Problem& problem, std::string_view answer) {
  Checker checker(catalog);
  return checker.find_violation(problem, test::answer_of(catalog, answer, problem.group))
      .value_or("right");
}

constexpr const char* catalog_text = R"(
tasks:
- {task: A}
- {task: B}
- {task: C, minimum_performance: 72}
- {task: D}
behaviors:
- {behavior: a1, task: A, requires: [{task: B, minimum_performance: 81}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b, task: B, suitability: 90, requires: [{task: D}]}
- {behavior: c, task: C, suitability: 80, requires: [{task: D}]}
- {behavior: d1, task: D, suitability: 90}
- {behavior: d2, task: D, suitability: 90.0001}
- {behavior: d3, task: D, suitability: 89.9999}
- {behavior: d4, task: D}
exclusivity_constraints:
- mutually_exclusive: [B, C]
)";

TEST(Checker, RefusesAValueThatTheTaskDoesNotHave) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  Problem anything = open_problem(catalog);
  std::fill(anything.domains.begin(), anything.domains.end(), ~std::uint64_t{0});
  Assignment answer = test::answer_of(catalog, "D=d1");
  const auto values =
      static_cast<std::uint32_t>(catalog.values[test::task_id(catalog, "D")].size());
  Checker checker(catalog);
  for (const std::uint32_t index : {values - 1, values}) {
    answer[test::local_task(catalog, "D")] = index;
    EXPECT_EQ(checker.find_violation(anything, answer).has_value(), index == values);
  }
}

TEST(Checker, RefusesAPerformanceThatIsAMillionthTooLow) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  const Problem problem = open_problem(catalog);
  EXPECT_EQ(check(catalog, problem, "A=a1 B=b D=d3"),
            "task 'A' with 'a1' requires more of task 'B' with 'b' (line 8)");
  EXPECT_EQ(check(catalog, problem, "C=c D=d3"),
            "task 'C' with 'c' is below its minimum performance");
  EXPECT_EQ(check(catalog, problem, "B=b D=d3"), "right") << "only a1 asks for it";
}

TEST(Checker, RefusesAZeroWhereAnyPerformanceIsRequired) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 0.0001}]}
- {behavior: b, task: B, suitability: 0}
)");
  EXPECT_NE(check(catalog, open_problem(catalog), "A=a B=b"), "right");
  EXPECT_EQ(check(catalog, open_problem(catalog), "B=b"), "right");
}

TEST(Checker, RefusesAValueOutsideItsDomain) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  Problem problem = open_problem(catalog);
  test::leave_out(problem, catalog, "D", "d1");
  EXPECT_EQ(check(catalog, problem, "D=d1"), "task 'D' has a value outside its domain");
  EXPECT_EQ(check(catalog, problem, "D=d2"), "right");
}

TEST(Checker, RefusesAnIndexThatThereIsNot) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  const Problem problem = open_problem(catalog);
  Checker checker(catalog);
  EXPECT_EQ(checker.find_violation(problem, {2, none, none, none}),
            "task 'A' has a value outside its domain");
  EXPECT_EQ(checker.find_violation(problem, {none, 64, none, none}),
            "task 'B' has a value outside its domain");
  EXPECT_EQ(checker.find_violation(problem, {none, none, none, 70'000}),
            "task 'D' has a value outside its domain");
}

TEST(Checker, RefusesToStopATaskThatMayNot) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  Problem problem = open_problem(catalog);
  test::demand(problem, catalog, "B");
  EXPECT_EQ(check(catalog, problem, "D=d1"), "task 'B' has a value outside its domain");
}

TEST(Checker, RefusesTwoTasksThatExcludeOneAnother) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  EXPECT_EQ(check(catalog, open_problem(catalog), "B=b C=c D=d4"),
            "task 'B' with 'b' and task 'C' with 'c' exclude one another");
}

TEST(Checker, RefusesARequiredTaskThatDoesNotRun) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  EXPECT_EQ(check(catalog, open_problem(catalog), "B=b"),
            "task 'B' with 'b' requires task 'D', which does not run");
  // The performance of a task whose requirements do not run is refused as well.
  EXPECT_NE(check(catalog, open_problem(catalog), "A=a1 B=b"), "right");
}

TEST(Checker, RefusesAnotherNumberOfTasks) {
  const CompiledCatalog catalog = compile_text(catalog_text);
  Checker checker(catalog);
  EXPECT_EQ(checker.find_violation(open_problem(catalog), {none, none, none}),
            "the answer has another number of tasks");
  EXPECT_TRUE(checker.find_violation(open_problem(catalog), Assignment(5, none)).has_value());
}

TEST(Checker, StopsOneTaskAfterAnotherUntilNothingIsViolated) {
  const CompiledCatalog catalog = compile_text(R"(
behaviors:
- {behavior: x, task: X}
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B, requires: [{task: C, minimum_performance: 70}]}
- {behavior: c1, task: C, suitability: 60}
- {behavior: c2, task: C, suitability: 80}
- {behavior: d, task: D}
- {behavior: e, task: E, requires: [{task: D}]}
- {behavior: e_alone, task: E}
exclusivity_constraints:
- mutually_exclusive: [C, D]
)");
  Problem problem = open_problem(catalog, GroupId(1));
  Checker checker(catalog);
  const auto what_is_left = [&](std::string_view text) {
    Assignment answer = test::answer_of(catalog, text, GroupId(1));
    checker.stop_violating_tasks(problem, answer);
    return test::show(catalog, answer, GroupId(1));
  };
  EXPECT_EQ(what_is_left("A=a B=b C=c2"), "A=a B=b C=c2");
  EXPECT_EQ(what_is_left("A=a B=b C=c1"), "C=c1");
  EXPECT_EQ(what_is_left("A=a B=b C=c2 D=d"), "A=a B=b C=c2");
  EXPECT_EQ(what_is_left("A=a B=b D=d"), "D=d");
  EXPECT_EQ(what_is_left("C=c2 D=d E=e_alone"), "C=c2 E=e_alone") << "D comes behind C";
  test::leave_out(problem, catalog, "B", "b");
  EXPECT_EQ(what_is_left("A=a B=b C=c2"), "C=c2");
}

TEST(Checker, AgreesWithBruteForceOnChangedAnswers) {
  test::Random random(7);
  test::Shape shape;
  shape.minimum = 50;
  int right = 0;
  int wrong = 0;
  for (int round = 0; round < test::rounds(2'000); ++round) {
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 6));
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const GroupId group = test::largest_group(catalog);
    const Problem problem = test::random_problem(random, catalog, group);
    const test::BruteForce truth(catalog, problem);
    if (truth.solutions().empty()) continue;
    Checker checker(catalog);
    for (int i = 0; i < 10; ++i) {
      Assignment answer = truth.solutions()[random.below(truth.solutions().size())];
      ASSERT_EQ(checker.find_violation(problem, answer), std::nullopt);
      const LocalTask task(random.below(answer.size()));
      const auto values = catalog.values[catalog.group_tasks[group] + task].size();
      const std::size_t index = random.below(values + 1);
      answer[task] = index == values ? none : static_cast<std::uint32_t>(index);
      const bool is_right = truth.is_solution(answer);
      ASSERT_EQ(checker.find_violation(problem, answer) == std::nullopt, is_right)
          << "round " << round;
      ++(is_right ? right : wrong);
    }
  }
  EXPECT_GT(right, test::rounds(1'000));
  EXPECT_GT(wrong, test::rounds(1'000));
}

}  // namespace
}  // namespace cbc::checker_test
