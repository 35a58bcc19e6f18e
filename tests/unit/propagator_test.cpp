#include "solver/propagator.h"

#include <string>

#include <gtest/gtest.h>

#include "compile/compile.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc {
namespace {

using test::compile_text;
using test::open_problem;

/// Demands the tasks, and propagates.
class Propagation {
 public:
  explicit Propagation(const char* yaml)
      : catalog(compile_text(yaml)), problem(open_problem(catalog)), domains_(catalog) {}

  /// The domains afterwards, "A:a1,a2 B?:b" ("?": it may stop, too), or "inconsistent".
  std::string run(const std::vector<std::string>& demanded) {
    domains_.load(problem);
    Propagator propagator(catalog, domains_);
    propagator.load(problem);
    for (const std::string& task : demanded) {
      if (!domains_.need(test::local_task(catalog, task))) return "inconsistent";
    }
    return propagator.propagate() ? describe() : "inconsistent";
  }

  CompiledCatalog catalog;
  Problem problem;

 private:
  std::string describe() {
    std::string text;
    for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
      text += (task == 0 ? "" : " ") + std::string(catalog.name_of_task(task)) +
              (domains_.may_stop(task) ? "?:" : ":");
      for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
        if (!domains_.has(task, index)) continue;
        if (text.back() != ':') text += ",";
        text += std::string(catalog.name_of_behavior(domains_.value(task, index).behavior));
      }
    }
    return text;
  }

  Domains domains_;
};

TEST(Propagator, WithoutNeedsNothingFollows) {
  Propagation propagation(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B}
)");
  EXPECT_EQ(propagation.run({}), "A?:a B?:b");
}

TEST(Propagator, WhatRunsClosesItsRivals) {
  Propagation propagation(R"(
behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B}
- {behavior: c, task: C}
- {behavior: d, task: D, requires: [{task: C}]}
exclusivity_constraints:
- mutually_exclusive: [A, B]
- mutually_exclusive: [A, C]
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a B?: C?: D?:");
  EXPECT_EQ(propagation.run({"A", "B"}), "inconsistent");
  EXPECT_EQ(propagation.run({"B", "C"}), "A?: B:b C:c D?:d");
  EXPECT_EQ(propagation.run({"A", "D"}), "inconsistent");
}

TEST(Propagator, WhatAllBehaviorsLeftRequireIsNeeded) {
  Propagation propagation(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B}, {task: C}]}
- {behavior: a2, task: A, requires: [{task: C}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a1,a2 B?:b C:c");
  test::leave_out(propagation.problem, propagation.catalog, "A", "a2");
  EXPECT_EQ(propagation.run({"A"}), "A:a1 B:b C:c");
}

TEST(Propagator, ABehaviorWhoseRequirementCannotRunGoes) {
  Propagation propagation(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C}
)");
  test::leave_out_all(propagation.problem, propagation.catalog, "C");
  EXPECT_EQ(propagation.run({}), "A?:a2 B?: C?:");
  EXPECT_EQ(propagation.run({"B"}), "inconsistent");
}

TEST(Propagator, AMinimumIsHeldAgainstTheBestThatIsLeft) {
  Propagation propagation(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B, minimum_performance: 81}]}
- {behavior: a2, task: A, suitability: 10}
- {behavior: b, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: c1, task: C, suitability: 95}
- {behavior: c2, task: C, suitability: 90}
- {behavior: c3, task: C, suitability: 89}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a1,a2 B?:b C?:c1,c2,c3");
  test::leave_out(propagation.problem, propagation.catalog, "A", "a2");
  EXPECT_EQ(propagation.run({"A"}), "A:a1 B:b C:c1,c2") << "81 % exactly is enough";
  test::leave_out(propagation.problem, propagation.catalog, "C", "c1");
  EXPECT_EQ(propagation.run({"A"}), "A:a1 B:b C:c2");
  test::leave_out(propagation.problem, propagation.catalog, "C", "c2");
  EXPECT_EQ(propagation.run({"A"}), "inconsistent");
}

TEST(Propagator, ABehaviorWhoseMinimumIsOutOfReachGoes) {
  Propagation propagation(R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B, minimum_performance: 81.0001}]}
- {behavior: a2, task: A, suitability: 10}
- {behavior: b, task: B, suitability: 90, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 90}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a2 B?:b C?:c");
}

TEST(Propagator, TheMinimumOfATaskCountsItsOwnSuitability) {
  Propagation propagation(R"(
tasks:
- {task: A, minimum_performance: 72}
behaviors:
- {behavior: a1, task: A, requires: [{task: B}]}
- {behavior: a2, task: A, suitability: 80, requires: [{task: B}]}
- {behavior: a3, task: A, suitability: 79, requires: [{task: B}]}
- {behavior: b, task: B, suitability: 90}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a1,a2 B:b");
  EXPECT_EQ(propagation.run({"B"}), "A?:a1,a2,a3 B:b") << "the minimum of a task that need not run";
}

TEST(Propagator, ATaskRequiredTwiceCountsOnceInThePerformance) {
  Propagation propagation(R"(
tasks:
- {task: A, minimum_performance: 90}
behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C}]}
- {behavior: b, task: B, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 90}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a B:b C:c");
}

TEST(Propagator, ASuitabilityOfZeroReachesNoMinimum) {
  Propagation propagation(R"(
tasks:
- {task: A, minimum_performance: 0.0001}
behaviors:
- {behavior: a, task: A, suitability: 0}
)");
  EXPECT_EQ(propagation.run({"A"}), "inconsistent");
}

TEST(Propagator, ProductsTooCloseForLogarithmsAreExact) {
  // 0.999999 * 0.999999 = 0.999998000001
  Propagation enough(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 99.9998}]}
- {behavior: b, task: B, suitability: 99.9999, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 99.9999}
)");
  EXPECT_EQ(enough.run({"A"}), "A:a B:b C:c");
  // 0.900001 * 0.899999 = 0.809999999999
  Propagation below(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 81}]}
- {behavior: b, task: B, suitability: 90.0001, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 89.9999}
)");
  EXPECT_EQ(below.run({"A"}), "inconsistent");
}

TEST(Propagator, KeepsAValueWhoseLogarithmsSayTooLittleByTheirError) {
  // 0.935451 * 0.892051 = 0.834470000001, yet the sum of its costs is a little more.
  Propagation propagation(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B, minimum_performance: 83.4470}]}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: b2, task: B, suitability: 93.5451, requires: [{task: C}]}
- {behavior: c, task: C, suitability: 89.2051}
)");
  EXPECT_EQ(propagation.run({"A"}), "A:a B:b1,b2 C:c");
}

TEST(Propagator, RemovesNoSolutionAndIsExactWhereAllIsDecided) {
  test::Random random(5);
  test::Shape shape;
  shape.minimum = 40;
  int inconsistent = 0;
  int decided = 0;
  int removed = 0;
  for (int round = 0; round < test::rounds(4'000); ++round) {
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 6));
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    const test::BruteForce truth(catalog, problem);
    Domains domains(catalog);
    Propagator propagator(catalog, domains);
    domains.load(problem);
    propagator.load(problem);
    bool is_consistent = true;
    for (std::uint32_t task = 0; task < domains.task_count(); ++task) {
      if (problem.may_stop[task] == 0 && !domains.need(task)) is_consistent = false;
    }
    if (!is_consistent || !propagator.propagate()) {
      ASSERT_TRUE(truth.solutions().empty()) << "round " << round;
      ++inconsistent;
      continue;
    }
    for (const Assignment& solution : truth.solutions()) {
      for (std::uint32_t task = 0; task < solution.size(); ++task) {
        ASSERT_TRUE(solution[task] == none ? domains.may_stop(task)
                                           : domains.has(task, solution[task]))
            << "round " << round;
      }
    }
    Assignment least(domains.task_count(), none);
    bool is_decided = true;
    for (const std::uint32_t task : domains.needed_tasks()) {
      is_decided = is_decided && domains.count(task) == 1;
      least[task] = domains.best(task);
    }
    if (is_decided) {
      ASSERT_TRUE(truth.is_valid(least) && truth.is_in_domains(least)) << "round " << round;
      ++decided;
    }
    if (domains.needed_tasks().size() > 1) ++removed;
  }
  EXPECT_GT(inconsistent, test::rounds(300));
  EXPECT_GT(decided, test::rounds(1'000));
  EXPECT_GT(removed, test::rounds(500));
}

}  // namespace
}  // namespace cbc
