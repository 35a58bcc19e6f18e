#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compile/catalog_dump.h"
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

}  // namespace
}  // namespace cbc::catalog_json_test
