#include "solver/cost_bound.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "compile/compile.h"
#include "compiled/compiled_catalog.h"
#include "solver/propagator.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc {
namespace {

using Cost = CostBound::Cost;
constexpr Cost unbounded{INT64_MAX, INT64_MAX};

/// Everything that a bound needs, at the fixed point of the demanded tasks.
class Situation {
 public:
  Situation(const std::string& yaml, const std::vector<std::string>& needed)
      : catalog(test::compile_text(yaml)),
        domains(catalog),
        components(catalog, domains),
        cost_bound(catalog, domains, components) {
    const Problem problem = test::open_problem(catalog);
    Propagator propagator(catalog, domains);
    domains.load(problem);
    propagator.load(problem);
    components.load(problem);
    for (const std::string& task : needed) {
      EXPECT_TRUE(domains.need(test::local_task(catalog, task)));
    }
    EXPECT_TRUE(propagator.propagate());
  }

  Cost bound() { return cost_bound.bound(unbounded, CostBound::Roots::in_component); }
  Cost reduced(std::string_view task, std::string_view behavior) {
    return cost_bound.reduced_cost(test::local_task(catalog, task),
                                   test::value_index(catalog, task, behavior));
  }

  CompiledCatalog catalog;
  Domains domains;
  Components components;
  CostBound cost_bound;
};

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

constexpr const char* chain = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A, start_on_request: true}]
behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, suitability: 60}
- {behavior: b1, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 50}
- {behavior: c, task: C, suitability: 80}
)";

TEST(CostBound, NothingNeededCostsNothing) {
  Situation situation(chain, {});
  expect_equal(situation.bound(), cost(0, 0));
}

TEST(CostBound, SeesWhatWillBeRequiredOnTheWayDown) {
  // a1, b1, c: 72 %; a1, b2: 50 %; a2: 60 %.
  Situation situation(chain, {"A"});
  expect_equal(situation.bound(), cost(log_cost(720'000), 2));
  expect_equal(situation.reduced("A", "a1"), cost(0, 0));
  EXPECT_GT(situation.reduced("A", "a2"), cost(0, 0));
  expect_equal(situation.reduced("B", "b1"), cost(0, 0));
  EXPECT_GT(situation.reduced("B", "b2"), cost(0, 0));
}

TEST(CostBound, CountsWhatTwoNeededTasksShareOnce) {
  Situation situation(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a1, task: A, suitability: 90, requires: [{task: C}]}
- {behavior: a2, task: A, suitability: 50}
- {behavior: b1, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 50}
- {behavior: c, task: C, suitability: 80}
)",
                      {"A", "B"});
  const Cost bound = situation.bound();
  // The best is a1, b1, c.
  EXPECT_LE(bound, cost(2 * log_cost(900'000) + log_cost(800'000), 3));
  EXPECT_GE(bound, cost(2 * log_cost(900'000), 2));
}

TEST(CostBound, ATaskThatIsNeededAnywayIsNotChargedToWhatRequiresIt) {
  Situation situation(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, suitability: 95}
- {behavior: b, task: B, suitability: 50}
)",
                      {"A", "B"});
  expect_equal(situation.bound(), cost(log_cost(500'000), 0));
}

TEST(CostBound, AZeroIsAvoidedAtAnyPrice) {
  const std::string yaml = R"(
behaviors:
- {behavior: a1, task: A, suitability: 0}
- {behavior: a2, task: A, suitability: 0.0001}
)";
  Situation situation(yaml, {"A"});
  expect_equal(situation.bound(), cost(log_cost(1), 0));
  EXPECT_TRUE(situation.domains.remove(0, 0));
  EXPECT_GT(situation.bound(), cost(std::int64_t{1} << 60, 0));
}

TEST(CostBound, EndsAsSoonAsItIsEnough) {
  Situation situation(R"(
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
  expect_equal(situation.bound(), cost(log_cost(720'000), 0));
  expect_equal(situation.cost_bound.bound(cost(1, 0), CostBound::Roots::in_component),
               cost(log_cost(900'000), 0));
  expect_equal(
      situation.cost_bound.bound(cost(log_cost(900'000), 0), CostBound::Roots::in_component),
      cost(log_cost(720'000), 0));
}

TEST(CostBound, BoundsAComponentAndWhatIsAroundIt) {
  Situation situation(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: r, task: R, suitability: 70, requires: [{task: A}, {task: B}]}
- {behavior: a1, task: A, suitability: 90}
- {behavior: a2, task: A, suitability: 80}
- {behavior: b1, task: B, suitability: 60}
- {behavior: b2, task: B, suitability: 50}
)",
                      {"R"});
  expect_equal(situation.bound(),
               cost(log_cost(700'000) + log_cost(900'000) + log_cost(600'000), 3));
  ASSERT_TRUE(situation.components.enter_component_of(test::local_task(situation.catalog, "B")));
  expect_equal(situation.bound(), cost(log_cost(600'000), 1));
  expect_equal(situation.cost_bound.bound(unbounded, CostBound::Roots::around_component),
               cost(log_cost(700'000) + log_cost(900'000), 2));
}

TEST(CostBound, AroundANestedPartIsOnlyTheRestOfThePartAroundIt) {
  Situation situation(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: r, task: R, suitability: 70, requires: [{task: A}, {task: B}]}
- {behavior: a1, task: A, suitability: 95}
- {behavior: a2, task: A, suitability: 94}
- {behavior: b1, task: B, suitability: 90, requires: [{task: C}, {task: D}]}
- {behavior: b2, task: B, suitability: 10}
- {behavior: c1, task: C, suitability: 85}
- {behavior: c2, task: C, suitability: 84}
- {behavior: d1, task: D, suitability: 80}
- {behavior: d2, task: D, suitability: 79}
)",
                      {"R"});
  ASSERT_TRUE(situation.components.enter_component_of(test::local_task(situation.catalog, "B")));
  EXPECT_TRUE(situation.domains.keep_only(test::local_task(situation.catalog, "B"), 0));
  EXPECT_TRUE(situation.domains.need(test::local_task(situation.catalog, "C")));
  EXPECT_TRUE(situation.domains.need(test::local_task(situation.catalog, "D")));
  ASSERT_TRUE(situation.components.enter_component_of(test::local_task(situation.catalog, "D")));
  ASSERT_EQ(situation.components.depth(), 2U);
  expect_equal(situation.bound(), cost(log_cost(800'000), 1));
  expect_equal(situation.cost_bound.bound(unbounded, CostBound::Roots::around_component),
               cost(log_cost(900'000) + log_cost(850'000), 2));
}

/// The cost of what runs in a solution; nothing if a suitability of 0 spoils it.
std::optional<Cost> cost_of(const CompiledCatalog& catalog, std::uint32_t group,
                            const Assignment& solution) {
  Cost sum;
  for (std::uint32_t task = 0; task < solution.size(); ++task) {
    if (solution[task] == none) continue;
    const TaskId id = catalog.group_tasks[group] + task;
    const Value& value = catalog.values[id][solution[task]];
    if (value.suitability == 0) return std::nullopt;
    sum += cost(log_cost(value.suitability), catalog.tasks[id].start_on_request ? 0 : 1);
  }
  return sum;
}

TEST(CostBound, NeverExceedsTheTrueOptimum) {
  test::Random random(6);
  test::Shape shape;
  shape.exclusivity_lists = 0;
  shape.several_tasks = 5;
  shape.minimum = 0;
  shape.on_request = 0;
  int compared = 0;
  int exact = 0;
  for (int round = 0; round < test::rounds(4'000); ++round) {
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 6));
    shape.exclusivity_lists = random.percent(20) ? 1 : 0;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    const test::BruteForce truth(catalog, problem);
    std::optional<Cost> optimum;
    for (const Assignment& solution : truth.solutions()) {
      const std::optional<Cost> one = cost_of(catalog, problem.group, solution);
      if (one && (!optimum || *one < *optimum)) optimum = one;
    }
    if (!optimum) continue;

    Domains domains(catalog);
    Propagator propagator(catalog, domains);
    Components components(catalog, domains);
    CostBound cost_bound(catalog, domains, components);
    domains.load(problem);
    propagator.load(problem);
    components.load(problem);
    for (std::uint32_t task = 0; task < domains.task_count(); ++task) {
      if (problem.may_stop[task] == 0) {
        ASSERT_TRUE(domains.need(task));
      }
    }
    ASSERT_TRUE(propagator.propagate());
    const Cost bound = cost_bound.bound(unbounded, CostBound::Roots::in_component);
    ASSERT_LE(bound, *optimum) << "round " << round << ": " << bound.log << " > " << optimum->log;
    ++compared;
    if (bound == *optimum && optimum->log > 0) ++exact;
  }
  EXPECT_GT(compared, test::rounds(1'500));
  EXPECT_GT(exact, test::rounds(300)) << "a bound that never reaches the optimum is of little use";
}

}  // namespace
}  // namespace cbc
