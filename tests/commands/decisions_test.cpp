// Remembered answers against those that are computed for one question alone.
#include "explore/moves/decisions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"
#include "support/read_file.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::decisions_test {
namespace {

using test::compile_text;
using test::Random;

using Answer = std::optional<std::vector<Word>>;

Answer answer_of(Decisions& decisions, const GroupQuestion& question, const Model& model) {
  const Word* const values = decisions.find(question);
  if (values == nullptr) return std::nullopt;
  return std::vector<Word>(values, values + words_for(model.value_count()));
}

/// Owns what a question refers to.
struct RandomQuestion {
  RandomQuestion(Random& random, const Model& model)
      : domains(words_for(model.value_count())),
        must_run(words_for(model.tasks().size())),
        present(words_for(model.value_count())) {
    question.group = static_cast<std::uint32_t>(random.below(model.groups().size()));
    const Model::Group& group = model.groups()[question.group];
    for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
      const BitRange values = model.tasks()[task].values;
      const bool is_open = random.percent(70);
      for (std::uint32_t value = values.begin; value < values.end; ++value) {
        if (is_open && random.percent(80)) set_bit(domains.data(), value);
      }
      if (values.size() > 0 && random.percent(30)) {
        set_bit(present.data(),
                values.begin + static_cast<std::uint32_t>(random.below(values.size())));
      }
      // Others are never requested.
      if (!model.tasks()[task].start_on_request && model.tasks()[task].reactive == none) continue;
      if (random.percent(10)) set_bit(must_run.data(), task);
      if (requests.size() < 5 && random.percent(50)) {
        requests.push_back(static_cast<std::uint16_t>(task));
      }
    }
  }

  [[nodiscard]] const GroupQuestion& ask() {
    question.domains = domains.data();
    question.must_run = must_run.data();
    question.present = present.data();
    question.requests = requests;
    return question;
  }

  std::vector<Word> domains;
  std::vector<Word> must_run;
  std::vector<Word> present;
  std::vector<std::uint16_t> requests;
  GroupQuestion question;
};

/// Asks questions again and again, with their requests in several orders. `most_bytes`: of the
/// answers that are remembered.
void expect_fresh_answers(const CompiledCatalog& catalog, std::size_t most_bytes) {
  std::vector<GroupId> groups;
  for (GroupId group(0); group < catalog.group_count(); ++group) groups.push_back(group);
  const Assumptions assumptions = default_assumptions(catalog);
  const Model model(catalog, groups, assumptions);
  Decisions remembering(model, most_bytes);
  Random random(1);
  std::vector<RandomQuestion> questions;
  questions.reserve(60);
  for (int i = 0; i < 60; ++i) questions.emplace_back(random, model);
  std::size_t infeasible = 0;
  for (int i = 0; i < 600; ++i) {
    RandomQuestion& question = questions[random.below(questions.size())];
    random.shuffle(question.requests);
    Decisions fresh(model);
    const Answer expected = answer_of(fresh, question.ask(), model);
    ASSERT_EQ(answer_of(remembering, question.ask(), model), expected) << i;
    if (!expected) ++infeasible;
  }
  EXPECT_GT(infeasible, 10U);
  EXPECT_LT(infeasible, 590U);
  EXPECT_EQ(remembering.remembered() + remembering.computed(), 600U);
  EXPECT_GT(remembering.remembered(), 100U);
}

constexpr std::size_t enough = std::size_t{1} << 24U;
/// Of a few answers.
constexpr std::size_t little = 20'000;

CompiledCatalog quadrotor() {
  return compile_text(test::read_file(CBC_SOURCE_DIR "/catalogs/quadrotor.yaml"));
}

/// Each of A and B needs what the other one must not have, so the order of requests decides.
CompiledCatalog rivals() {
  return compile_text(R"(
tasks:
- {task: A}
- {task: B}
- {task: C}
- {task: S, start_on_request: false}
- {task: T, start_on_request: false}
behaviors:
- {behavior: A_S, task: A, requires: [{task: S}]}
- {behavior: B_T, task: B, requires: [{task: T}]}
- {behavior: C_S, task: C, suitability: 80, requires: [{task: S}]}
- {behavior: C_T, task: C, requires: [{task: T}]}
- {behavior: S_1, task: S}
- {behavior: T_1, task: T}
- {behavior: D_1, task: D}
exclusivity_constraints:
- mutually_exclusive: [S, T]
)");
}

TEST(Decisions, RememberedAnswersAreThoseOfAFreshSolver) {
  expect_fresh_answers(quadrotor(), enough);
  expect_fresh_answers(rivals(), enough);
}

TEST(Decisions, AnswersAreRightAfterOthersWereForgotten) { expect_fresh_answers(rivals(), little); }

TEST(Decisions, ForgetsWhenThereAreTooMany) {
  const CompiledCatalog catalog = rivals();
  const Assumptions assumptions = default_assumptions(catalog);
  const Model model(catalog, {GroupId(0)}, assumptions);
  const auto computed_with = [&](std::size_t most_bytes) {
    Decisions decisions(model, most_bytes);
    Random random(2);
    std::vector<RandomQuestion> questions;
    questions.reserve(300);
    for (int i = 0; i < 300; ++i) questions.emplace_back(random, model);
    for (int round = 0; round < 2; ++round) {
      for (RandomQuestion& question : questions) static_cast<void>(decisions.find(question.ask()));
    }
    return decisions.computed();
  };
  EXPECT_LE(computed_with(enough), 300U);
  EXPECT_GT(computed_with(little), 300U);
}

}  // namespace
}  // namespace cbc::decisions_test
