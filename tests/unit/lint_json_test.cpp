#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic/rules.h"
#include "lint/report/lint_report.h"

namespace cbc::lint_json_test {
namespace {

using Json = nlohmann::ordered_json;

CatalogSummary example_summary() {
  CatalogSummary summary;
  summary.total.tasks = 4;
  summary.total.behaviors = 5;
  summary.total.constraints = {3, 2, 1};
  summary.groups.resize(2);
  summary.groups[0].task_names = {"HOVER", "LAND", "LOCALIZE"};
  summary.groups[0].constraints = {3, 2, 1};
  summary.groups[1].task_names = {"BLINK"};
  summary.total.search_space = "123456789012345678901234567890";
  return summary;
}

TEST(LintJson, WritesAllMembersInTheirOrder) {
  const std::vector<LintedFile> files = {
      {"a.yaml",
       "",
       {{rule::requirement_cycle,
         Severity::error,
         "a.yaml",
         {{12, 5}, {13, 20}},
         "cycle",
         {{"b.yaml", {{30, 6}, {30, 7}}, "here"}}},
        {rule::dead_task, Severity::warning, "a.yaml", {{14, 1}, {14, 2}}, "dead", {}}},
       {}},
      {"b.yaml", "", {}, example_summary()}};
  EXPECT_EQ(lint_json(files),
            R"({"schema":"cbc.lint/1","files":[
{"file":"a.yaml","diagnostics":[
{"rule":"requirement-cycle","severity":"error","message":"cycle","line":12,"column":5,"end_line":13,"end_column":20,"related":[{"file":"b.yaml","line":30,"column":6,"message":"here"}]},
{"rule":"dead-task","severity":"warning","message":"dead","line":14,"column":1,"end_line":14,"end_column":2,"related":[]}],"summary":null},
{"file":"b.yaml","diagnostics":[],"summary":{"tasks":4,"behaviors":5,"constraints":{"exclusive_pairs":3,"requirements":2,"task_minimums":1,"total":6},"groups":[{"tasks":["HOVER","LAND","LOCALIZE"],"constraints":6},{"tasks":["BLINK"],"constraints":0}],"search_space":"123456789012345678901234567890"}}],
"errors":1,"warnings":1,"notes":0}
)");
}

TEST(LintJson, CountsFindingsOfAllFiles) {
  const auto finding = [](Severity severity) {
    return Diagnostic{rule::dead_task, severity, "a", {}, "m", {}};
  };
  const std::vector<LintedFile> files = {
      {"a", "", {finding(Severity::note), finding(Severity::error), finding(Severity::note)}, {}},
      {"b",
       "",
       {finding(Severity::note), finding(Severity::warning), finding(Severity::error)},
       {}}};
  const Json json = Json::parse(lint_json(files));
  EXPECT_EQ(json["errors"], 2);
  EXPECT_EQ(json["warnings"], 1);
  EXPECT_EQ(json["notes"], 3);
}

TEST(LintJson, IsValidForNoFileAndForEmptyCatalogs) {
  EXPECT_EQ(Json::parse(lint_json({})), Json::parse(R"({"schema": "cbc.lint/1", "files": [],
                            "errors": 0, "warnings": 0, "notes": 0})"));
  CatalogSummary summary;
  summary.total.search_space = "1";
  const Json json = Json::parse(lint_json({{"a.yaml", "", {}, summary}}));
  EXPECT_EQ(json["files"][0]["summary"]["groups"], Json::array());
  EXPECT_EQ(json["files"][0]["summary"]["search_space"], "1");
}

TEST(LintJson, GivesHostileNamesBack) {
  const std::string name = "\"a\\\n%,:\x1b'é日.yaml";
  CatalogSummary summary = example_summary();
  summary.groups[0].task_names[0] = name;
  const Json json = Json::parse(lint_json(
      {{name,
        "",
        {{rule::dead_task, Severity::warning, name, {}, "message of " + name, {{name, {}, name}}}},
        summary}}));
  const Json& file = json["files"][0];
  EXPECT_EQ(file["file"], name);
  EXPECT_EQ(file["diagnostics"][0]["message"], "message of " + name);
  EXPECT_EQ(file["diagnostics"][0]["related"][0]["file"], name);
  EXPECT_EQ(file["diagnostics"][0]["related"][0]["message"], name);
  EXPECT_EQ(file["summary"]["groups"][0]["tasks"][0], name);
}

TEST(LintJson, ReplacesInvalidBytes) {
  const Json json = Json::parse(
      lint_json({{"a\xff.yaml",
                  "",
                  {{rule::dead_task, Severity::warning, "a\xff.yaml", {}, "cut \xe6\x97", {}}},
                  {}}}));
  EXPECT_EQ(json["files"][0]["file"], "a\xEF\xBF\xBD.yaml");
  EXPECT_EQ(json["files"][0]["diagnostics"][0]["message"], "cut \xEF\xBF\xBD");
}

}  // namespace
}  // namespace cbc::lint_json_test
