#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "diagnostic/rules.h"
#include "report/lint_report.h"

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
