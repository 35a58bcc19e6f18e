// What `cbc lint` says about catalogs published with the original tool, if they are at hand.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

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

/// "LINE RULE" of all findings of a severity.
std::set<std::string> places_of(const Json& report, const std::string& severity) {
  std::set<std::string> places;
  for (const Json& diagnostic : report["files"][0]["diagnostics"]) {
    if (diagnostic["severity"] == severity) {
      places.insert(diagnostic["line"].dump() + " " + diagnostic["rule"].get<std::string>());
    }
  }
  return places;
}

std::string message_at(const Json& report, std::uint64_t line, const std::string& rule) {
  for (const Json& diagnostic : report["files"][0]["diagnostics"]) {
    if (diagnostic["line"] == line && diagnostic["rule"] == rule) return diagnostic["message"];
  }
  return "no finding";
}

class PublishedLint : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(test::shared_catalogs())) GTEST_SKIP() << "no " << test::shared_catalogs();
  }

  static Json lint_shared(const std::string& name) { return lint(test::shared_catalogs() / name); }
};

TEST_F(PublishedLint, FindsTheKeyOnTheWrongLevel) {
  const Json report = lint_shared("behavior_catalog.yaml");
  EXPECT_EQ(places_of(report, "error"), std::set<std::string>());
  // HOVER starts neither by itself nor because it is required.
  EXPECT_EQ(places_of(report, "warning"),
            (std::set<std::string>{"212 never-started", "294 unknown-key"}));
  EXPECT_NE(message_at(report, 294, "unknown-key").find("'allowed_values'"), std::string::npos);
}

TEST_F(PublishedLint, CountsWhatACatalogHas) {
  const Json report = lint_shared("behavior_catalog.yaml");
  const Json summary = report["files"][0]["summary"];
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary["tasks"], 21);
  EXPECT_EQ(summary["behaviors"], 26);
  EXPECT_EQ(summary["constraints"]["exclusive_pairs"], 17);
  EXPECT_EQ(summary["constraints"]["requirements"], 16);
  EXPECT_EQ(summary["constraints"]["task_minimums"], 0);
  EXPECT_EQ(summary["constraints"]["total"], 33);
  EXPECT_EQ(summary["groups"].size(), 9U);

  // The search space anew, from the lines of the file: "  task: NAME" belongs to a behavior.
  std::map<std::string, std::uint64_t> behaviors_of;
  std::uint64_t behaviors = 0;
  std::ifstream file(test::shared_catalogs() / "behavior_catalog.yaml");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("- behavior: ", 0) == 0) ++behaviors;
    if (line.rfind("  task: ", 0) == 0)
      ++behaviors_of[line.substr(8, line.find_last_not_of(" \r") - 7)];
  }
  EXPECT_EQ(behaviors, 26U);
  std::uint64_t space = 1;
  for (const auto& [task, count] : behaviors_of) space *= 1 + count;
  EXPECT_EQ(summary["search_space"], std::to_string(space));
}

TEST_F(PublishedLint, FindsTheRequirementThatExcludesItsOwnTask) {
  const Json report = lint_shared("behavior_catalog_impossible.yaml");
  EXPECT_EQ(places_of(report, "error"), std::set<std::string>{"147 exclusive-requirement"});
}

TEST_F(PublishedLint, FindsTheMissingTaskAndSuggestsTheOneThatIsMeant) {
  const Json report = lint_shared("behavior_catalog_missing_task.yaml");
  EXPECT_EQ(places_of(report, "error"), std::set<std::string>{"111 undefined-task"});
  EXPECT_NE(message_at(report, 111, "undefined-task").find("did you mean 'SELF_LOCALIZE'?"),
            std::string::npos);
}

TEST_F(PublishedLint, DoesNotStopAtTheFirstMistake) {
  const Json report = lint_shared("bad_behavior_catalog.yaml");
  EXPECT_EQ(places_of(report, "error"), std::set<std::string>{"65 missing-key"});
  EXPECT_EQ(places_of(report, "warning").count("288 unknown-key"), 1U);
  EXPECT_NE(message_at(report, 288, "unknown-key").find("'allowed_values'"), std::string::npos);
}

// Fixes ---------------------------------------------------------------------------------------

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
  if (json.is_object()) json.erase("line");
  for (Json& part : json) {
    if (part.is_structured()) remove_lines(part);
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
