#include <vector>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "runtime/solver/checker.h"
#include "runtime/solver/solver.h"
#include "unit/allocations.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::solver_allocation_test {
namespace {

TEST(SolverAllocation, TheCounterCounts) {
  const std::uint64_t before = test::allocations();
  const std::vector<int> some(10'000);
  EXPECT_GT(test::allocations(), before) << some.size();
}

TEST(SolverAllocation, NothingIsAllocatedInTheSearch) {
  test::Random random(11);
  std::uint64_t nodes = 0;
  for (int round = 0; round < 80; ++round) {
    test::Shape shape;
    shape.tasks = static_cast<std::uint32_t>(random.between(2, 30));
    shape.most_behaviors = round % 10 == 0 ? 100 : 4;
    shape.most_requirements = 3;
    shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(6));
    shape.minimum = 15;
    shape.on_request = 15;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    for (const std::uint64_t easy_nodes : {0U, 20U}) {
      SearchOptions options;
      options.easy_nodes = easy_nodes;
      options.bounded_nodes = UINT64_MAX;
      options.max_nodes = 3'000;
      options.max_solutions = random.percent(20) ? 10 : 0;
      Solver solver(catalog, options);
      Assignment solution;
      solution.reserve(catalog.tasks.size());
      for (int i = 0; i < 3; ++i) {
        const GroupId group(random.below(catalog.group_count()));
        const Problem problem = test::random_problem(random, catalog, group);
        const std::uint64_t before = test::allocations();
        nodes += solver.solve(problem, solution).nodes;
        ASSERT_EQ(test::allocations() - before, 0U) << "round " << round;
      }
    }
  }
  EXPECT_GT(nodes, 10'000U);
}

}  // namespace
}  // namespace cbc::solver_allocation_test
