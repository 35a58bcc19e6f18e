// What the golden cases of `cbc verify` cannot show, as it takes limits that depend on the machine.
#include "verify/report/verify_report.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "explore/properties/verification.h"
#include "support/exclusive_tasks.h"
#include "unit/compiled_fixture.h"

namespace cbc::verify_report_test {
namespace {

using Json = nlohmann::json;

std::shared_ptr<const CompiledCatalog> robot() {
  return std::make_shared<const CompiledCatalog>(test::compile_text(R"(behaviors:
- {behavior: DESCEND, task: LAND, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
- {behavior: CAMERA, task: LOCALIZE}
tasks:
- {task: LAND}
- {task: LOCALIZE, start_on_request: false}
)"));
}

/// The cut sets of LAND, of whose search only some steps were made.
VerifyResult cut_sets_after(int steps) {
  VerifyResult result;
  result.catalog = robot();
  EffectOptions options;
  options.order = 2;
  options.budget.is_stopped = [&steps] { return steps-- <= 0; };
  const TaskId land = result.catalog->task_ids[0];
  ReportedEffects& effects = result.effects.emplace();
  effects.are_cut_sets = true;
  effects.order = options.order;
  effects.tasks.push_back(find_cut_sets(SituationSpace(*result.catalog, {}, {}), land, options));
  return result;
}

TEST(VerifyReport, SaysHowFarASearchForCutSetsCame) {
  bool was_partial = false;
  for (int steps = 0;; ++steps) {
    const VerifyResult result = cut_sets_after(steps);
    const TaskEffects& found = result.effects->tasks.front();
    const std::string text = verify_to_text(result, plain_style());
    const Json json = Json::parse(verify_to_json(result))["effects"]["tasks"][0];
    EXPECT_EQ(result.is_answered(), found.complete);
    if (found.complete) {
      EXPECT_FALSE(json.contains("complete_order"));
      EXPECT_EQ(text.find("a limit"), std::string::npos);
      break;
    }
    if (found.incomplete_size == 0) {
      EXPECT_TRUE(json["complete_order"].is_null());
      EXPECT_NE(text.find("a limit ended the search at its beginning"), std::string::npos);
      EXPECT_NE(text.find("none found so far"), std::string::npos);
    } else {
      was_partial = true;
      EXPECT_EQ(json["complete_order"], found.incomplete_size - 1);
      EXPECT_NE(text.find("a limit ended the search: all sets of fewer than " +
                          std::to_string(found.incomplete_size)),
                std::string::npos);
    }
  }
  EXPECT_TRUE(was_partial);
}

std::string limit_of(const Budget& limits) {
  VerifyResult result;
  result.catalog = robot();
  result.limits = limits;
  ExplorationOptions options;
  options.budget = limits;
  const Verification verification = verify_groups(*result.catalog, options);
  EXPECT_FALSE(verification.is_complete());
  return describe_limit(result, verification.explorations.front());
}

/// The effects on LAND, of whose search only some steps were made.
VerifyResult effects_after(int steps) {
  VerifyResult result;
  result.catalog = robot();
  ReportedEffects& effects = result.effects.emplace();
  effects.situation = complete_situation(*result.catalog, {});
  EffectOptions options;
  options.budget.is_stopped = [&steps] { return steps-- <= 0; };
  effects.tasks.push_back(
      find_effects(*result.catalog, result.catalog->task_ids[0], effects.situation, {}, options));
  return result;
}

TEST(VerifyReport, SaysThatEffectsAreMissing) {
  constexpr const char* missing = "a limit ended the search, so effects are missing";
  int steps = 0;
  for (; steps < 100; ++steps) {
    const VerifyResult result = effects_after(steps);
    const bool is_complete = result.effects->is_complete();
    const std::string text = verify_to_text(result, plain_style());
    const Json json = Json::parse(verify_to_json(result))["effects"]["tasks"][0];
    EXPECT_EQ(result.is_answered(), is_complete);
    EXPECT_EQ(text.find(missing) == std::string::npos, is_complete) << text;
    EXPECT_EQ(effects_to_html(result).find(missing) == std::string::npos, is_complete);
    EXPECT_EQ(json["complete"], is_complete);
    for (const Json& effect : json["effects"]) {
      EXPECT_TRUE(is_complete || effect["effect"] != "none") << "that is not known";
    }
    if (is_complete) break;
  }
  EXPECT_GT(steps, 1);
}

TEST(Effects, AreComparedExactly) {
  using Product = std::vector<Millionths>;
  EXPECT_FALSE(is_below(Product{600'000}, Product{}, 600));
  EXPECT_TRUE(is_below(Product{599'999}, Product{}, 600));
  EXPECT_FALSE(is_below(Product{900'000, 800'000}, Product{720'000}, 1000));
  EXPECT_TRUE(is_below(Product{900'000, 799'999}, Product{720'000}, 1000));
  EXPECT_FALSE(is_below(Product{0}, Product{0}, 1000));
  EXPECT_TRUE(is_below(Product{0}, Product{1}, 1));
}

TEST(VerifyReport, SaysWhatEndedAnExploration) {
  const std::string depth = "; every state up to depth 0 was visited";
  const std::string counts = "; states at each depth: 1";
  const std::string way_on = " (a higher limit goes on)";
  Budget of_states;
  of_states.max_states = 1;
  EXPECT_EQ(limit_of(of_states), "ended by --max-states 1" + depth + way_on + counts);
  Budget of_memory;
  of_memory.max_memory = 3 << 10;
  EXPECT_EQ(limit_of(of_memory), "ended by --max-memory 3K" + depth + way_on + counts);
  of_memory.max_memory = 1025;
  EXPECT_EQ(limit_of(of_memory), "ended by --max-memory 1025" + depth + way_on + counts);
  Budget of_time;
  of_time.seconds = 1e-9;
  EXPECT_EQ(limit_of(of_time), "ended by --time-limit 1e-09" + depth + way_on + counts);
  of_time = {};
  of_time.is_stopped = [] { return true; };
  EXPECT_EQ(limit_of(of_time), "interrupted" + depth + counts);
}

/// What is said of the pairs of a group of tasks that have all been seen to run, the first two of
/// them together.
std::string pairs_of_group(std::size_t tasks) {
  VerifyResult result;
  result.catalog =
      std::make_shared<const CompiledCatalog>(test::compile_text(test::exclusive_tasks(tasks)));
  Exploration exploration;
  exploration.groups = {GroupId(0)};
  exploration.complete = true;
  for (std::uint32_t task = 0; task < tasks; ++task) exploration.runs.emplace_back(task, 1);
  exploration.together = {{0, 1, 2}};
  result.parts.emplace_back().verification.explorations.push_back(exploration);
  const std::string text = verify_to_text(result, plain_style());
  const std::size_t begin = text.find("  never run together");
  return begin == std::string::npos ? "" : text.substr(begin);
}

TEST(VerifyReport, ListsThePairsOfTasksUnlessTheyAreMillions) {
  EXPECT_EQ(pairs_of_group(2), "");
  EXPECT_EQ(pairs_of_group(4),
            "  never run together        T0 with T2, T0 with T3, T1 with T2, T1 with T3,\n"
            "                            T2 with T3\n");
  EXPECT_EQ(pairs_of_group(5),
            "  never run together        9 pairs, marked -\n"
            "\n"
            "       1234\n"
            "  1 T0\n"
            "  2 T1 +\n"
            "  3 T2 --\n"
            "  4 T3 ---\n"
            "  5 T4 ----\n");
  EXPECT_EQ(pairs_of_group(81),
            "  never run together        3239 pairs (--format json lists the others)\n");
  EXPECT_EQ(pairs_of_group(2001),
            "  never run together        (pairs of more than 2000 tasks are not listed)\n");
}

}  // namespace
}  // namespace cbc::verify_report_test
