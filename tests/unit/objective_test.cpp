#include "solver/objective.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

using test::compile_text;
using test::open_problem;

/// Compares single solutions with one another, and reads the keys of rule 5.
class Comparison {
 public:
  explicit Comparison(const std::string& yaml)
      : catalog(compile_text(yaml)), problem(open_problem(catalog)) {}

  /// Whether the solution `a` ("A=a1 B=b") is better than `b`.
  [[nodiscard]] bool is_better(std::string_view a, std::string_view b) const {
    Domains domains(catalog);
    Components components(catalog, domains);
    Objective objective(catalog, domains, components, ranks);
    domains.load(problem);
    components.load(problem);
    objective.load(problem);
    const Domains::Mark mark = domains.mark();
    Incumbent incumbent;
    choose(domains, b);
    EXPECT_TRUE(objective.may_beat(incumbent, 0)) << "there is no incumbent yet";
    objective.record(incumbent);
    EXPECT_FALSE(objective.may_beat(incumbent, 0)) << "nothing is better than itself";
    domains.undo_to(mark);
    choose(domains, a);
    return objective.may_beat(incumbent, 0);
  }

  /// The values of a task by key, best first; "-" is "not running".
  [[nodiscard]] std::string order(std::string_view task) const {
    Domains domains(catalog);
    Components components(catalog, domains);
    Objective objective(catalog, domains, components, ranks);
    domains.load(problem);
    components.load(problem);
    objective.load(problem);
    const std::uint32_t local = test::local_task(catalog, task);
    std::vector<std::pair<std::uint32_t, std::string>> keys{{objective.key(local, none), "-"}};
    for (std::uint32_t index = 0; index < domains.values(local).size(); ++index) {
      if (!domains.has(local, index)) continue;
      keys.emplace_back(
          objective.key(local, index),
          std::string(catalog.name_of_behavior(domains.value(local, index).behavior)));
    }
    std::sort(keys.begin(), keys.end());
    std::string text;
    for (const auto& [key, name] : keys) text += (text.empty() ? "" : " ") + name;
    return text;
  }

  CompiledCatalog catalog;
  Problem problem;
  std::vector<std::uint32_t> ranks;

 private:
  void choose(Domains& domains, std::string_view text) const {
    const Assignment answer = test::answer_of(catalog, text);
    for (std::uint32_t task = 0; task < answer.size(); ++task) {
      if (answer[task] == none) {
        EXPECT_TRUE(domains.close(task));
      } else {
        EXPECT_TRUE(domains.keep_only(task, answer[task]));
        EXPECT_TRUE(domains.need(task));
      }
    }
  }
};

constexpr const char* plain = R"(
default_values: {tasks: {start_on_request: false}}
tasks: [{task: A}, {task: B}, {task: C}]
behaviors:
- {behavior: a1, task: A}
- {behavior: a2, task: A}
- {behavior: a3, task: A, suitability: 90}
- {behavior: b1, task: B}
- {behavior: b2, task: B, suitability: 80}
- {behavior: c1, task: C}
- {behavior: c2, task: C, suitability: 72}
exclusivity_constraints:
- mutually_exclusive: [A, B]
- mutually_exclusive: [B, C]
)";

TEST(Objective, MoreSatisfiedRequestsAreBetterThanAnyPriority) {
  Comparison comparison(plain);
  test::request(comparison.problem, comparison.catalog, "C");
  test::request(comparison.problem, comparison.catalog, "A");
  test::request(comparison.problem, comparison.catalog, "B");
  EXPECT_TRUE(comparison.is_better("A=a3 B=b2", "C=c1"));
  EXPECT_FALSE(comparison.is_better("C=c1", "A=a3 B=b2"));
}

TEST(Objective, OfEqualNumbersTheMoreImportantRequestDecides) {
  Comparison comparison(plain);
  test::request(comparison.problem, comparison.catalog, "C");
  test::request(comparison.problem, comparison.catalog, "A");
  EXPECT_TRUE(comparison.is_better("C=c2", "A=a1"));
  EXPECT_FALSE(comparison.is_better("A=a1", "C=c2"));
}

TEST(Objective, SuitabilityIsAProductComparedExactly) {
  Comparison comparison(plain);
  EXPECT_TRUE(comparison.is_better("A=a3", "B=b2"));
  EXPECT_FALSE(comparison.is_better("B=b2", "A=a3"));
  // 90 % x 80 % = 72 %, so the number of running tasks decides.
  EXPECT_TRUE(comparison.is_better("C=c2", "A=a3 B=b2"));
  EXPECT_FALSE(comparison.is_better("A=a3 B=b2", "C=c2"));
}

TEST(Objective, SuitabilityIsExactBeyondLogarithms) {
  Comparison comparison(R"(
behaviors:
- {behavior: a1, task: A, suitability: 99.9999}
- {behavior: a2, task: A}
- {behavior: b1, task: B, suitability: 99.9999}
- {behavior: b2, task: B, suitability: 99.9998}
exclusivity_constraints:
- mutually_exclusive: [A, B]
)");
  EXPECT_TRUE(comparison.is_better("A=a1 B=b1", "A=a2 B=b2"));
  EXPECT_FALSE(comparison.is_better("A=a2 B=b2", "A=a1 B=b1"));
}

TEST(Objective, AZeroIsWorseThanAllElseAndTwoAreNoWorse) {
  Comparison comparison(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: a0, task: A, suitability: 0}
- {behavior: a1, task: A, suitability: 0.0001}
- {behavior: b0, task: B, suitability: 0}
- {behavior: b1, task: B, suitability: 0.0001}
exclusivity_constraints:
- mutually_exclusive: [A, B]
)");
  EXPECT_TRUE(comparison.is_better("A=a1 B=b1", "A=a0"));
  EXPECT_FALSE(comparison.is_better("A=a0", "A=a1 B=b1"));
  // Both are 0; f3 decides.
  EXPECT_TRUE(comparison.is_better("A=a0", "A=a0 B=b1"));
  EXPECT_FALSE(comparison.is_better("A=a0 B=b1", "A=a0"));
  // f3 and f4 are equal as well: rule 5 prefers the better behavior.
  EXPECT_TRUE(comparison.is_better("A=a0 B=b1", "A=a0 B=b0"));
}

TEST(Objective, OnlyTasksThatAreNotStartOnRequestCountAsIdle) {
  Comparison comparison(R"(
tasks: [{task: A}, {task: B, start_on_request: false}]
behaviors:
- {behavior: a, task: A}
- {behavior: b, task: B}
exclusivity_constraints:
- mutually_exclusive: [A, B]
)");
  EXPECT_TRUE(comparison.is_better("A=a", "B=b"));
  EXPECT_FALSE(comparison.is_better("B=b", "A=a"));
}

TEST(Objective, FewerChangesAreBetter) {
  Comparison comparison(plain);
  test::set_present(comparison.problem, comparison.catalog, "A", "a2");
  EXPECT_TRUE(comparison.is_better("A=a2", "A=a1"));
  EXPECT_TRUE(comparison.is_better("A=a2", "B=b1")) << "one activation and one deactivation";
}

TEST(Objective, ABehaviorOfSeveralTasksIsOneChange) {
  Comparison comparison(R"(
behaviors:
- {behavior: x, tasks: [{task: A}, {task: B}]}
- {behavior: a, task: A}
- {behavior: b, task: B}
)");
  EXPECT_TRUE(comparison.is_better("A=x B=x", "A=a B=b"));
  EXPECT_FALSE(comparison.is_better("A=a B=b", "A=x B=x"));
  test::set_present(comparison.problem, comparison.catalog, "A", "x");
  // It stays active as long as one of its tasks has it.
  EXPECT_TRUE(comparison.is_better("B=x", "B=b"));
  EXPECT_TRUE(comparison.is_better("A=x B=x", "A=a B=x"));
}

TEST(Objective, TasksInCatalogOrderDecideTies) {
  Comparison comparison(plain);
  test::request(comparison.problem, comparison.catalog, "A");
  // A runs in both with equally good behaviors; a1 stands first.
  EXPECT_TRUE(comparison.is_better("A=a1", "A=a2"));
  EXPECT_FALSE(comparison.is_better("A=a2", "A=a1"));
  // Without requests "not running" comes first, so the later task runs.
  Comparison other(plain);
  EXPECT_TRUE(other.is_better("C=c1", "A=a1"));
  EXPECT_FALSE(other.is_better("A=a1", "C=c1"));
}

TEST(Objective, ATaskThatDoesNotRunComesToRunLast) {
  Comparison comparison(plain);
  EXPECT_EQ(comparison.order("A"), "- a1 a2 a3");
}

TEST(Objective, ATaskThatHasToRunTakesItsBestBehaviorFirst) {
  Comparison comparison(plain);
  test::demand(comparison.problem, comparison.catalog, "A");
  EXPECT_EQ(comparison.order("A"), "a1 a2 a3 -");
}

TEST(Objective, ARunningTaskKeepsItsBehaviorIfNoneSuitsItBetter) {
  Comparison comparison(plain);
  test::set_present(comparison.problem, comparison.catalog, "A", "a2");
  EXPECT_EQ(comparison.order("A"), "a2 a1 a3 -");
}

TEST(Objective, ARunningTaskWithAWorseBehaviorTakesTheBestFirst) {
  Comparison comparison(plain);
  test::set_present(comparison.problem, comparison.catalog, "A", "a3");
  EXPECT_EQ(comparison.order("A"), "a1 a2 a3 -");
  test::leave_out(comparison.problem, comparison.catalog, "A", "a1");
  test::leave_out(comparison.problem, comparison.catalog, "A", "a2");
  EXPECT_EQ(comparison.order("A"), "a3 -") << "the best of the domain counts";
}

TEST(Objective, ARunningTaskThatLostItsBehaviorStopsLast) {
  Comparison comparison(plain);
  test::set_present(comparison.problem, comparison.catalog, "A", "a2");
  test::leave_out(comparison.problem, comparison.catalog, "A", "a2");
  EXPECT_EQ(comparison.order("A"), "a1 a3 -");
}

TEST(Objective, RanksOrderBehaviorsOfEqualSuitability) {
  Comparison comparison(plain);
  comparison.ranks = {1, 0, 2, 0, 1, 0, 1};
  EXPECT_EQ(comparison.order("A"), "- a2 a1 a3");
  test::set_present(comparison.problem, comparison.catalog, "A", "a1");
  EXPECT_EQ(comparison.order("A"), "a1 a2 a3 -");
  Comparison other(plain);
  other.ranks = {1, 0, 2, 0, 1, 0, 1};
  EXPECT_TRUE(other.is_better("A=a2", "A=a1"));
}

}  // namespace
}  // namespace cbc
