#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compile/catalog_dump.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "support/read_file.h"
#include "unit/compiled_bytes.h"
#include "unit/compiled_fixture.h"

namespace cbc::catalog_json_test {
namespace {

using Json = nlohmann::ordered_json;

/// The report without its line breaks.
std::string report(CompiledCatalog catalog) {
  std::string text;
  for (const char character : catalog_json(test::compiled_file(std::move(catalog)))) {
    if (character != '\n') text += character;
  }
  return text;
}

constexpr const char* head =
    R"({"schema":"cbc.catalog/1","format":7,"written_by":"1.2.3",)"
    R"("source":{"file":"robot.yaml","digest":"abababababababababababababababab"},)"
    R"("content_digest":"01010101010101010101010101010101","size":4321,)";

TEST(CatalogJson, HasTheKeysOfTheSchema) {
  EXPECT_EQ(report(test::compile_text(R"(
behaviors:
- {behavior: PID, task: HOVER, suitability: 70, timeout: 2.5}
- behavior: MPC
  package: control
  task: HOVER
  suitability: 99.5
  requires:
  - {task: LOCALIZE, minimum_performance: 80.25}
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: HOVER
  timeout: 12
  parameters:
  - {parameter: way, allowed_values: [UP, DOWN]}
  - {parameter: height, allowed_values: number}
  - {parameter: why}
- task: LOCALIZE
  start_on_request: false
  reactive_start: true
  execution_goal: keep_running
  minimum_performance: 50
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [LAND, HOVER]
)")),
            std::string(head) +
                R"("tasks":3,"behaviors":3,"levels":2,)"
                R"("constraints":{"exclusive_pairs":1,"requirements":1,"task_minimums":1,)"
                R"("total":3},"search_space":"6","variables":[],)"
                R"("groups":[{"group":0,"levels":2,)"
                R"("constraints":{"exclusive_pairs":1,"requirements":1,"task_minimums":1,)"
                R"("total":3},"search_space":"6","tasks":[)"
                R"({"task":"HOVER","level":1,"execution_goal":"achieve_goal",)"
                R"("start_on_request":true,"reactive_start":false,"timeout":12,)"
                R"("minimum_performance":null,"line":null,"parameters":[)"
                R"({"parameter":"way","allowed_values":["UP","DOWN"]},)"
                R"({"parameter":"height","allowed_values":"number"},)"
                R"({"parameter":"why","allowed_values":null}],)"
                R"("behaviors":[{"behavior":"MPC","suitability":99.5},)"
                R"({"behavior":"PID","suitability":70}]},)"
                R"({"task":"LOCALIZE","level":0,"execution_goal":"keep_running",)"
                R"("start_on_request":false,"reactive_start":true,"timeout":null,)"
                R"("minimum_performance":50,"line":22,"parameters":[],)"
                R"("behaviors":[{"behavior":"GPS","suitability":100}]},)"
                R"({"task":"LAND","level":0,"execution_goal":"achieve_goal",)"
                R"("start_on_request":true,"reactive_start":false,"timeout":null,)"
                R"("minimum_performance":null,"line":null,"parameters":[],"behaviors":[]}],)"
                R"("behaviors":[{"behavior":"PID","level":0,"package":"","timeout":2.5,)"
                R"("situation":{},)"
                R"("requires":[]},{"behavior":"MPC","level":1,"package":"control",)"
                R"("timeout":null,"situation":{},"requires":[{"task":"LOCALIZE",)"
                R"("minimum_performance":80.25,"line":9}]},)"
                R"({"behavior":"GPS","level":0,"package":"","timeout":null,)"
                R"("situation":{},"requires":[]}],)"
                R"("exclusivity":[{"tasks":["HOVER","LAND"],"line":25}]}]})");
}

TEST(CatalogJson, HasSituationVariablesAndConditions) {
  const Json dump = Json::parse(report(test::compile_text(R"(
situation:
- {variable: TARGET, values: [far, near, lost]}
- {variable: GPS}
behaviors:
- {behavior: SEE, task: LOOK, situation: {GPS: false, TARGET: [near, far]}}
)")));
  EXPECT_EQ(dump["variables"], Json::parse(R"([
    {"variable": "TARGET", "values": ["far", "near", "lost"]},
    {"variable": "GPS", "values": [true, false]}])"));
  EXPECT_EQ(dump["groups"][0]["behaviors"][0]["situation"],
            Json::parse(R"({"TARGET": ["far", "near"], "GPS": [false]})"));
}

TEST(CatalogJson, ReportsAnEmptyCatalog) {
  EXPECT_EQ(report(test::compile_text("behaviors: []")),
            std::string(head) +
                R"("tasks":0,"behaviors":0,"levels":0,)"
                R"("constraints":{"exclusive_pairs":0,"requirements":0,"task_minimums":0,)"
                R"("total":0},"search_space":"1","variables":[],"groups":[]})");
}

/// All that the catalog says, found in the report, by name.
class PublishedCatalog : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::string path = CBC_SOURCE_DIR "/catalogs/" + std::string(GetParam()) + ".yaml";
    Diagnostics diagnostics;
    std::optional<Catalog> read = read_catalog(test::read_file(path), path, diagnostics);
    ASSERT_TRUE(read);
    catalog = std::move(*read);
    json = Json::parse(report(compile(catalog)));
  }

  /// The entries of one list of all groups, by name.
  [[nodiscard]] std::map<std::string, Json> entries(const char* list, const char* name) const {
    std::map<std::string, Json> found;
    for (const Json& group : json["groups"]) {
      for (const Json& entry : group[list]) {
        EXPECT_TRUE(found.emplace(entry[name].get<std::string>(), entry).second) << entry;
      }
    }
    return found;
  }

  Catalog catalog;
  Json json;
};

TEST_P(PublishedCatalog, IsListedWithAllItsTasks) {
  std::map<std::string, Json> tasks = entries("tasks", "task");
  ASSERT_EQ(tasks.size(), catalog.tasks.size());
  for (const Task& task : catalog.tasks) {
    const Json& entry = tasks[task.name];
    ASSERT_TRUE(entry.is_object()) << task.name;
    EXPECT_EQ(entry["start_on_request"], task.start_on_request) << task.name;
    EXPECT_EQ(entry["reactive_start"], task.reactive_start) << task.name;
    EXPECT_EQ(entry["execution_goal"] == "keep_running",
              task.execution_goal == ExecutionGoal::keep_running);
    EXPECT_EQ(entry["parameters"].size(), task.parameters.size());
    EXPECT_EQ(entry["timeout"].is_null(), !task.timeout);
    if (task.timeout) {
      EXPECT_EQ(entry["timeout"].get<double>() * 1e6, static_cast<double>(*task.timeout));
    }
  }
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      double suitability = -1;
      for (const Json& entry : tasks[catalog.tasks[performance.task].name]["behaviors"]) {
        if (entry["behavior"] == behavior.name) suitability = entry["suitability"];
      }
      EXPECT_EQ(suitability * 10'000, performance.suitability) << behavior.name;
    }
  }
}

TEST_P(PublishedCatalog, IsListedWithAllThatBehaviorsRequire) {
  std::map<std::string, Json> behaviors = entries("behaviors", "behavior");
  ASSERT_EQ(behaviors.size(), catalog.behaviors.size());
  for (const Behavior& behavior : catalog.behaviors) {
    std::set<std::string> required;
    std::set<std::string> listed;
    for (const Requirement& requirement : behavior.requirements) {
      required.insert(catalog.tasks[requirement.task].name);
    }
    for (const Json& entry : behaviors[behavior.name]["requires"]) listed.insert(entry["task"]);
    EXPECT_EQ(listed, required) << behavior.name;
    EXPECT_EQ(behaviors[behavior.name]["package"], behavior.package);
  }
}

TEST_P(PublishedCatalog, IsListedWithAllThatIsExclusive) {
  std::set<std::set<std::string>> required;
  for (const ExclusivityList& list : catalog.exclusivity) {
    std::set<std::string> names;
    for (const TaskIndex task : list.tasks) names.insert(catalog.tasks[task].name);
    if (names.size() > 1) required.insert(std::move(names));
  }
  std::set<std::set<std::string>> listed;
  for (const Json& group : json["groups"]) {
    for (const Json& list : group["exclusivity"]) listed.insert(list["tasks"]);
  }
  EXPECT_FALSE(required.empty());
  EXPECT_EQ(listed, required);
}

TEST_P(PublishedCatalog, HasNumbersThatAddUp) {
  Json sum{{"exclusive_pairs", 0}, {"requirements", 0}, {"task_minimums", 0}, {"total", 0}};
  std::uint64_t space = 1;
  std::uint64_t levels = 0;
  for (const Json& group : json["groups"]) {
    for (const auto& [key, value] : sum.items()) {
      value = value.get<std::uint64_t>() + group["constraints"][key].get<std::uint64_t>();
    }
    std::uint64_t group_space = 1;
    for (const Json& task : group["tasks"]) {
      group_space *= 1 + task["behaviors"].size();
      EXPECT_LT(task["level"], group["levels"]);
      levels = std::max<std::uint64_t>(levels, task["level"].get<std::uint64_t>() + 1);
    }
    EXPECT_EQ(group["search_space"], std::to_string(group_space));
    space *= group_space;
  }
  EXPECT_EQ(json["constraints"], sum);
  EXPECT_EQ(json["search_space"], std::to_string(space));
  EXPECT_EQ(json["levels"], levels);
  EXPECT_EQ(json["tasks"], catalog.tasks.size());
  EXPECT_EQ(json["behaviors"], catalog.behaviors.size());
}

INSTANTIATE_TEST_SUITE_P(Catalogs, PublishedCatalog,
                         testing::Values("quadrotor", "target-following"), [](const auto& tested) {
                           const std::string name = tested.param;
                           return name.substr(0, name.find('-'));
                         });

}  // namespace
}  // namespace cbc::catalog_json_test
