#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "runtime/coordinator/problem_builder.h"
#include "unit/compiled_fixture.h"

namespace cbc::ranks_test {
namespace {

CompiledCatalog two_tasks(const char* order) {
  return test::compile_text(std::string("tasks: ") + order + R"(
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A, suitability: 90}
- {behavior: a3, task: A, suitability: 90}
- {behavior: a4, task: A, suitability: 90}
- {behavior: a5, task: A, suitability: 10}
- {behavior: b1, task: B}
- {behavior: b2, task: B}
)");
}

std::vector<std::uint32_t> ranks_of(const CompiledCatalog& catalog, std::string_view task,
                                    std::uint64_t seed) {
  const std::vector<std::uint32_t> ranks = draw_ranks(catalog, seed);
  EXPECT_EQ(ranks.size(), catalog.values.items.size());
  const TaskId id = test::task_id(catalog, task);
  return {ranks.begin() + catalog.values.begin[id], ranks.begin() + catalog.values.begin[id + 1]};
}

TEST(Ranks, OnlyBehaviorsOfEqualSuitabilityChangePlaces) {
  const CompiledCatalog catalog = two_tasks("[{task: A}, {task: B}]");
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::vector<std::uint32_t> ranks = ranks_of(catalog, "A", seed);
    EXPECT_EQ(ranks.front(), 0U);
    EXPECT_EQ(ranks.back(), 4U);
    std::sort(ranks.begin(), ranks.end());
    EXPECT_EQ(ranks, (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  }
}

TEST(Ranks, AllOrdersOccur) {
  const CompiledCatalog catalog = two_tasks("[{task: A}, {task: B}]");
  std::set<std::vector<std::uint32_t>> orders_of_a;
  std::set<std::vector<std::uint32_t>> orders_of_b;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    orders_of_a.insert(ranks_of(catalog, "A", seed));
    orders_of_b.insert(ranks_of(catalog, "B", seed));
  }
  EXPECT_EQ(orders_of_a.size(), 6U);
  EXPECT_EQ(orders_of_b.size(), 2U);
}

TEST(Ranks, TheSameSeedDrawsTheSameOrder) {
  const CompiledCatalog catalog = two_tasks("[{task: A}, {task: B}]");
  EXPECT_EQ(draw_ranks(catalog, 42), draw_ranks(catalog, 42));
}

}  // namespace
}  // namespace cbc::ranks_test
