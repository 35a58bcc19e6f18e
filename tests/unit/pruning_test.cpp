// What the comparison of answers with brute force cannot see: how much the search leaves out.
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "runtime/compiled/derive.h"
#include "runtime/solver/components.h"
#include "runtime/solver/cost_bound.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/propagation.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::pruning_test {
namespace {

using Cost = CostBound::Cost;
constexpr Cost unbounded{INT64_MAX, INT64_MAX};

/// A subtree of a search, at the fixed point of what has to run.
class Subtree {
 public:
  explicit Subtree(CompiledCatalog compiled) : catalog(std::move(compiled)) {}
  explicit Subtree(const std::string& yaml) : Subtree(test::compile_text(yaml)) {}
  Subtree(const std::string& yaml, const std::vector<std::string>& needed) : Subtree(yaml) {
    EXPECT_NE(need(needed), "inconsistent");
  }

  void load() {
    domains.load(problem);
    propagator.load(problem);
    components.load(problem);
    objective.load(problem);
  }
  /// The domains afterwards, "A:a1,a2 B?:b" ("?": it may stop, too), or "inconsistent".
  std::string need(const std::vector<std::string>& tasks) {
    load();
    for (const std::string& task : tasks) {
      if (!domains.need(local(task))) return "inconsistent";
    }
    return propagator.propagate() ? describe() : "inconsistent";
  }
  void leave_out(std::string_view task, std::string_view behavior) {
    test::leave_out(problem, catalog, task, behavior);
  }
  /// Decides for the first value of a task.
  void decide(std::string_view task) {
    EXPECT_TRUE(domains.keep_only(local(task), 0));
    EXPECT_TRUE(propagator.propagate());
  }
  /// Decides as in a solution, with this chance for each task, in percent.
  void follow(const Assignment& solution, test::Random& random, std::size_t chance) {
    for (LocalTask task(0); task < domains.task_count(); ++task) {
      const std::uint32_t index = solution[task];
      EXPECT_TRUE(problem.may_stop[task] != 0 || domains.need(task));
      if (!random.percent(chance)) continue;
      EXPECT_TRUE(index == none ? domains.close(task)
                                : domains.need(task) && domains.keep_only(task, index));
    }
    EXPECT_TRUE(propagator.propagate());
  }

  /// Enters the component of the task, if it is not all of the present one.
  bool enter(std::string_view task) { return components.enter_component_of(local(task)); }

  Cost bound(const Cost& threshold = unbounded) {
    return cost_bound.bound(threshold, CostBound::Roots::in_component);
  }

  CompiledCatalog catalog;
  Problem problem = test::open_problem(catalog);
  Domains domains{catalog};
  Propagator propagator{catalog, domains};
  Components components{catalog, domains};
  CostBound cost_bound{catalog, domains, components};
  Objective objective{catalog, domains, components};

 private:
  [[nodiscard]] LocalTask local(std::string_view task) const {
    return test::local_task(catalog, task);
  }
  [[nodiscard]] std::string describe() const {
    std::string text;
    for (LocalTask task(0); task < domains.task_count(); ++task) {
      text += (task == 0 ? "" : " ") +
              std::string(catalog.name_of_task(domains.first_task() + task)) +
              (domains.may_stop(task) ? "?:" : ":");
      for (std::uint32_t index = 0; index < domains.values(task).size(); ++index) {
        if (!domains.has(task, index)) continue;
        if (text.back() != ':') text += ",";
        text += std::string(catalog.name_of_behavior(domains.value(task, index).behavior));
      }
    }
    return text;
  }
};

// Propagation ----------------------------------------------------------------------------------

TEST(Propagation, ReachesEveryWordOfALargeDomain) {
  std::string text = "behaviors:\n- {behavior: a0, task: A}\n- {behavior: b, task: B}\n";
  for (int i = 1; i < 150; ++i) {
    text += fmt::format("- {{behavior: a{}, task: A, requires: [{{task: B}}]}}\n", i);
  }
  Subtree required(text);
  required.leave_out("A", "a0");
  EXPECT_NE(required.need({"A"}), "inconsistent");
  EXPECT_TRUE(required.domains.needed(test::local_task(required.catalog, "B")));
  Subtree closed(text);
  closed.leave_out("B", "b");
  EXPECT_EQ(closed.need({}), "A?:a0 B?:");
}

TEST(Propagation, IsExactWhereLogarithmsAreTooClose) {
  // 0.999999 * 0.999999 = 0.999998000001
  Subtree enough(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 99.9998}]}
- {behavior: b, task: B, suitability: 99.9999, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 99.9999}
)");
  EXPECT_EQ(enough.need({"A"}), "A:a B:b C:c");
  // 0.900001 * 0.899999 = 0.809999999999
  Subtree below(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 81}]}
- {behavior: b, task: B, suitability: 90.0001, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 89.9999}
)");
  EXPECT_EQ(below.need({"A"}), "inconsistent");
  // 0.935451 * 0.892051 = 0.834470000001, yet the sum of its costs is a little more.
  Subtree misleading(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 83.4470}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 93.5451, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 89.2051}
)");
  EXPECT_EQ(misleading.need({"A"}), "A:a B:b1,b2 C:c");
}

// The comparison with the incumbent --------------------------------------------------------------

/// Of subtrees that have the best solution.
TEST(Comparison, NeverRulesOutTheBestSolution) {
  test::Random random(3);
  int compared = 0;
  for (int round = 0; round < test::rounds(600); ++round) {
    test::Shape shape;
    shape.several_tasks = 50;
    shape.on_request = 10;
    shape.minimum = 0;
    Subtree subtree(compile(test::random_catalog(random, shape)));
    subtree.problem =
        test::random_problem(random, subtree.catalog, test::largest_group(subtree.catalog));
    const test::BruteForce brute_force(subtree.catalog, subtree.problem);
    const std::vector<Assignment>& solutions = brute_force.solutions();
    if (solutions.empty()) continue;
    const Assignment best = *brute_force.best();
    for (int branch = 0; branch < 10; ++branch) {
      subtree.load();
      subtree.follow(solutions[random.below(solutions.size())], random, 100);
      Incumbent incumbent;
      subtree.objective.record(incumbent);
      if (incumbent.assignment == best) continue;
      subtree.load();
      subtree.follow(best, random, 50);
      ASSERT_TRUE(subtree.objective.compare(incumbent, 0).order < 0) << "round " << round;
      ++compared;
    }
  }
  EXPECT_GT(compared, test::rounds(1'000));
}

// Components -----------------------------------------------------------------------------------

TEST(Components, NestNoDeeperThanTheirLimit) {
  std::string text = "default_values: {tasks: {start_on_request: false}}\nbehaviors:\n";
  // A chain in which every task Ti has a choice, next to a task Si with a choice.
  const int length = 12;
  for (int i = 0; i < length; ++i) {
    text += fmt::format(R"(
- {{behavior: t{0}, task: T{0}, requires: [{{task: T{1}}}, {{task: S{1}}}]}}
- {{behavior: u{0}, task: T{0}, suitability: 10}}
- {{behavior: s{1}, task: S{1}}}
- {{behavior: v{1}, task: S{1}, suitability: 90}}
)",
                        i, i + 1);
  }
  Subtree subtree(text + fmt::format("- {{behavior: end, task: T{}}}\n", length), {"T0"});
  std::uint32_t entered = 0;
  for (int i = 0; i + 1 < length; ++i) {
    subtree.decide(fmt::format("T{}", i));
    if (subtree.enter(fmt::format("T{}", i + 1))) ++entered;
  }
  EXPECT_EQ(entered, Components::deepest);
  EXPECT_EQ(subtree.components.depth(), Components::deepest);
}

// Cost bounds ----------------------------------------------------------------------------------

Cost cost(std::int64_t log, std::int64_t idle) {
  Cost result;
  result.log = log;
  result.idle = idle;
  return result;
}

void expect_equal(const Cost& a, const Cost& b) {
  EXPECT_EQ(a.log, b.log);
  EXPECT_EQ(a.idle, b.idle);
}

TEST(CostBound, EndsAsSoonAsItExceedsTheThreshold) {
  Subtree subtree(R"(
behaviors:
- {behavior: a, task: A, suitability: 90}
- {behavior: b, task: B, suitability: 80, requires: [{task: C}]}
- {behavior: c, task: C}
exclusivity_constraints:
- mutually_exclusive: [A, Z]
- mutually_exclusive: [C, Z]
tasks: [{task: A}, {task: B}, {task: Z}]
)",
                  {"A", "B"});
  expect_equal(subtree.bound(), cost(log_cost(720'000), 0));
  expect_equal(subtree.bound(cost(1, 0)), cost(log_cost(900'000), 0));
  expect_equal(subtree.bound(cost(log_cost(900'000), 0)), cost(log_cost(720'000), 0));
}

TEST(CostBound, OfAVeryLargeGroupIsThatOfAPart) {
  constexpr int length = 6'000;  // all cuts have 18 million tasks
  Subtree subtree(test::chain_of_alternatives(length), {"T0"});
  const std::int64_t bound = subtree.bound().log;
  EXPECT_GT(bound, length / 2 * log_cost(999'990));
  EXPECT_LT(bound, length * log_cost(999'990));
}

TEST(CostBound, OfAZeroIsProhibitive) {
  Subtree subtree(R"(
behaviors:
- {behavior: a1, task: A, suitability: 0}
- {behavior: a2, task: A, suitability: 0.0001}
)",
                  {"A"});
  expect_equal(subtree.bound(), cost(log_cost(1), 0));
  EXPECT_TRUE(subtree.domains.remove(LocalTask(0), 0));
  EXPECT_GT(subtree.bound(), cost(std::int64_t{1} << 60, 0));
}

// Random problems ------------------------------------------------------------------------------

/// The cost of a solution; nothing if a suitability is 0.
std::optional<Cost> cost_of(const CompiledCatalog& catalog, TaskId first,
                            const Assignment& solution) {
  Cost sum;
  for (LocalTask task(0); task < solution.size(); ++task) {
    if (solution[task] == none) continue;
    const Value& value = catalog.values[first + task][solution[task]];
    if (value.suitability == 0) return std::nullopt;
    sum += cost(log_cost(value.suitability), catalog.tasks[first + task].start_on_request ? 0 : 1);
  }
  return sum;
}

/// Propagation and bounds at the root: they lose no solution, and often decide all.
class Root {
 public:
  void check(test::Random& random, const test::Shape& shape) {
    Subtree subtree(compile(test::random_catalog(random, shape)));
    const CompiledCatalog& catalog = subtree.catalog;
    subtree.problem = test::random_problem(random, catalog, test::largest_group(catalog));
    const test::BruteForce truth(catalog, subtree.problem);
    subtree.load();
    const Domains& domains = subtree.domains;
    bool is_consistent = true;
    for (LocalTask task(0); task < domains.task_count(); ++task) {
      if (subtree.problem.may_stop[task] == 0 && !subtree.domains.need(task)) is_consistent = false;
    }
    if (!is_consistent || !subtree.propagator.propagate()) {
      ASSERT_TRUE(truth.solutions().empty());
      ++inconsistent;
      return;
    }
    std::optional<Cost> optimum;
    for (const Assignment& solution : truth.solutions()) {
      for (LocalTask task(0); task < solution.size(); ++task) {
        ASSERT_TRUE(solution[task] == none ? domains.may_stop(task)
                                           : domains.has(task, solution[task]));
      }
      const std::optional<Cost> one = cost_of(catalog, domains.first_task(), solution);
      if (one && (!optimum || *one < *optimum)) optimum = one;
    }
    Assignment least(domains.task_count(), none);
    bool is_decided = true;
    for (const LocalTask task : domains.needed_tasks()) {
      is_decided = is_decided && domains.count(task) == 1;
      least[task] = domains.best(task);
    }
    if (is_decided) {
      ASSERT_TRUE(truth.is_solution(least));
      ++decided;
    }
    if (!optimum) return;
    const Cost bound = subtree.bound();
    ASSERT_LE(bound, *optimum) << bound.log << " > " << optimum->log;
    if (!is_decided && bound == *optimum && optimum->log > 0) ++exact;
  }

  int inconsistent = 0;
  int decided = 0;
  int exact = 0;  ///< bounds that are the optimum, where something is undecided
};

TEST(Pruning, LosesNoSolutionAndOftenDecidesAll) {
  test::Random random(5);
  Root with_minimums;
  Root without;
  for (int round = 0; round < test::rounds(3'000); ++round) {
    test::Shape shape;
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 6));
    shape.minimum = 40;
    with_minimums.check(random, shape);
    shape.exclusivity_lists = random.percent(20) ? 1 : 0;
    shape.several_tasks = 5;
    shape.minimum = 0;
    shape.on_request = 0;
    without.check(random, shape);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(with_minimums.inconsistent, test::rounds(200));
  EXPECT_GT(with_minimums.decided, test::rounds(700));
  EXPECT_GT(without.exact, test::rounds(150)) << "or the bound is of little use";
}

}  // namespace
}  // namespace cbc::pruning_test
