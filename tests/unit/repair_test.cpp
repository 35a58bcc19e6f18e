// The repair of the present configuration, and the bounds of answers that are not proven.
#include <string>

#include <gtest/gtest.h>

#include "runtime/solver/solver.h"
#include "unit/compiled_fixture.h"

namespace cbc::repair_test {
namespace {

/// The answer after one decision, by a repair where there is none yet.
std::string repair(const CompiledCatalog& catalog, const Problem& problem,
                   SearchBound* bound = nullptr) {
  SearchOptions options;
  options.max_nodes = 1;
  Solver solver(catalog, options);
  Assignment solution;
  const SearchResult result = solver.solve(problem, solution);
  EXPECT_EQ(result.status, SearchStatus::feasible);
  if (bound != nullptr) *bound = result.bound;
  return test::show(catalog, solution);
}

constexpr const char* pairs = R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a, task: A, requires: [{task: P}, {task: Q}]}
- {behavior: b, task: B, requires: [{task: Q}, {task: R}]}
- {behavior: p1, task: P, suitability: 90}
- {behavior: p2, task: P, suitability: 80}
- {behavior: q1, task: Q, suitability: 90}
- {behavior: q2, task: Q, suitability: 80, requires: [{task: S}]}
- {behavior: r1, task: R, suitability: 90, requires: [{task: S}]}
- {behavior: r2, task: R, suitability: 80, requires: [{task: S}]}
- {behavior: s, task: S}
- {behavior: c, task: C}
exclusivity_constraints:
- mutually_exclusive: [C, S]
)";

TEST(Repair, KeepsWhatRuns) {
  const CompiledCatalog catalog = test::compile_text(pairs);
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "A");
  test::set_present(problem, catalog, "P", "p2");
  EXPECT_EQ(repair(catalog, problem), "A=a P=p2 Q=q1");
}

TEST(Repair, GivesUpTheBestBehaviorWhereWhatItRequiresIsExcluded) {
  const CompiledCatalog catalog = test::compile_text(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a, task: A, requires: [{task: P}, {task: Q}, {task: U}, {task: V}]}
- {behavior: p1, task: P, suitability: 90, requires: [{task: S}]}
- {behavior: p2, task: P, suitability: 50}
- {behavior: q1, task: Q, suitability: 80, requires: [{task: T}]}
- {behavior: q2, task: Q, suitability: 70}
- {behavior: u1, task: U, suitability: 90, requires: [{task: W}]}
- {behavior: u2, task: U, suitability: 50}
- {behavior: v1, task: V, suitability: 80, requires: [{task: X}]}
- {behavior: v2, task: V, suitability: 70}
- {behavior: s, task: S}
- {behavior: t, task: T}
- {behavior: w, task: W}
- {behavior: x, task: X}
exclusivity_constraints:
- mutually_exclusive: [S, T]
- mutually_exclusive: [W, X]
)");
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "A");
  EXPECT_EQ(repair(catalog, problem), "A=a P=p1 Q=q2 U=u1 V=v2 S=s W=w");
}

TEST(Repair, ServesTheMoreImportantRequest) {
  const CompiledCatalog catalog = test::compile_text(pairs);
  for (const bool c_first : {true, false}) {
    Problem problem = test::open_problem(catalog);
    test::demand(problem, catalog, "A");
    if (c_first) test::request(problem, catalog, "C");
    test::request(problem, catalog, "B");
    if (!c_first) test::request(problem, catalog, "C");
    test::set_present(problem, catalog, "C", "c");
    SearchBound bound;
    EXPECT_EQ(repair(catalog, problem, &bound),
              c_first ? "A=a P=p1 Q=q1 C=c" : "A=a B=b P=p1 Q=q1 R=r1 S=s");
    EXPECT_EQ(bound.more_requests, 1U);
    EXPECT_FALSE(bound.same_requests);
  }
}

TEST(SearchBound, OfAnAnswerThatServesAllRequests) {
  const CompiledCatalog catalog = test::compile_text(pairs);
  Problem problem = test::open_problem(catalog);
  test::request(problem, catalog, "A");
  test::set_present(problem, catalog, "P", "p2");
  SearchBound bound;
  EXPECT_EQ(repair(catalog, problem, &bound), "A=a P=p2 Q=q1");
  EXPECT_EQ(bound.more_requests, 0U);
  EXPECT_TRUE(bound.same_requests);
  EXPECT_GE(bound.suitability, 0.81);
  EXPECT_LT(bound.suitability, 0.8100001);
}

TEST(SearchBound, OfAnAnswerThatNoSearchFound) {
  const CompiledCatalog catalog = test::compile_text(std::string("tasks: [{task: X}]") + pairs);
  const GroupId group = catalog.tasks[test::task_id(catalog, "A")].group;
  ASSERT_EQ(group, 1U);
  Solver solver(catalog, {});
  const auto bound = [&](const Problem& problem) {
    // Other searches before leave nothing behind.
    Assignment solution;
    Problem before = test::open_problem(catalog, group);
    test::demand(before, catalog, "B");
    EXPECT_EQ(solver.solve(before, solution).status, SearchStatus::optimal);
    EXPECT_EQ(solver.solve(test::open_problem(catalog), solution).status, SearchStatus::optimal);
    return solver.bound(problem, Assignment(problem.may_stop.size(), none));
  };

  Problem exclusive = test::open_problem(catalog, group);
  for (const char* task : {"A", "B", "C"}) test::request(exclusive, catalog, task);
  test::demand(exclusive, catalog, "A");
  test::demand(exclusive, catalog, "C");
  const SearchBound without_b = bound(exclusive);
  EXPECT_EQ(without_b.more_requests, 2U);
  EXPECT_FALSE(without_b.same_requests);
  EXPECT_GE(without_b.suitability, 0.81);
  EXPECT_LT(without_b.suitability, 0.8100001);

  Problem unavailable = test::open_problem(catalog, group);
  for (const char* task : {"A", "B", "C"}) test::request(unavailable, catalog, task);
  test::leave_out_all(unavailable, catalog, "S");
  EXPECT_EQ(bound(unavailable).more_requests, 2U) << "R requires S, and B requires R";
}

}  // namespace
}  // namespace cbc::repair_test
