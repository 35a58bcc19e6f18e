// Minimal cut sets on catalogs that a person can check.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/support/wording.h"
#include "runtime/compiled/compiled_catalog.h"
#include "support/read_file.h"
#include "unit/compiled_fixture.h"
#include "verify/engine/effects.h"

namespace cbc::cut_sets_test {
namespace {

using test::compile_text;
using test::task_id;

std::string show_sets(const CompiledCatalog& catalog, const TaskEffects& found) {
  std::string text;
  for (const auto& [kind, set, situation, best] : found.effects) {
    text += text.empty() ? "{" : " {";
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (i > 0) text += ' ';
      text += catalog.name_of_behavior(set[i]);
    }
    text += '}';
  }
  return text;
}

TaskEffects find(const CompiledCatalog& catalog, std::string_view task, std::uint32_t order) {
  EffectOptions options;
  options.order = order;
  return find_cut_sets(SituationSpace(catalog, {}, {}), task_id(catalog, task), options);
}

std::string cut_sets(const CompiledCatalog& catalog, std::string_view task, std::uint32_t order) {
  const TaskEffects found = find(catalog, task, order);
  EXPECT_TRUE(found.complete);
  return show_sets(catalog, found);
}

constexpr std::string_view survey = R"(behaviors:
- {behavior: far, task: SURVEY, suitability: 60, requires: [{task: FLY}]}
- {behavior: close, task: SURVEY, requires: [{task: FLY, minimum_performance: 56}]}
- {behavior: precisely, task: FLY, suitability: 70, requires: [{task: LOCALIZE}]}
- {behavior: plainly, task: FLY, suitability: 50}
- {behavior: rtk, task: LOCALIZE, suitability: 80}
- {behavior: gps, task: LOCALIZE, suitability: 75}
)";

TEST(CutSets, SayWhatIsCompleteWhenTheyAreStopped) {
  const CompiledCatalog catalog = compile_text(survey);
  EffectOptions options;
  options.order = 4;
  const TaskEffects all =
      find_cut_sets(SituationSpace(catalog, {}, {}), task_id(catalog, "SURVEY"), options);
  for (std::uint64_t searches = 0; searches <= all.searches; ++searches) {
    std::uint64_t left = searches;
    std::string how_far;
    options.budget.is_stopped = [&left] { return left-- == 0; };
    options.budget.tell = [&how_far](const std::string& /*what*/, const auto& say) {
      how_far = say();
    };
    const TaskEffects some =
        find_cut_sets(SituationSpace(catalog, {}, {}), task_id(catalog, "SURVEY"), options);
    ASSERT_EQ(some.complete, searches == all.searches);
    if (some.complete) {
      EXPECT_EQ(some.effects, all.effects);
      EXPECT_NE(how_far.find(" sets of 3 behaviors, "), std::string::npos)
          << "the last search is for {plainly rtk gps}";
      break;
    }
    EXPECT_EQ(how_far.substr(how_far.find(" of ")),
              fmt::format(" of {}, {} found)", quantity(some.incomplete_size, "behavior"),
                          some.effects.size()));
    ASSERT_LE(some.effects.size(), all.effects.size());
    for (std::size_t i = 0; i < all.effects.size(); ++i) {
      if (i < some.effects.size()) {
        EXPECT_EQ(some.effects[i], all.effects[i]);
      } else {
        EXPECT_GE(all.effects[i].faults.size(), some.incomplete_size) << searches;
      }
    }
  }
}

/// Nine pigeons in eight holes, which a search by propagation refutes hole by hole.
std::string pigeons() {
  constexpr int holes = 8;
  std::string behaviors = "behaviors:\n- {behavior: all, task: ALL, requires: [";
  std::string lists = "exclusivity_constraints:\n";
  for (int pigeon = 0; pigeon <= holes; ++pigeon)
    behaviors += fmt::format("{{task: P{}}}, ", pigeon);
  behaviors += "]}\n";
  for (int hole = 0; hole < holes; ++hole) {
    lists += "- mutually_exclusive: [";
    for (int pigeon = 0; pigeon <= holes; ++pigeon) {
      const std::string place = fmt::format("{}_{}", pigeon, hole);
      behaviors += fmt::format(
          "- {{behavior: go_{0}, task: P{1}, requires: [{{task: IN_{0}}}]}}\n"
          "- {{behavior: in_{0}, task: IN_{0}}}\n",
          place, pigeon);
      lists += fmt::format("IN_{}, ", place);
    }
    lists += "]\n";
  }
  return behaviors + lists;
}

TEST(CutSets, CanBeStoppedInALongSearch) {
  const CompiledCatalog catalog = compile_text(pigeons());
  const TaskId task = task_id(catalog, "ALL");
  EffectOptions options;
  int calls = 0;
  options.budget.is_stopped = [&calls] { return ++calls == 0; };
  const TaskEffects all = find_cut_sets(SituationSpace(catalog, {}, {}), task, options);
  EXPECT_TRUE(all.complete);
  EXPECT_EQ(show_sets(catalog, all), "{}");
  EXPECT_EQ(all.searches, 1U);
  EXPECT_GT(calls, 1) << "not hard enough";
  int left = 1;
  options.budget.is_stopped = [&left] { return left-- <= 0; };
  const TaskEffects none = find_cut_sets(SituationSpace(catalog, {}, {}), task, options);
  EXPECT_FALSE(none.complete);
  EXPECT_EQ(none.incomplete_size, 0U);
  EXPECT_TRUE(none.effects.empty());
}

CompiledCatalog own_catalog(const std::string& name) {
  return compile_text(test::read_file(std::filesystem::path(CBC_SOURCE_DIR) / "catalogs" / name));
}

/// catalogs/autoware.yaml has its diagnostics as behaviors that require nothing. The minimal cut
/// sets of diagnostics alone were found from the original files, by a script and with SCRAM.
TEST(CutSets, OfAutoware) {
  const CompiledCatalog catalog = own_catalog("autoware.yaml");
  const auto is_diagnostic = [&](BehaviorId one) { return catalog.requirements[one].empty(); };
  using Counts = std::vector<std::size_t>;  // of one behavior, of two
  const std::map<std::string, Counts> expected{
      {"autonomous", {34, 2}}, {"comfortable_stop", {33, 2}},
      {"pull_over", {33, 2}},  {"emergency_stop", {4, 1}},
      {"local", {7, 1}},       {"remote", {7, 1}},
      {"stop", {1, 0}}};
  for (const auto& [mode, counts] : expected) {
    Counts found(2);
    for (const Effect& lost : find(catalog, "/autoware/modes/" + mode, 2).effects) {
      const BehaviorSet& set = lost.faults;
      if (std::all_of(set.begin(), set.end(), is_diagnostic)) ++found.at(set.size() - 1);
    }
    EXPECT_EQ(found, counts) << mode;
  }
}

TEST(CutSets, OfTheQuadrotor) {
  const CompiledCatalog catalog = own_catalog("quadrotor.yaml");
  EXPECT_EQ(cut_sets(catalog, "LAND", 3),
            "{LAND} {QUADROTOR_PID_THRUST_CONTROL} "
            "{SELF_LOCALIZE_WITH_GROUND_TRUTH SELF_LOCALIZE_WITH_EKF_SENSOR_FUSION} "
            "{SELF_LOCALIZE_WITH_GROUND_TRUTH ESTIMATE_POSITION_WITH_SENSOR "
            "ESTIMATE_POSITION_WITH_LINEAR_SPEED}");
}

/// An underwater vehicle that finds its way by what it hears or sees, each in its own water.
constexpr std::string_view vehicle = R"(situation:
- {variable: WATER, values: [clear, murky]}
- {variable: DEPTH, values: [low, high]}
behaviors:
- {behavior: map_by_sight, task: MAP, situation: {WATER: clear}, requires: [{task: LOCATE}]}
- {behavior: map_by_sonar, task: MAP, situation: {WATER: murky}, requires: [{task: LOCATE}]}
- {behavior: see_ground, task: LOCATE, situation: {WATER: clear, DEPTH: low}}
- {behavior: hear_beacon, task: LOCATE, situation: {WATER: murky}}
- {behavior: dig, task: SAMPLE, situation: {DEPTH: high}, requires: [{task: HOLD}]}
- {behavior: hold, task: HOLD, situation: {DEPTH: low}}
)";

TEST(CutSets, CountOnlyBehaviorsThatFitTogether) {
  const CompiledCatalog catalog = compile_text(vehicle);
  EXPECT_EQ(cut_sets(catalog, "MAP", 2),
            "{map_by_sight map_by_sonar} {map_by_sight hear_beacon} "
            "{map_by_sonar see_ground} {see_ground hear_beacon}");
  EXPECT_EQ(cut_sets(catalog, "SAMPLE", 2), "{}") << "it fits nowhere";
}

/// The vehicle does not dive deep where it sees nothing, nor stay up where it does.
TEST(CutSets, DoNotCountSituationsThatNeverOccur) {
  const CompiledCatalog catalog = compile_text(vehicle);
  const std::vector<SituationPart> never{{{{0, 1}, {1, 1}}, {}}, {{{0, 0}, {1, 0}}, {}}};
  EffectOptions options;
  options.order = 2;
  const SituationSpace situations(catalog, {}, never);
  EXPECT_EQ(show_sets(catalog, find_cut_sets(situations, task_id(catalog, "MAP"), options)),
            "{map_by_sonar} {hear_beacon}")
      << "in clear water it is too deep to see the ground";
  options.in_some_situation = true;
  const TaskEffects some = find_cut_sets(situations, task_id(catalog, "MAP"), options);
  constexpr auto lost = Effect::Kind::lost;
  const std::vector<Effect> expected{
      {lost, {}, {{0, 0}}},
      {lost, {}, {{1, 1}}},
      {lost, {BehaviorId(1)}, {}},
      {lost, {BehaviorId(3)}, {}},
  };
  EXPECT_EQ(some.effects, expected);
}

/// Thirty pairs of tasks have to agree about a variable each, which the best behaviors do not; the
/// last pair cannot. To try all combinations of what the others agree about would take forever.
TEST(CutSets, FindWhatCannotBeSettledAmongWhatCan) {
  std::string text = "situation:\n";
  for (int i = 0; i <= 30; ++i) text += fmt::format("- {{variable: V{}, values: [a, b]}}\n", i);
  text += "behaviors:\n- {behavior: all, task: ALL, requires: [";
  for (int i = 0; i <= 30; ++i) text += fmt::format("{{task: L{0}}}, {{task: R{0}}}, ", i);
  text += "]}\n";
  for (int i = 0; i <= 30; ++i) {
    text += fmt::format(
        "- {{behavior: l{0}a, task: L{0}, suitability: 90, situation: {{V{0}: a}}}}\n"
        "- {{behavior: r{0}b, task: R{0}, suitability: 90, situation: {{V{0}: b}}}}\n",
        i);
    if (i == 30) continue;
    text += fmt::format(
        "- {{behavior: l{0}b, task: L{0}, suitability: 80, situation: {{V{0}: b}}}}\n", i);
  }
  const CompiledCatalog catalog = compile_text(text);
  EffectOptions options;
  int searches = 0;
  options.budget.is_stopped = [&searches] { return ++searches >= 1000; };
  const TaskEffects found =
      find_cut_sets(SituationSpace(catalog, {}, {}), task_id(catalog, "ALL"), options);
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(show_sets(catalog, found), "{}");
  EXPECT_GT(searches, 30) << "not hard enough";
  EXPECT_LT(searches, 200);
}

/// Each pair of a hundred variables excludes one another but for one value: no situation is left.
TEST(SituationSpace, DecidesManyExclusions) {
  std::string text = "situation:\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("- {{variable: V{}}}\n", i);
  const CompiledCatalog catalog = compile_text(text + "behaviors: [{behavior: b, task: T}]\n");
  std::vector<SituationPart> never;
  for (std::uint32_t i = 0; i + 1 < 100; ++i) {
    never.push_back({{{i, 0}, {i + 1, 0}}, {}});
    never.push_back({{{i, 1}, {i + 1, 1}}, {}});
  }
  const SituationSpace alternating(catalog, {}, never);
  const auto found = alternating.find(alternating.all());
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i + 1 < 100; ++i) EXPECT_NE((*found)[i], (*found)[i + 1]);
  never.push_back({{{0, 0}, {99, 1}}, {}});
  never.push_back({{{0, 1}, {99, 0}}, {}});
  const SituationSpace none_left(catalog, {}, never);
  EXPECT_FALSE(none_left.find(none_left.all()));
}

}  // namespace
}  // namespace cbc::cut_sets_test
