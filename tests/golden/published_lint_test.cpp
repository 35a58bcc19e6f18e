// What `cbc lint --fix` makes of catalogs published with the original tool, if they are at hand.
#include <cstddef>
#include <filesystem>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/json_relations.h"
#include "golden/process.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"
#include "support/shared_folder.h"

namespace cbc::golden::published_lint_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What lint reports of one file, as JSON.
Json lint(const fs::path& file) {
  const Result result =
      run({{"lint", "--format", "json", file.filename().string()}, file.parent_path()});
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(find_contradictions(result.out), std::vector<std::string>());
  Json report = Json::parse(result.out);
  EXPECT_EQ(result.status, report["errors"] == 0 ? 0 : 1);
  return report;
}

/// Starts every task in turn; nothing is stopped, so that each start finds others running.
std::string script_of(const Json& summary) {
  std::string script;
  int time = 0;
  for (const Json& group : summary["groups"]) {
    for (const Json& task : group["tasks"]) {
      script += "- {start: " + task.get<std::string>() + ", at: " + std::to_string(++time) + "}\n";
    }
  }
  return script;
}

/// Without the lines of the catalog, which may have moved.
void remove_lines(Json& json) {
  static const std::regex place(R"re(catalog\.yaml:\d+)re");
  if (json.is_object()) json.erase("line");
  for (Json& part : json) {
    if (part.is_structured()) remove_lines(part);
    if (part.is_string()) {
      part = std::regex_replace(part.get<std::string>(), place, "catalog.yaml");
    }
  }
}

/// What the solver makes of a script on a catalog.
Json solve(const test::ScratchFolder& folder) {
  const Result result =
      run({{"solve", "catalog.yaml", "script.yaml", "--format", "json"}, folder.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  Json report = Json::parse(result.out);
  remove_lines(report);
  return report;
}

class PublishedFix : public testing::TestWithParam<const char*> {};

TEST_P(PublishedFix, LeavesEveryAnswerAsItIs) {
  const fs::path file = test::shared_catalogs() / (std::string(GetParam()) + ".yaml");
  if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
  const test::ScratchFolder folder;
  folder.write("catalog.yaml", test::read_file(file));
  const Json summary = lint(folder / "catalog.yaml")["files"][0]["summary"];
  ASSERT_TRUE(summary.is_object());
  folder.write("script.yaml", script_of(summary));
  const Json before = solve(folder);
  ASSERT_EQ(before["runs"][0]["expectations"]["failed"], 0);
  ASSERT_GE(before["runs"][0]["events"].size(), summary["tasks"].get<std::size_t>());

  const Result fixed = run({{"lint", "--fix", "catalog.yaml"}, folder.path()});
  EXPECT_EQ(fixed.status, 0) << fixed.err;
  EXPECT_EQ(fixed.err.find("error"), std::string::npos) << fixed.err;
  const Json left = lint(folder / "catalog.yaml");
  for (const Json& diagnostic : left["files"][0]["diagnostics"]) {
    EXPECT_NE(diagnostic["rule"], "deprecated-key") << diagnostic;
  }
  EXPECT_EQ(left["files"][0]["summary"]["search_space"], summary["search_space"]);
  EXPECT_EQ(solve(folder), before);
}

INSTANTIATE_TEST_SUITE_P(Catalogs, PublishedFix,
                         testing::Values("aerostack_mission_behavior_catalog_v4",
                                         "behavior_catalog", "creator32230", "creator43232",
                                         "creator63233", "creator63333", "creator93233",
                                         "creator93333"),
                         [](const auto& catalog) { return std::string(catalog.param); });

}  // namespace
}  // namespace cbc::golden::published_lint_test
