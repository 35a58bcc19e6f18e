// The catalogs of catalogs/ that are taken from real systems have what their sources have.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"

namespace cbc::golden::published_systems_test {
namespace {

using Names = std::set<std::string>;

/// A catalog as `cbc compile --dump` lists it, by names.
class System {
 public:
  explicit System(const std::string& name) {
    const Result result = run({{"compile", "--dump", "--format", "json", name}, folder});
    EXPECT_EQ(result.status, 0) << result.err;
    const nlohmann::json dump = nlohmann::json::parse(result.out);
    for (const nlohmann::json& group : dump["groups"]) {
      for (const nlohmann::json& task : group["tasks"]) tasks.emplace(task["task"], task);
      for (const nlohmann::json& list : group["exclusivity"]) exclusivity.push_back(list["tasks"]);
      for (const nlohmann::json& behavior : group["behaviors"]) {
        Names& required = requires_of[behavior["behavior"]];
        for (const nlohmann::json& entry : behavior["requires"]) required.insert(entry["task"]);
        for (const auto& [variable, values] : behavior["situation"].items()) {
          conditions_of[behavior["behavior"]].insert(variable);
        }
      }
    }
  }

  /// In the order of the catalog.
  [[nodiscard]] std::vector<std::string> behaviors_of(const std::string& task) const {
    std::vector<std::string> names;
    for (const nlohmann::json& entry : tasks.at(task)["behaviors"]) {
      names.push_back(entry["behavior"]);
    }
    return names;
  }

  static constexpr const char* folder = CBC_SOURCE_DIR "/catalogs";
  std::map<std::string, nlohmann::json> tasks;
  std::map<std::string, Names> requires_of;    ///< of each behavior
  std::map<std::string, Names> conditions_of;  ///< of each that has some: the situation variables
  std::vector<Names> exclusivity;
};

TEST(Suave, HasTheFunctionDesignsOfItsSource) {
  const System system("suave.yaml");
  std::map<std::string, std::map<std::string, double>> performances;
  for (const std::string task : {"GENERATE_SEARCH_PATH", "FOLLOW_PIPELINE", "MAINTAIN_MOTION"}) {
    for (const nlohmann::json& entry : system.tasks.at(task)["behaviors"]) {
      performances[task][entry["behavior"]] = entry["suitability"];
    }
  }
  EXPECT_EQ(performances,
            (std::map<std::string, std::map<std::string, double>>{
                {"GENERATE_SEARCH_PATH",
                 {{"SPIRAL_HIGH", 100}, {"SPIRAL_MEDIUM", 50}, {"SPIRAL_LOW", 25}}},
                {"FOLLOW_PIPELINE", {{"FOLLOW_PIPELINE", 100}}},
                {"MAINTAIN_MOTION", {{"ALL_THRUSTERS", 100}, {"RECOVER_THRUSTERS", 75}}}}));
  EXPECT_EQ(system.requires_of.at("ALL_THRUSTERS").size(), 6U);
  EXPECT_TRUE(system.requires_of.at("RECOVER_THRUSTERS").empty());
}

TEST(Px4, HasTheModesAndTheirRequirements) {
  const System system("px4.yaml");
  ASSERT_EQ(system.exclusivity.size(), 1U);
  Names modes = system.exclusivity[0];
  EXPECT_EQ(modes.erase("FAILSAFE"), 1U);
  EXPECT_EQ(modes.size(), 21U);
  Names requirements;
  std::size_t pairs = 0;
  for (const std::string& mode : modes) {
    ASSERT_EQ(system.behaviors_of(mode), std::vector<std::string>{mode});
    // Two of the requirements are situations, in which the mode fits.
    Names required = system.requires_of.at(mode);
    if (const auto found = system.conditions_of.find(mode); found != system.conditions_of.end()) {
      required.insert(found->second.begin(), found->second.end());
    }
    requirements.insert(required.begin(), required.end());
    pairs += required.size();
  }
  EXPECT_TRUE(requirements.contains("ARMED") && requirements.contains("MANUAL_CONTROL"));
  EXPECT_EQ(pairs, 87U);
  EXPECT_EQ(requirements.size(), 12U);
}

TEST(Px4, HasAFailsafeThatFallsStepByStep) {
  const System system("px4.yaml");
  const nlohmann::json& failsafe = system.tasks.at("FAILSAFE");
  EXPECT_TRUE(failsafe["reactive_start"]);
  std::vector<std::pair<double, std::string>> steps;
  for (const nlohmann::json& entry : failsafe["behaviors"]) {
    steps.emplace_back(-entry["suitability"].get<double>(), entry["behavior"]);
  }
  std::sort(steps.begin(), steps.end());
  std::vector<std::string> names;
  names.reserve(steps.size());
  for (const auto& [suitability, name] : steps) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"AUTO_RTL", "AUTO_LAND", "DESCEND", "TERMINATION"}));
}

/// A line of autoware.tsv.
struct Unit {
  std::string name;
  std::string gate;
  std::vector<std::string> inputs;
};

std::vector<Unit> units_of_autoware() {
  std::ifstream file(std::string(System::folder) + "/autoware.tsv");
  std::vector<Unit> units;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("unit\t")) continue;
    std::istringstream words(line);
    Unit& unit = units.emplace_back();
    words >> unit.name >> unit.gate;
    for (std::string input; words >> input;) unit.inputs.push_back(input);
  }
  return units;
}

TEST(Autoware, HasTheUnitsTheDiagnosticsAndTheModes) {
  const System system("autoware.yaml");
  Names units;
  Names modes;
  Names diagnostics;
  for (const auto& [name, task] : system.tasks) {
    if (name.find('#') == std::string::npos) units.insert(name);
    if (task["start_on_request"]) modes.insert(name);
    for (const std::string& behavior : system.behaviors_of(name)) {
      if (system.requires_of.at(behavior).empty()) diagnostics.insert(behavior);
    }
  }
  EXPECT_EQ(units.size(), 59U);
  EXPECT_EQ(diagnostics.size(), 40U);
  EXPECT_EQ(modes.size(), 7U);
  for (const std::string& mode : modes) EXPECT_TRUE(mode.starts_with("/autoware/modes/")) << mode;
}

TEST(Autoware, HasTheGatesOfItsUnits) {
  const System system("autoware.yaml");
  const std::vector<Unit> units = units_of_autoware();
  ASSERT_EQ(system.tasks.size(), units.size());
  for (const Unit& unit : units) {
    std::vector<Names> required;
    for (const std::string& behavior : system.behaviors_of(unit.name)) {
      required.push_back(system.requires_of.at(behavior));
    }
    std::vector<Names> expected;
    if (unit.gate == "or") {
      for (const std::string& input : unit.inputs) expected.push_back({input});
    } else if (unit.gate == "and") {
      expected = {Names(unit.inputs.begin(), unit.inputs.end())};
    } else {
      expected = {{}};
      EXPECT_EQ(unit.inputs.front(), "diag:" + system.behaviors_of(unit.name).front());
    }
    EXPECT_EQ(required, expected) << unit.name;
  }
}

/// Sets of diagnostics; none of them contains another one.
using CutSets = std::set<Names>;

CutSets minimal(const CutSets& sets) {
  CutSets result;
  for (const Names& set : sets) {
    const bool has_smaller = std::any_of(sets.begin(), sets.end(), [&](const Names& other) {
      return other != set && std::includes(set.begin(), set.end(), other.begin(), other.end());
    });
    if (!has_smaller) result.insert(set);
  }
  return result;
}

/// The smallest sets of diagnostics that end a task if they fail: all of its behaviors have to
/// fail, and a behavior fails with any of the tasks that it requires.
CutSets cut_sets(const System& system, const std::string& task) {
  CutSets of_task{{}};
  for (const std::string& behavior : system.behaviors_of(task)) {
    CutSets of_behavior;
    for (const std::string& required : system.requires_of.at(behavior)) {
      of_behavior.merge(cut_sets(system, required));
    }
    if (system.requires_of.at(behavior).empty()) of_behavior.insert({behavior});
    CutSets joined;
    for (const Names& before : of_task) {
      for (Names set : of_behavior) {
        set.insert(before.begin(), before.end());
        joined.insert(set);
      }
    }
    of_task = minimal(joined);
  }
  return of_task;
}

/// The numbers are those of a program for fault trees, SCRAM 0.16.2, with the structure of the
/// source.
TEST(Autoware, HasTheCutSetsOfItsSource) {
  const System system("autoware.yaml");
  const std::map<std::string, std::pair<std::size_t, std::size_t>> known = {
      {"autonomous", {34, 2}}, {"comfortable_stop", {33, 2}},
      {"pull_over", {33, 2}},  {"emergency_stop", {4, 1}},
      {"local", {7, 1}},       {"remote", {7, 1}},
      {"stop", {1, 0}},
  };
  for (const auto& [mode, numbers] : known) {
    std::size_t singles = 0;
    std::size_t pairs = 0;
    const CutSets sets = cut_sets(system, "/autoware/modes/" + mode);
    for (const Names& set : sets) {
      singles += set.size() == 1;
      pairs += set.size() == 2;
    }
    EXPECT_EQ(singles, numbers.first) << mode;
    EXPECT_EQ(pairs, numbers.second) << mode;
    EXPECT_EQ(sets.size(), singles + pairs) << mode;
  }
}

}  // namespace
}  // namespace cbc::golden::published_systems_test
