#include "solver/domains.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compile/compile.h"
#include "compiled/compiled_catalog.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc {
namespace {

using test::compile_text;
using test::open_problem;

constexpr const char* three_tasks = R"(
tasks:
- {task: A, start_on_request: false}
- {task: B}
- {task: C, start_on_request: false}
behaviors:
- {behavior: a0, task: A}
- {behavior: a1, task: A, suitability: 90}
- {behavior: a2, task: A, suitability: 80}
- {behavior: b0, task: B, suitability: 50}
- {behavior: b1, task: B, suitability: 0}
- {behavior: c0, task: C}
exclusivity_constraints:
- mutually_exclusive: [A, B, C]
)";

std::vector<std::uint32_t> take_changes(Domains& domains) {
  std::vector<std::uint32_t> changes;
  while (domains.has_changed()) changes.push_back(domains.next_changed());
  std::sort(changes.begin(), changes.end());
  return changes;
}

using Changes = std::vector<std::uint32_t>;

/// Everything that can be seen from outside, but for changes.
std::string describe(const Domains& domains) {
  std::string text;
  for (std::uint32_t task = 0; task < domains.task_count(); ++task) {
    text += domains.needed(task) ? "!" : "?";
    for (std::uint32_t index = 0; index < domains.values(task).size(); ++index) {
      if (domains.has(task, index)) text += std::to_string(index) + ",";
    }
    text += "#" + std::to_string(domains.count(task));
    if (domains.count(task) > 0) text += " best " + std::to_string(domains.best(task));
    text += "; ";
  }
  const Domains::Sums& sums = domains.sums();
  text += "needed";
  for (const std::uint32_t task : domains.needed_tasks()) text += " " + std::to_string(task);
  return text + " cost " + std::to_string(sums.cost) + " factors " + std::to_string(sums.factors) +
         " zeros " + std::to_string(sums.zeros) + " idle " + std::to_string(sums.idle);
}

TEST(Domains, LoadsAProblem) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Problem problem = open_problem(catalog);
  test::leave_out(problem, catalog, "A", "a0");
  test::leave_out_all(problem, catalog, "C");
  test::demand(problem, catalog, "A");
  Domains domains(catalog);
  domains.load(problem);
  EXPECT_EQ(describe(domains),
            "?1,2,#2 best 1; ?0,1,#2 best 0; ?#0; needed cost 0 factors 0 zeros 0 idle 0")
      << "what has to run is for the caller to say";
  EXPECT_EQ(take_changes(domains), (Changes{2})) << "a task that cannot run";
  EXPECT_EQ(domains.value(0, 1).suitability, 900'000U);
  EXPECT_EQ(domains.word_begin(2), 2U);
}

TEST(Domains, SumsAreOverNeededTasksAtTheirBest) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_TRUE(domains.need(0));
  EXPECT_EQ(domains.sums().idle, 1U);
  EXPECT_EQ(domains.sums().factors, 0U);
  EXPECT_TRUE(domains.remove(0, 0));
  EXPECT_EQ(domains.sums().cost, log_cost(900'000));
  EXPECT_EQ(domains.sums().factors, 1U);
  EXPECT_TRUE(domains.need(1));
  EXPECT_EQ(domains.sums().cost, log_cost(900'000) + log_cost(500'000));
  EXPECT_EQ(domains.sums().factors, 2U);
  EXPECT_EQ(domains.sums().idle, 1U) << "B starts on request only";
  EXPECT_TRUE(domains.keep_only(1, 1));
  EXPECT_EQ(domains.sums().zeros, 1U);
  EXPECT_EQ(domains.sums().factors, 1U) << "a zero is no factor";
  EXPECT_EQ(domains.sums().cost, log_cost(900'000));
  EXPECT_EQ(domains.needed_tasks(), (Changes{0, 1}));
}

TEST(Domains, NeedingATaskTwiceCountsOnce) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_TRUE(domains.need(0));
  const std::string once = describe(domains);
  EXPECT_TRUE(domains.need(0));
  EXPECT_EQ(describe(domains), once);
}

TEST(Domains, OnlyTheNeededFailWithoutABehavior) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_TRUE(domains.close(0));
  EXPECT_FALSE(domains.need(0));
  EXPECT_TRUE(domains.remove(2, 0));
  EXPECT_TRUE(domains.need(1));
  EXPECT_FALSE(domains.close(1));
  EXPECT_TRUE(domains.remove(1, 0));
  EXPECT_FALSE(domains.remove(1, 1));
}

TEST(Domains, RemoveAllTakesAMaskOut) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  const std::uint64_t ends = 0b101;
  EXPECT_FALSE(domains.all_within(0, &ends));
  EXPECT_TRUE(domains.remove(0, 1));
  EXPECT_TRUE(domains.all_within(0, &ends));
  EXPECT_TRUE(domains.remove_all(0, &ends));
  EXPECT_EQ(domains.count(0), 0U);
  EXPECT_TRUE(domains.all_within(0, &ends));
}

TEST(Domains, KeepOnlyLeavesNotRunningInTheDomain) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_TRUE(domains.keep_only(0, 2));
  EXPECT_EQ(domains.count(0), 1U);
  EXPECT_EQ(domains.best(0), 2U);
  EXPECT_TRUE(domains.may_stop(0));
}

TEST(Domains, NotesChangesOfNeededTasksAndTasksLeftWithoutBehavior) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_FALSE(domains.has_changed());
  EXPECT_TRUE(domains.remove(0, 0));
  EXPECT_FALSE(domains.has_changed()) << "no one needs it yet";
  EXPECT_TRUE(domains.need(0));
  EXPECT_EQ(take_changes(domains), (Changes{0}));
  EXPECT_TRUE(domains.remove(0, 0)) << "it is gone already";
  EXPECT_FALSE(domains.has_changed());
  EXPECT_TRUE(domains.remove(0, 1));
  EXPECT_TRUE(domains.close(1));
  EXPECT_EQ(take_changes(domains), (Changes{0, 1}));
  EXPECT_TRUE(domains.close(2));
  domains.forget_changes();
  EXPECT_FALSE(domains.has_changed());
  const Domains::Mark mark = domains.mark();
  EXPECT_TRUE(domains.need(0));
  domains.undo_to(mark);
  EXPECT_FALSE(domains.has_changed()) << "undoing forgets them";
}

TEST(Domains, UndoGoesBackToAnyMark) {
  const CompiledCatalog catalog = compile_text(three_tasks);
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  std::vector<Domains::Mark> marks;
  std::vector<std::string> states;
  const auto keep = [&] {
    marks.push_back(domains.mark());
    states.push_back(describe(domains));
  };
  keep();
  EXPECT_TRUE(domains.need(0));
  keep();
  EXPECT_TRUE(domains.remove(0, 0));
  EXPECT_TRUE(domains.need(1));
  keep();
  EXPECT_TRUE(domains.keep_only(0, 2));
  EXPECT_TRUE(domains.close(2));
  EXPECT_FALSE(domains.close(1));
  for (std::size_t i = marks.size(); i-- > 0;) {
    domains.undo_to(marks[i]);
    EXPECT_EQ(describe(domains), states[i]);
  }
}

CompiledCatalog wide_catalog() {
  std::string text = "behaviors:\n";
  for (int i = 0; i < 150; ++i) {
    text += "- {behavior: a" + std::to_string(i) +
            ", task: A, suitability: " + std::to_string(100 - i / 2) + "}\n";
  }
  return compile_text(text + "- {behavior: b, task: B, requires: [{task: A}]}\n");
}

TEST(Domains, WorkOverSeveralWords) {
  const CompiledCatalog catalog = wide_catalog();
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_EQ(domains.count(0), 150U);
  EXPECT_EQ(domains.words(0).size(), 3U);
  EXPECT_EQ(domains.word_begin(1), 3U);
  for (std::uint32_t index = 0; index < 128; ++index) EXPECT_TRUE(domains.remove(0, index));
  EXPECT_EQ(domains.best(0), 128U);
  EXPECT_EQ(domains.count(0), 22U);
  const std::vector<std::uint64_t> last_word{0, 0, ~std::uint64_t{0}};
  EXPECT_TRUE(domains.all_within(0, last_word.data()));
  const std::vector<std::uint64_t> first_words{~std::uint64_t{0}, ~std::uint64_t{0}, 0};
  EXPECT_FALSE(domains.all_within(0, first_words.data()));
  EXPECT_TRUE(domains.need(0));
  EXPECT_TRUE(domains.remove_all(0, first_words.data()));
  EXPECT_FALSE(domains.remove_all(0, last_word.data()));
}

TEST(Domains, KeepOnlyWorksInEveryWordOfANeededTask) {
  const CompiledCatalog catalog = wide_catalog();
  Domains domains(catalog);
  domains.load(open_problem(catalog));
  EXPECT_TRUE(domains.need(0));
  const Domains::Mark mark = domains.mark();
  for (const std::uint32_t index : {0U, 63U, 64U, 127U, 128U, 149U}) {
    EXPECT_TRUE(domains.keep_only(0, index));
    EXPECT_EQ(domains.count(0), 1U);
    EXPECT_EQ(domains.best(0), index);
    EXPECT_EQ(domains.sums().cost, domains.value(0, index).cost);
    domains.undo_to(mark);
    EXPECT_EQ(domains.count(0), 150U);
    EXPECT_EQ(domains.best(0), 0U);
  }
}

/// What the sums have to be, from scratch.
void expect_true_sums(const Domains& domains, const CompiledCatalog& catalog) {
  Domains::Sums expected;
  std::vector<std::uint32_t> needed;
  for (std::uint32_t task = 0; task < domains.task_count(); ++task) {
    if (!domains.needed(task) || domains.count(task) == 0) continue;
    needed.push_back(task);
    std::uint32_t best = 0;
    while (!domains.has(task, best)) ++best;
    EXPECT_EQ(domains.best(task), best);
    const Millionths suitability = domains.value(task, best).suitability;
    expected.cost += log_cost(suitability);
    if (suitability == 0) {
      ++expected.zeros;
    } else if (suitability < one_million) {
      ++expected.factors;
    }
    if (!catalog.tasks[domains.first_task() + task].start_on_request) ++expected.idle;
  }
  EXPECT_EQ(domains.sums().cost, expected.cost);
  EXPECT_EQ(domains.sums().factors, expected.factors);
  EXPECT_EQ(domains.sums().zeros, expected.zeros);
  EXPECT_EQ(domains.sums().idle, expected.idle);
  std::vector<std::uint32_t> listed = domains.needed_tasks();
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, needed);
}

TEST(Domains, RandomChangesAreUndoneExactly) {
  test::Random random(4);
  test::Shape shape;
  shape.tasks = 8;
  shape.zero = 10;
  for (int round = 0; round < 300; ++round) {
    shape.most_behaviors = round % 5 == 0 ? 150 : 5;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const std::uint32_t group = test::largest_group(catalog);
    Domains domains(catalog);
    domains.load(open_problem(catalog, group));
    std::vector<Domains::Mark> marks{domains.mark()};
    std::vector<std::string> states{describe(domains)};
    for (int step = 0; step < 40; ++step) {
      const auto task = static_cast<std::uint32_t>(random.below(domains.task_count()));
      const std::size_t values = domains.values(task).size();
      const auto index = static_cast<std::uint32_t>(random.below(values + (values == 0 ? 1 : 0)));
      const std::size_t operation = random.below(6);
      bool is_consistent = true;
      if (operation == 0) {
        is_consistent = domains.need(task);
      } else if (operation == 1 && domains.may_stop(task) && random.percent(30)) {
        is_consistent = domains.close(task);
      } else if (operation == 2 && values > 0) {
        is_consistent = domains.remove(task, index);
      } else if (operation == 3 && values > 0 && domains.has(task, index)) {
        is_consistent = domains.keep_only(task, index);
      } else if (operation == 4) {
        std::vector<std::uint64_t> mask;
        for (std::size_t word = 0; word < domains.words(task).size(); ++word) {
          mask.push_back(random.next() & random.next());
        }
        const std::vector<std::uint64_t> before(domains.words(task).begin(),
                                                domains.words(task).end());
        is_consistent = domains.remove_all(task, mask.data());
        for (std::size_t word = 0; is_consistent && word < mask.size(); ++word) {
          EXPECT_EQ(domains.words(task)[word], before[word] & ~mask[word]);
        }
      }
      if (is_consistent) {
        expect_true_sums(domains, catalog);
        marks.push_back(domains.mark());
        states.push_back(describe(domains));
      }
      if (!is_consistent || random.percent(20)) {
        const std::size_t back = random.below(marks.size());
        domains.undo_to(marks[back]);
        ASSERT_EQ(describe(domains), states[back]);
        marks.resize(back + 1);
        states.resize(back + 1);
      }
    }
  }
}

}  // namespace
}  // namespace cbc
