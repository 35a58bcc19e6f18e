// The catalogs of catalogs/ that are taken from real systems have what their sources have.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"

namespace cbc::golden {
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
  std::map<std::string, Names> requires_of;  ///< of each behavior
  std::vector<Names> exclusivity;
};

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
    const Names& required = system.requires_of.at(mode);
    requirements.insert(required.begin(), required.end());
    pairs += required.size();
  }
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
  for (const auto& [suitability, name] : steps) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"AUTO_RTL", "AUTO_LAND", "DESCEND", "TERMINATION"}));
}

}  // namespace
}  // namespace cbc::golden
