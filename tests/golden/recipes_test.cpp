// docs/recipes.md shows the files of docs/recipes as they are, and these keep what the page
// promises. What its commands print is compared in program_test.cpp.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/catalog_files.h"
#include "support/read_file.h"

namespace cbc::golden::recipes_test {
namespace {

namespace fs = std::filesystem;

const std::string folder = "docs/recipes";

std::vector<std::string> names_of_recipes() {
  std::vector<std::string> names;
  for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/" + folder)) {
    names.push_back(file.stem());
  }
  return names;
}

TEST(Recipes, AreOnThePage) {
  const std::string page = test::read_file(CBC_SOURCE_DIR "/docs/recipes.md");
  for (const auto& entry : fs::directory_iterator(CBC_SOURCE_DIR "/" + folder)) {
    const std::string name = entry.path().filename();
    const std::string shown =
        "](recipes/" + name + "):\n\n```yaml\n" + test::read_file(entry.path()) + "```\n";
    EXPECT_NE(page.find(shown), std::string::npos) << "not shown as it is: " << name;
  }
}

TEST(Recipes, HaveNoFindings) {
  const Result result = run({{"lint", "--strict", folder}, CBC_SOURCE_DIR});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.out.starts_with("no findings in ")) << result.out;
}

TEST(Recipes, MeetTheirExpectations) {
  const Result result = run({{"solve", folder, "--format", "json"}, CBC_SOURCE_DIR});
  EXPECT_EQ(result.status, 0) << result.out;
  const nlohmann::json report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["runs"].size(), names_of_recipes().size());
  for (const nlohmann::json& run : report["runs"]) {
    EXPECT_GT(run["expectations"]["passed"], 0) << run["script"];
  }
}

TEST(Recipes, KeepTheirPromises) {
  std::size_t count = 0;
  for (const std::string& name : names_of_recipes()) {
    const std::string properties = folder + "/" + name + ".properties.yaml";
    if (!fs::exists(fs::path(CBC_SOURCE_DIR) / properties)) continue;
    const Result result = run({{"verify", properties}, CBC_SOURCE_DIR});
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    ++count;
  }
  EXPECT_GE(count, 9U);
}

/// Whatever line of a catalog is lost, an expectation fails.
TEST(Recipes, NoticeEveryChange) {
  for (const std::string& name : names_of_recipes()) {
    const std::string file = folder + "/" + name;
    const Result result = run(
        {{"coverage", file + ".yaml", file + ".mission.yaml", "--mutants", "--fail-under", "100"},
         CBC_SOURCE_DIR});
    EXPECT_EQ(result.status, 0) << result.out << result.err;
  }
}

}  // namespace
}  // namespace cbc::golden::recipes_test
