// How much work the search takes, in decisions and propagations, on problems that are always the
// same. No answer shows it where a bound gets weaker or an inference comes too late, but more work
// does, and too little shows that it is not counted. The search depends on nothing else, not on the
// compiler either. Who makes it better, lowers the numbers; who makes it worse for a good reason,
// raises them and says why.
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "runtime/solver/solver.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::search_effort_test {
namespace {

constexpr std::uint64_t never = UINT64_MAX;

enum class Family : std::uint8_t {
  small,
  deep,       ///< long chains of requirements
  minimums,   ///< many minimum performances
  exclusive,  ///< many lists
  equal,      ///< all suitabilities are 1, so f3, f4 and the canonical order decide
  wide,       ///< many behaviors of a task
  nested      ///< components within components
};

test::Shape shape_of(Family family, test::Random& random) {
  test::Shape shape;
  shape.on_request = 0;
  switch (family) {
    case Family::small:
      shape.tasks = 9;
      shape.minimum = 30;
      shape.exclusivity_lists = 2;
      break;
    case Family::deep:
      shape.tasks = static_cast<std::uint32_t>(random.between(20, 40));
      shape.most_behaviors = 4;
      shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(5));
      shape.most_exclusive = 4;
      shape.several_tasks = 5;
      shape.minimum = 3;
      shape.any_percent = 100;
      shape.is_deep = true;
      break;
    case Family::minimums:
      shape.tasks = 60;
      shape.most_behaviors = 4;
      shape.minimum = 40;
      shape.any_percent = 60;
      shape.is_deep = true;
      break;
    case Family::exclusive:
      shape.tasks = 60;
      shape.most_behaviors = 4;
      shape.exclusivity_lists = 40;
      shape.most_exclusive = 5;
      shape.several_tasks = 0;
      shape.minimum = 0;
      shape.any_percent = 50;
      break;
    case Family::equal:
      shape.tasks = 40;
      shape.most_behaviors = 6;
      shape.exclusivity_lists = 4;
      shape.several_tasks = 10;
      shape.minimum = 0;
      shape.is_deep = true;
      break;
    case Family::wide:
      shape.tasks = 8;
      shape.most_behaviors = 140;
      shape.several_tasks = 3;
      shape.minimum = 10;
      shape.any_percent = 30;
      break;
    case Family::nested:  // has no shape
      break;
  }
  return shape;
}

CompiledCatalog catalog_of(Family family, test::Random& random) {
  if (family == Family::nested) return test::random_nested_components(random);
  Catalog catalog = test::random_catalog(random, shape_of(family, random));
  if (family == Family::equal) test::make_perfect(catalog);
  return compile(catalog);
}

/// Sums over all problems of a family.
struct Effort {
  std::uint64_t nodes = 0;
  std::uint64_t propagations = 0;
  std::uint64_t performance_effort = 0;
};

Effort measure(Family family, const SearchOptions& options, int problems) {
  test::Random random(23);
  Effort sum;
  for (int i = 0; i < problems; ++i) {
    const CompiledCatalog catalog = catalog_of(family, random);
    const Problem problem = test::random_open_problem(random, catalog);
    Solver solver(catalog, options);
    Assignment solution;
    const SearchResult result = solver.solve(problem, solution);
    sum.nodes += result.nodes;
    sum.propagations += result.propagations;
    sum.performance_effort += result.performance_effort;
  }
  return sum;
}

/// From the first decision with cost bounds, or learning, or neither.
SearchOptions options(std::uint64_t easy_nodes, std::uint64_t bounded_nodes) {
  SearchOptions options;
  options.easy_nodes = easy_nodes;
  options.bounded_nodes = bounded_nodes;
  options.max_nodes = 3'000;
  return options;
}

struct Measurement {
  std::string_view name;
  Family family;
  SearchOptions options;
  int problems;
  Effort effort;
};

std::ostream& operator<<(std::ostream& out, const Measurement& measurement) {
  return out << measurement.problems << " problems";
}

class SearchEffort : public testing::TestWithParam<Measurement> {};

TEST_P(SearchEffort, IsWhatItWas) {
  const Measurement& measurement = GetParam();
  const Effort effort = measure(measurement.family, measurement.options, measurement.problems);
  EXPECT_EQ(effort.nodes, measurement.effort.nodes);
  EXPECT_EQ(effort.propagations, measurement.effort.propagations);
  EXPECT_EQ(effort.performance_effort, measurement.effort.performance_effort);
}

INSTANTIATE_TEST_SUITE_P(
    Problems, SearchEffort,
    testing::Values(
        Measurement{"small", Family::small, SearchOptions{}, 1'000, {3'640, 26'392, 10'851}},
        Measurement{"deep", Family::deep, SearchOptions{}, 300, {12'637, 121'917, 39'418}},
        Measurement{
            "deep_plain", Family::deep, options(never, never), 100, {15'307, 237'248, 124'589}},
        Measurement{
            "deep_bounded", Family::deep, options(0, never), 200, {15'352, 248'979, 157'969}},
        Measurement{"deep_learning", Family::deep, options(0, 0), 200, {1'753, 53'233, 9'342}},
        Measurement{"minimums", Family::minimums, SearchOptions{}, 150, {4'610, 251'829, 485'461}},
        Measurement{"minimums_bounded",
                    Family::minimums,
                    options(0, never),
                    150,
                    {14'523, 815'107, 1'395'283}},
        Measurement{
            "minimums_learning", Family::minimums, options(0, 0), 150, {1'555, 175'242, 276'875}},
        Measurement{"exclusive", Family::exclusive, SearchOptions{}, 500, {2'986, 26'142, 0}},
        Measurement{"exclusive_learning", Family::exclusive, options(0, 0), 500, {932, 97'693, 0}},
        Measurement{"equal", Family::equal, SearchOptions{}, 100, {16'812, 151'553, 0}},
        Measurement{"equal_bounded", Family::equal, options(0, never), 50, {33'597, 141'027, 0}},
        Measurement{"equal_learning", Family::equal, options(0, 0), 100, {5'461, 158'653, 0}},
        Measurement{"wide", Family::wide, SearchOptions{}, 100, {10'593, 132'796, 89'562}},
        Measurement{
            "wide_bounded", Family::wide, options(0, never), 50, {30'006, 290'931, 241'533}},
        Measurement{"wide_learning", Family::wide, options(0, 0), 100, {788, 217'855, 215'564}},
        Measurement{"nested", Family::nested, SearchOptions{}, 300, {3'772, 11'175, 0}},
        Measurement{"nested_bounded", Family::nested, options(0, never), 300, {2'197, 8'077, 0}},
        Measurement{"nested_learning", Family::nested, options(0, 0), 300, {981, 25'706, 0}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace cbc::search_effort_test
