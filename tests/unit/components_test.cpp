#include "solver/components.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/propagator.h"
#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

using test::compile_text;
using test::local_task;
using test::open_problem;

/// Domains in which some tasks are needed, at the fixed point.
class Situation {
 public:
  Situation(const std::string& yaml, const std::vector<std::string>& needed)
      : catalog(compile_text(yaml)),
        domains(catalog),
        components(catalog, domains),
        problem_(open_problem(catalog)) {
    EXPECT_EQ(catalog.group_count(), 1U);
    Propagator propagator(catalog, domains);
    domains.load(problem_);
    propagator.load(problem_);
    components.load(problem_);
    for (const std::string& task : needed) EXPECT_TRUE(domains.need(local_task(catalog, task)));
    EXPECT_TRUE(propagator.propagate());
  }

  /// Enters the part of the task: the tasks of the part, or "no split".
  std::string enter(std::string_view task) {
    if (!components.enter_component_of(local_task(catalog, task))) return "no split";
    return describe();
  }

  [[nodiscard]] std::string describe() const {
    std::string text;
    for (std::uint32_t one = 0; one < domains.task_count(); ++one) {
      if (components.contains(one, components.depth()))
        text += std::string(catalog.name_of_task(one));
    }
    return text;
  }

  CompiledCatalog catalog;
  Domains domains;
  Components components;

 private:
  Problem problem_;
};

// R requires B and C, which have a choice each; D and E stand below them.
std::string two_branches(const std::string& more, const std::string& exclusivity = "") {
  return R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: r, task: R, requires: [{task: B}, {task: C}]}
- {behavior: b1, task: B, requires: [{task: D}]}
- {behavior: b2, task: B, suitability: 80}
- {behavior: c1, task: C, requires: [{task: E}]}
- {behavior: c2, task: C, suitability: 80}
- {behavior: d, task: D, suitability: 90}
- {behavior: e, task: E, suitability: 90}
)" + more +
         "exclusivity_constraints:\n" +
         (exclusivity.empty() ? "- mutually_exclusive: [R, Z]\n" : exclusivity) +
         "tasks: [{task: R}, {task: B}, {task: C}, {task: D}, {task: E}, {task: Z}]\n";
}

TEST(Components, OpenBranchesUnderWhatIsFixedAreIndependent) {
  Situation situation(two_branches(""), {"R"});
  EXPECT_EQ(situation.components.depth(), 0U);
  EXPECT_EQ(situation.describe(), "RBCDEZ") << "at first there is one part";
  EXPECT_EQ(situation.enter("B"), "BD");
  EXPECT_EQ(situation.components.depth(), 1U);
  EXPECT_TRUE(situation.components.contains(local_task(situation.catalog, "C"), 0));
  EXPECT_EQ(situation.enter("B"), "no split") << "it is one part";
  situation.components.leave();
  EXPECT_EQ(situation.components.depth(), 0U);
  EXPECT_EQ(situation.describe(), "RBCDEZ");
  EXPECT_EQ(situation.enter("C"), "CE");
}

TEST(Components, OneOpenBranchIsNoSplit) {
  Situation situation(two_branches(""), {"R"});
  const std::uint32_t c = local_task(situation.catalog, "C");
  EXPECT_TRUE(situation.domains.keep_only(c, 0));
  EXPECT_TRUE(situation.domains.need(local_task(situation.catalog, "E")));
  EXPECT_EQ(situation.enter("B"), "no split");
}

TEST(Components, AnOpenTaskThatBothMayRequireJoins) {
  EXPECT_EQ(Situation(two_branches("- {behavior: c3, task: C, requires: [{task: D}]}\n"), {"R"})
                .enter("B"),
            "no split");
}

TEST(Components, AFixedTaskThatBothMayRequireDoesNotJoin) {
  EXPECT_EQ(
      Situation(two_branches("- {behavior: c3, task: C, requires: [{task: D}]}\n"), {"R", "D"})
          .enter("B"),
      "B");
}

TEST(Components, ExclusivityOfTasksThatMayComeToBeNeededJoins) {
  EXPECT_EQ(Situation(two_branches("",
                                   "- mutually_exclusive: [R, Z]\n"
                                   "- mutually_exclusive: [D, E]\n"),
                      {"R"})
                .enter("B"),
            "no split");
}

TEST(Components, ABehaviorOfSeveralTasksJoins) {
  EXPECT_EQ(Situation(two_branches("- {behavior: x, tasks: [{task: B, suitability: 70}, "
                                   "{task: C, suitability: 70}]}\n"),
                      {"R"})
                .enter("B"),
            "no split");
}

TEST(Components, APerformanceThatDependsOnBothJoinsThroughFixedTasks) {
  const std::string more =
      "- {behavior: z1, task: Q, requires: [{task: R, minimum_performance: 60}]}\n";
  EXPECT_EQ(Situation(two_branches(more), {"Q"}).enter("B"), "no split");
  EXPECT_EQ(Situation(two_branches(more), {"R"}).enter("B"), "BD") << "Q need not run";
}

TEST(Components, AMinimumOfOneBranchLeavesThemApart) {
  EXPECT_EQ(Situation(two_branches("- {behavior: b3, task: B, suitability: 85, requires: "
                                   "[{task: D, minimum_performance: 50}]}\n"),
                      {"R"})
                .enter("B"),
            "BD");
}

TEST(Components, ASuitabilityOfZeroAnywhereForbidsSplitting) {
  EXPECT_EQ(Situation(two_branches("- {behavior: z, task: Z, suitability: 0}\n"), {"R"}).enter("B"),
            "no split");
}

TEST(Components, Nest) {
  Situation situation(R"(
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: r, task: R, requires: [{task: A}, {task: B}]}
- {behavior: a, task: A}
- {behavior: a2, task: A, suitability: 90}
- {behavior: b1, task: B, requires: [{task: C}, {task: D}]}
- {behavior: b2, task: B, suitability: 10}
- {behavior: c1, task: C}
- {behavior: c2, task: C, suitability: 90}
- {behavior: d1, task: D}
- {behavior: d2, task: D, suitability: 90}
)",
                      {"R"});
  EXPECT_EQ(situation.enter("B"), "BCD");
  Propagator propagator(situation.catalog, situation.domains);
  propagator.load(open_problem(situation.catalog));
  EXPECT_TRUE(situation.domains.keep_only(local_task(situation.catalog, "B"), 0));
  EXPECT_TRUE(propagator.propagate());
  EXPECT_EQ(situation.enter("C"), "C");
  EXPECT_EQ(situation.components.depth(), 2U);
  situation.components.leave();
  EXPECT_EQ(situation.describe(), "BCD");
  situation.components.leave();
  EXPECT_EQ(situation.describe(), "RABCD");
}

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
  text += "- {behavior: end, task: T" + std::to_string(length) + "}\n";
  Situation situation(text, {"T0"});
  Propagator propagator(situation.catalog, situation.domains);
  propagator.load(open_problem(situation.catalog));
  std::uint32_t entered = 0;
  for (int i = 0; i + 1 < length; ++i) {
    EXPECT_TRUE(
        situation.domains.keep_only(local_task(situation.catalog, "T" + std::to_string(i)), 0));
    EXPECT_TRUE(propagator.propagate());
    if (situation.enter("T" + std::to_string(i + 1)) != "no split") ++entered;
  }
  EXPECT_EQ(entered, Components::deepest);
  EXPECT_EQ(situation.components.depth(), Components::deepest);
}

}  // namespace
}  // namespace cbc
