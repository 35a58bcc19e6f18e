#include "runtime/solver/solver.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/catalog/catalog.h"
#include "core/compile/compile.h"
#include "runtime/solver/checker.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::solver_test {
namespace {

using test::compile_text;
using test::open_problem;

constexpr std::uint64_t never = UINT64_MAX;

SearchOptions restarting_after(std::uint64_t easy_nodes) {
  SearchOptions options;
  options.easy_nodes = easy_nodes;
  options.bounded_nodes = never;
  return options;
}

SearchOptions learning_after(std::uint64_t easy_nodes, std::uint64_t bounded_nodes) {
  SearchOptions options;
  options.easy_nodes = easy_nodes;
  options.bounded_nodes = bounded_nodes;
  return options;
}

SearchOptions first_solutions(std::uint64_t m) {
  SearchOptions options;
  options.max_solutions = m;
  return options;
}

struct Answer {
  SearchResult result;
  Assignment assignment;
};

Answer solve(const CompiledCatalog& catalog, const Problem& problem,
             const SearchOptions& options = {}) {
  Solver solver(catalog, options);
  Answer answer;
  answer.result = solver.solve(problem, answer.assignment);
  return answer;
}

std::string text_of(const CompiledCatalog& catalog, const Problem& problem,
                    const SearchOptions& options = {}) {
  const Answer answer = solve(catalog, problem, options);
  switch (answer.result.status) {
    case SearchStatus::optimal:
      return test::show(catalog, answer.assignment, problem.group);
    case SearchStatus::feasible:
      return "feasible " + test::show(catalog, answer.assignment, problem.group);
    case SearchStatus::infeasible:
      return "infeasible";
    case SearchStatus::unknown:
      return "unknown";
  }
  return "";
}

TEST(Solver, ComparesProductsExactlyWhereLogarithmsAreTooClose) {
  // 0.999999 * 0.999999 = 0.999998000001, and 0.900001 * 0.899999 = 0.809999999999.
  const CompiledCatalog catalog = compile_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a1, task: A, suitability: 99.9998}
- {behavior: a2, task: A, suitability: 99.9999, requires: [{task: B}]}
- {behavior: b, task: B, suitability: 99.9999}
- {behavior: c1, task: C, suitability: 81, requires: [{task: E}]}
- {behavior: c2, task: C, suitability: 90.0001, requires: [{task: D}]}
- {behavior: d, task: D, suitability: 89.9999}
- {behavior: e, task: E}
)");
  for (const std::uint64_t easy_nodes : {std::uint64_t{0}, never}) {
    Problem first = open_problem(catalog, GroupId(0));
    test::demand(first, catalog, "A");
    EXPECT_EQ(text_of(catalog, first, restarting_after(easy_nodes)), "A=a2 B=b");
    Problem second = open_problem(catalog, GroupId(1));
    test::demand(second, catalog, "C");
    EXPECT_EQ(text_of(catalog, second, restarting_after(easy_nodes)), "C=c1 E=e");
  }
}

/// The sums of rounded logarithms are in the wrong order, so a bound on costs must leave them room.
TEST(Solver, DoesNotPruneWhatIsBetterByLessThanTheErrorOfLogarithms) {
  // 0.935451 * 0.892051 = 0.834470000001, yet the sum of its costs is a little more than that of
  // 0.83447, which is found first.
  const CompiledCatalog catalog = compile_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a1, task: A, requires: [{task: D}]}
- {behavior: a2, task: A, suitability: 93.5451, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 89.2051}
- {behavior: d, task: D, suitability: 83.447}
)");
  Problem problem = open_problem(catalog);
  test::demand(problem, catalog, "A");
  for (const SearchOptions& options :
       {restarting_after(never), restarting_after(0), learning_after(0, 0)}) {
    EXPECT_EQ(text_of(catalog, problem, options), "A=a2 C=c");
  }
}

TEST(Solver, AProductOfZeroTiesAllComponents) {
  // P, Q and Z have nothing to do with one another, but behind Z the product is 0 in any case, and
  // then the fewest supporting tasks decide.
  const CompiledCatalog catalog = compile_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: x1, task: X, suitability: 80}
- {behavior: x2, task: X}
- {behavior: all, task: ALL, requires: [{task: P}, {task: Q}, {task: Z}]}
- {behavior: p1, task: P, requires: [{task: S}]}
- {behavior: p2, task: P, suitability: 90}
- {behavior: q1, task: Q, requires: [{task: T}]}
- {behavior: q2, task: Q, suitability: 90}
- {behavior: z1, task: Z, requires: [{task: Y}]}
- {behavior: z2, task: Z, requires: [{task: W}]}
- {behavior: s, task: S}
- {behavior: t, task: T}
- {behavior: y, task: Y, suitability: 0}
- {behavior: w, task: W, suitability: 0}
)");
  Problem without_zero = open_problem(catalog, GroupId(0));
  test::demand(without_zero, catalog, "X");
  Problem with_zero = open_problem(catalog, GroupId(1));
  test::demand(with_zero, catalog, "ALL");
  for (const std::uint64_t easy_nodes : {std::uint64_t{0}, never}) {
    Solver solver(catalog, restarting_after(easy_nodes));
    Assignment answer;
    EXPECT_EQ(solver.solve(without_zero, answer).status, SearchStatus::optimal);
    EXPECT_EQ(test::show(catalog, answer, GroupId(0)), "X=x2");
    EXPECT_EQ(solver.solve(with_zero, answer).status, SearchStatus::optimal);
    EXPECT_EQ(test::show(catalog, answer, GroupId(1)), "ALL=all P=p2 Q=q2 Z=z1 Y=y");
  }
}

TEST(Solver, EachComponentHasCostsOutsideOfItsOwn) {
  // P, Q and R are decided one after the other. q1 looks best, but Y and Z exclude one another, so
  // that it needs u1 or w1.
  const CompiledCatalog catalog = compile_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: all, task: ALL, suitability: 50, requires: [{task: P}, {task: Q}, {task: R}]}
- {behavior: p1, task: P, requires: [{task: A}]}
- {behavior: p2, task: P, suitability: 90}
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C, requires: [{task: D}]}
- {behavior: d, task: D}
- {behavior: q1, task: Q, requires: [{task: U}, {task: W}]}
- {behavior: q2, task: Q, suitability: 80}
- {behavior: u1, task: U, suitability: 50}
- {behavior: u2, task: U, requires: [{task: Y}]}
- {behavior: w1, task: W, suitability: 50}
- {behavior: w2, task: W, requires: [{task: Z}]}
- {behavior: y, task: Y}
- {behavior: z, task: Z}
- {behavior: r1, task: R, requires: [{task: S}]}
- {behavior: r2, task: R, suitability: 90}
- {behavior: s, task: S}
exclusivity_constraints:
- mutually_exclusive: [Y, Z]
)");
  Problem problem = open_problem(catalog);
  test::demand(problem, catalog, "ALL");
  EXPECT_EQ(text_of(catalog, problem, restarting_after(0)),
            "ALL=all P=p1 A=a B=b C=c D=d Q=q2 R=r1 S=s");
}

// Compared with brute force --------------------------------------------------------------------

class Agreement {
 public:
  /// Solves the problem in every way, and compares.
  void check(const CompiledCatalog& catalog, const Problem& problem, test::Random& random) {
    const test::BruteForce truth(catalog, problem);
    const std::optional<Assignment> best = truth.best();
    const auto some = static_cast<std::uint64_t>(random.between(1, 6));
    for (const SearchOptions& options :
         {restarting_after(0), restarting_after(some), restarting_after(never),
          learning_after(0, 0), learning_after(0, some)}) {
      const Answer answer = solve(catalog, problem, options);
      ASSERT_EQ(answer.result.status, best ? SearchStatus::optimal : SearchStatus::infeasible);
      if (best) {
        ASSERT_EQ(test::show(catalog, answer.assignment, problem.group),
                  test::show(catalog, *best, problem.group));
      }
    }
    for (const std::size_t m : {std::size_t{1}, std::size_t{1 + random.below(8)},
                                std::max<std::size_t>(1, truth.solutions().size())}) {
      SearchOptions first = first_solutions(m);
      if (random.percent(50)) first.easy_nodes = 0;
      const Answer answer = solve(catalog, problem, first);
      const std::optional<Assignment> expected = truth.best(m);
      ASSERT_EQ(answer.result.solutions, std::min(m, truth.solutions().size()));
      if (!expected) {
        ASSERT_EQ(answer.result.status, SearchStatus::infeasible);
        continue;
      }
      ASSERT_EQ(answer.result.status,
                truth.solutions().size() > m ? SearchStatus::feasible : SearchStatus::optimal);
      ASSERT_EQ(test::show(catalog, answer.assignment, problem.group),
                test::show(catalog, *expected, problem.group));
    }
    check_node_limits(catalog, problem, truth);
    ++(best ? solved : infeasible);
  }

  int solved = 0;
  int infeasible = 0;
  int feasible = 0;
  int with_same_requests = 0;
  int with_close_bound = 0;

 private:
  void check_node_limits(const CompiledCatalog& catalog, const Problem& problem,
                         const test::BruteForce& truth) {
    for (const std::uint64_t limit : {std::uint64_t{1}, std::uint64_t{3}}) {
      for (SearchOptions options : {SearchOptions(), learning_after(0, 0)}) {
        options.max_nodes = limit;
        const Answer answer = solve(catalog, problem, options);
        ASSERT_LE(answer.result.nodes, limit);
        if (has_solution(answer.result.status)) {
          ASSERT_TRUE(truth.is_solution(answer.assignment));
        }
        switch (answer.result.status) {
          case SearchStatus::optimal:
            ASSERT_EQ(answer.assignment, *truth.best());
            break;
          case SearchStatus::feasible:
            ++feasible;
            check_bound(catalog, problem, answer, *truth.best());
            break;
          case SearchStatus::infeasible:
            ASSERT_TRUE(truth.solutions().empty());
            break;
          case SearchStatus::unknown:
            break;
        }
      }
    }
  }

  void check_bound(const CompiledCatalog& catalog, const Problem& problem, const Answer& answer,
                   const Assignment& best) {
    const SearchBound& bound = answer.result.bound;
    std::uint32_t most = bound.more_requests;
    std::uint32_t served = 0;
    for (const LocalTask task : problem.requests) {
      if (answer.assignment[task] != none) ++most;
      if (best[task] != none) ++served;
      if (bound.same_requests) {
        ASSERT_EQ(answer.assignment[task] == none, best[task] == none);
      }
    }
    ASSERT_LE(served, most);
    if (bound.same_requests) ++with_same_requests;
    if (best == answer.assignment) return;
    const long double suitability = suitability_of(catalog, problem, best);
    ASSERT_GE(static_cast<long double>(bound.suitability), suitability);
    constexpr long double close = 1.0001L;
    if (static_cast<long double>(bound.suitability) < suitability * close) ++with_close_bound;
  }

  static long double suitability_of(const CompiledCatalog& catalog, const Problem& problem,
                                    const Assignment& answer) {
    long double product = 1;
    for (LocalTask task(0); task < answer.size(); ++task) {
      if (answer[task] == none) continue;
      product *=
          catalog.values[catalog.group_tasks[problem.group] + task][answer[task]].suitability;
      product /= one_million;
    }
    return product;
  }
};

TEST(Solver, AgreesWithBruteForceOnSmallProblems) {
  test::Random random(8);
  Agreement agreement;
  for (int round = 0; round < test::rounds(6'000); ++round) {
    test::Shape shape;
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 6));
    shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(3));
    shape.several_tasks = random.percent(30) ? 40 : 10;
    shape.minimum = random.percent(50) ? 0 : 40;
    shape.on_request = static_cast<std::uint32_t>(random.below(60));
    shape.zero = random.percent(20) ? 15 : 0;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    agreement.check(catalog, problem, random);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(agreement.solved, test::rounds(3'000));
  EXPECT_GT(agreement.infeasible, test::rounds(300));
  EXPECT_GT(agreement.feasible, test::rounds(100));
  EXPECT_GT(agreement.with_same_requests, test::rounds(30));
  EXPECT_GT(agreement.with_close_bound, test::rounds(30));
}

/// R requires B and C, which have a choice each, mostly apart; now and then something connects the
/// two: an exclusivity list, a task that both require, a behavior of both, a minimum performance.
Catalog two_branches(test::Random& random) {
  enum : TaskIndex { r, b, c, d, e, f };
  static const std::vector<Millionths> degrees{1'000'000, 900'000, 800'000, 720'000, 500'000};
  Catalog catalog;
  for (const char* const name : {"R", "B", "C", "D", "E", "F"}) {
    catalog.tasks.emplace_back();
    catalog.tasks.back().name = name;
    catalog.tasks.back().start_on_request = false;
  }
  const auto add = [&](const std::vector<TaskIndex>& tasks, const std::vector<TaskIndex>& required,
                       Millionths minimum = 0) {
    Behavior& behavior = catalog.behaviors.emplace_back();
    behavior.name = "b" + std::to_string(catalog.behaviors.size());
    for (const TaskIndex task : tasks) {
      Performance performance;
      performance.task = task;
      performance.suitability = random.pick(degrees);
      behavior.performs.push_back(performance);
    }
    for (const TaskIndex task : required) {
      Requirement requirement;
      requirement.task = task;
      requirement.minimum_performance = minimum;
      behavior.requirements.push_back(requirement);
    }
  };
  add({r}, {b, c});
  add({f}, {r}, random.percent(50) ? 360'000 : 0);
  for (const TaskIndex branch : {b, c}) {
    const TaskIndex below = branch == b ? d : e;
    add({branch}, {below});
    add({branch}, {});
    if (random.percent(50)) add({branch}, {random.percent(70) ? below : TaskIndex{d}});
    add({below}, {});
    if (random.percent(50)) add({below}, {});
  }
  if (random.percent(30)) add({b, c}, {});
  if (random.percent(20)) add({d, e}, {});
  if (random.percent(40)) catalog.exclusivity.emplace_back().tasks = {d, e};
  random.shuffle(catalog.behaviors);
  random.shuffle(catalog.exclusivity);
  return catalog;
}

TEST(Solver, AgreesWithBruteForceWhereComponentsAreNearlyIndependent) {
  test::Random random(12);
  Agreement agreement;
  for (int round = 0; round < test::rounds(2'000); ++round) {
    const CompiledCatalog catalog = compile(two_branches(random));
    Problem problem = open_problem(catalog);
    test::run_some(random, catalog, problem);
    const std::string_view top = random.percent(50) ? "R" : "F";
    test::demand(problem, catalog, top);
    test::request(problem, catalog, top);
    agreement.check(catalog, problem, random);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(agreement.solved, test::rounds(1'000));
}

TEST(Solver, AgreesWithBruteForceOnMoreThanSixtyFourValues) {
  test::Random random(9);
  Agreement agreement;
  for (int round = 0; round < 60; ++round) {
    test::Shape shape;
    shape.tasks = 2;
    shape.most_behaviors = 140;
    shape.most_requirements = 1;
    shape.exclusivity_lists = 0;
    shape.several_tasks = 3;
    Catalog written = test::random_catalog(random, shape);
    if (round % 2 == 1) test::make_perfect(written);
    const CompiledCatalog catalog = compile(written);
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    agreement.check(catalog, problem, random);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(agreement.solved, 30);
}

// Larger ones ----------------------------------------------------------------------------------

TEST(Solver, AnswersOfLargerProblemsDoNotDependOnRestarts) {
  test::Random random(10);
  int proven = 0;
  int hard = 0;
  int infeasible = 0;
  for (int round = 0; round < test::rounds(800); ++round) {
    test::Shape shape;
    shape.tasks = static_cast<std::uint32_t>(random.between(20, 40));
    shape.most_behaviors = 4;
    shape.most_requirements = 2;
    shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(5));
    shape.most_exclusive = 4;
    shape.several_tasks = random.percent(50) ? 0 : 5;
    shape.minimum = random.percent(50) ? 3 : 0;
    shape.on_request = 0;
    shape.zero = random.percent(10) ? 1 : 0;
    shape.any_percent = random.percent(70) ? 100 : 0;
    shape.is_deep = true;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_open_problem(random, catalog);
    std::optional<Answer> first;
    for (SearchOptions options :
         {restarting_after(0), SearchOptions(), restarting_after(7), restarting_after(never),
          learning_after(0, 0), learning_after(0, 20)}) {
      options.max_nodes = 20'000;
      const Answer answer = solve(catalog, problem, options);
      const bool is_proven = answer.result.status == SearchStatus::optimal ||
                             answer.result.status == SearchStatus::infeasible;
      if (!is_proven) continue;
      ++proven;
      if (answer.result.nodes > 200) ++hard;
      if (answer.result.status == SearchStatus::infeasible) ++infeasible;
      if (!first) {
        first = answer;
        continue;
      }
      ASSERT_EQ(answer.result.status, first->result.status) << "round " << round;
      if (has_solution(answer.result.status)) {
        ASSERT_EQ(answer.assignment, first->assignment) << "round " << round;
      }
    }
  }
  EXPECT_GT(proven, test::rounds(2'400));
  EXPECT_GT(hard, test::rounds(100));
  EXPECT_LT(infeasible, test::rounds(1'600));
}

TEST(Solver, FindsTheSameWithAndWithoutComponentsWithinComponents) {
  test::Random random(3);
  int solved = 0;
  for (int round = 0; round < test::rounds(300); ++round) {
    SCOPED_TRACE(round);
    const CompiledCatalog catalog = test::random_nested_components(random);
    Solver with(catalog, restarting_after(0));  // one for all: nothing may be left over
    Solver without(catalog, restarting_after(never));
    for (int i = 0; i < 4; ++i) {
      Problem problem = test::random_open_problem(random, catalog);
      if (i > 0) test::demand(problem, catalog, "T0");
      Assignment expected;
      Assignment found;
      const SearchResult result = with.solve(problem, found);
      ASSERT_EQ(result.status, without.solve(problem, expected).status);
      if (has_solution(result.status)) {
        ASSERT_EQ(found, expected);
        ++solved;
      }
    }
  }
  EXPECT_GT(solved, test::rounds(600));
}

TEST(Solver, AnySolutionIsOneOfTheWholeWithComponentsWithinComponents) {
  test::Random random(13);
  SearchOptions any = restarting_after(0);
  any.any_solution = true;
  int solved = 0;
  for (int round = 0; round < test::rounds(300); ++round) {
    SCOPED_TRACE(round);
    const CompiledCatalog catalog = test::random_nested_components(random);
    Checker checker(catalog);
    for (int i = 0; i < 4; ++i) {
      Problem problem = test::random_open_problem(random, catalog);
      if (i > 0) test::demand(problem, catalog, "T0");
      const SearchStatus status = solve(catalog, problem).result.status;
      const Answer answer = solve(catalog, problem, any);
      ASSERT_EQ(has_solution(answer.result.status), has_solution(status));
      if (has_solution(status)) {
        ++solved;
        ASSERT_EQ(checker.find_violation(problem, answer.assignment), std::nullopt);
      } else {
        ASSERT_EQ(answer.result.status, SearchStatus::infeasible);
      }
    }
  }
  EXPECT_GT(solved, test::rounds(600));
}

/// Puts a group of two tasks and two behaviors, one of which requires the other, before the rest.
void put_behind_another_group(Catalog& catalog) {
  constexpr TaskIndex before = 2;
  const auto move = [](TaskIndex& task) { task += before; };
  for (Behavior& behavior : catalog.behaviors) {
    for (Performance& performance : behavior.performs) move(performance.task);
    for (Requirement& requirement : behavior.requirements) move(requirement.task);
  }
  for (ExclusivityList& list : catalog.exclusivity) {
    for (TaskIndex& task : list.tasks) move(task);
  }
  std::vector<Task> tasks(before);
  std::vector<Behavior> behaviors(before);
  for (TaskIndex task = 0; task < before; ++task) {
    tasks[task].name = fmt::format("X{}", task);
    behaviors[task].name = fmt::format("x{}", task);
    behaviors[task].performs.emplace_back().task = task;
  }
  behaviors[0].requirements.emplace_back().task = 1;
  catalog.tasks.insert(catalog.tasks.begin(), tasks.begin(), tasks.end());
  catalog.behaviors.insert(catalog.behaviors.begin(), behaviors.begin(), behaviors.end());
}

TEST(Solver, TakesTheSameWorkBehindAnotherGroup) {
  test::Random random(14);
  int decided = 0;
  for (int round = 0; round < test::rounds(300); ++round) {
    SCOPED_TRACE(round);
    test::Shape shape;
    shape.tasks = static_cast<std::uint32_t>(random.between(10, 25));
    shape.most_behaviors = random.percent(10) ? 80 : 4;
    shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(6));
    shape.most_exclusive = 4;
    shape.minimum = 10;
    shape.on_request = 0;
    shape.any_percent = 60;
    shape.is_deep = true;
    Catalog written = test::random_catalog(random, shape);
    const CompiledCatalog first = compile(written);
    const Problem problem = test::random_open_problem(random, first);
    put_behind_another_group(written);
    const CompiledCatalog second = compile(written);
    Problem moved = problem;
    ++moved.group;
    const std::uint32_t further =
        second.group_behaviors[moved.group] - first.group_behaviors[problem.group];
    for (BehaviorId& behavior : moved.active) behavior = BehaviorId(behavior + further);
    SearchOptions limited = learning_after(0, 0);
    limited.max_nodes = 1;
    for (const SearchOptions& options :
         {SearchOptions(), restarting_after(0), learning_after(0, 0), limited}) {
      const Answer answer = solve(first, problem, options);
      const Answer other = solve(second, moved, options);
      ASSERT_EQ(other.result.status, answer.result.status);
      ASSERT_EQ(other.assignment, answer.assignment);
      ASSERT_EQ(other.result.nodes, answer.result.nodes);
      ASSERT_EQ(other.result.propagations, answer.result.propagations);
      ASSERT_EQ(other.result.performance_effort, answer.result.performance_effort);
      ASSERT_EQ(other.result.bound.more_requests, answer.result.bound.more_requests);
      ASSERT_EQ(other.result.bound.same_requests, answer.result.bound.same_requests);
      ASSERT_EQ(other.result.bound.suitability, answer.result.bound.suitability);
      decided += answer.result.nodes > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(decided, test::rounds(400));
}

// Limits ---------------------------------------------------------------------------------------

/// Many tasks with many behaviors each, all demanded, so that the search takes decisions.
CompiledCatalog catalog_with_choices() {
  std::string text = "behaviors:\n";
  for (int task = 0; task < 12; ++task) {
    for (int i = 0; i < 4; ++i) {
      text += fmt::format(
          "- {{behavior: b{0}_{1}, task: T{0}, suitability: {2}, requires: [{{task: S{3}}}]}}\n",
          task, i, 90 - i, (task + i) % 12);
    }
    text +=
        fmt::format("- {{behavior: s{0}, task: S{0}, suitability: {1}}}\n", task, 95 - task % 5);
  }
  return compile_text("default_values: {tasks: {start_on_request: false}}\n" + text);
}

Problem demand_all(const CompiledCatalog& catalog) {
  Problem problem = open_problem(catalog);
  for (int task = 0; task < 12; ++task) {
    test::demand(problem, catalog, "T" + std::to_string(task));
  }
  return problem;
}

TEST(Solver, ALimitOfNodesLeavesTheBestSoFar) {
  const CompiledCatalog catalog = catalog_with_choices();
  const Problem problem = demand_all(catalog);
  SearchOptions options;
  options.max_nodes = 1;
  const Answer first = solve(catalog, problem, options);
  EXPECT_EQ(first.result.status, SearchStatus::feasible) << "by a repair";
  EXPECT_EQ(first.result.solutions, 1U);
  EXPECT_EQ(first.result.nodes, 1U);
  options.max_nodes = 60;
  const Answer answer = solve(catalog, problem, options);
  EXPECT_EQ(answer.result.status, SearchStatus::feasible);
  EXPECT_EQ(answer.result.nodes, 60U);
  EXPECT_EQ(solve(catalog, problem).result.status, SearchStatus::optimal);
}

TEST(Solver, NothingIsLeftOfASearchThatALimitEnded) {
  test::Random random(4);
  test::Shape shape;
  shape.tasks = 30;
  shape.most_behaviors = 4;
  shape.exclusivity_lists = 6;
  shape.on_request = 0;
  shape.is_deep = true;
  int ended = 0;
  for (int round = 0; round < test::rounds(200); ++round) {
    SCOPED_TRACE(round);
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    for (SearchOptions options : {learning_after(0, 0), restarting_after(0)}) {
      options.max_nodes = 6;
      Solver used(catalog, options);
      for (int i = 0; i < 4; ++i) {
        const Problem problem = test::random_open_problem(random, catalog);
        Assignment found;
        Assignment expected;
        const SearchResult result = used.solve(problem, found);
        const SearchResult alone = Solver(catalog, options).solve(problem, expected);
        ASSERT_EQ(result.status, alone.status);
        ASSERT_EQ(result.nodes, alone.nodes);
        ASSERT_EQ(result.propagations, alone.propagations);
        if (has_solution(result.status)) {
          ASSERT_EQ(found, expected);
        }
        ended += result.nodes == options.max_nodes ? 1 : 0;
      }
    }
  }
  EXPECT_GT(ended, test::rounds(100));
}

TEST(Solver, ALimitOfTimeEndsTheSearch) {
  const CompiledCatalog catalog = catalog_with_choices();
  const Problem problem = demand_all(catalog);
  SearchOptions options;
  options.easy_nodes = never;
  options.time_limit = std::chrono::microseconds(1);
  const Answer answer = solve(catalog, problem, options);
  EXPECT_TRUE(answer.result.status == SearchStatus::feasible ||
              answer.result.status == SearchStatus::unknown);
  options.easy_nodes = 100;
  options.time_limit = std::chrono::hours(1);
  EXPECT_EQ(solve(catalog, problem, options).result.status, SearchStatus::optimal);
}

/// A search that ends between two dead ends has not seen them all.
TEST(Solver, ALimitOfTimeProvesNothing) {
  const CompiledCatalog catalog = catalog_with_choices();
  const Problem problem = demand_all(catalog);
  SearchOptions options = restarting_after(never);
  options.max_nodes = 3'000;
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(solve(catalog, problem, options).result.status, SearchStatus::feasible);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - begin);
  for (int round = 1; round < 100; ++round) {
    options.time_limit = std::max(whole * round / 100, std::chrono::microseconds(1));
    const SearchStatus status = solve(catalog, problem, options).result.status;
    EXPECT_TRUE(status == SearchStatus::feasible || status == SearchStatus::unknown) << round;
  }
}

/// It looks at the root only.
TEST(Solver, ABoundWithoutASearchLeavesOpenWhichRequestsAreServed) {
  const CompiledCatalog catalog =
      compile_text("behaviors: [{behavior: a, task: A, suitability: 90}]");
  Problem problem = open_problem(catalog);
  test::request(problem, catalog, "A");
  test::demand(problem, catalog, "A");
  Solver solver(catalog, {});
  const SearchBound bound = solver.bound(problem, Assignment{0});
  EXPECT_EQ(bound.more_requests, 0U);
  EXPECT_FALSE(bound.same_requests);
  EXPECT_NEAR(bound.suitability, 0.9, 1e-6);
}

}  // namespace
}  // namespace cbc::solver_test
