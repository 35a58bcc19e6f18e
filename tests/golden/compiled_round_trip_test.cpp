// Every catalog that is at hand, compiled: the answers are those of the YAML, byte for byte.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"
#include "support/shared_folder.h"

namespace cbc::golden::compiled_round_trip_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<std::string> find_catalogs() {
  std::vector<std::string> catalogs;
  for (const fs::path& folder : {fs::path(CBC_SOURCE_DIR "/catalogs"), test::shared_catalogs()}) {
    for (const fs::path& file : test::catalog_files(folder)) catalogs.push_back(file.string());
  }
  return catalogs;
}

/// Starts every task in turn, and then stops each: many are rejected, and say why.
std::string script_of(const Json& summary, const std::set<std::string>& unrequestable) {
  std::string script;
  for (const std::string verb : {"start", "stop"}) {
    for (const Json& group : summary["groups"]) {
      for (const Json& task : group["tasks"]) {
        if (verb == "start" && unrequestable.contains(task)) continue;
        script += "- {" + verb + ": " + task.dump() + "}\n";
      }
    }
  }
  return script;
}

/// In two folders a file catalog.yaml: the YAML in one, its compiled form in the other.
class RoundTrip : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    yaml.write("catalog.yaml", test::read_file(GetParam()));
    const Result result =
        run({{"compile", "catalog.yaml", "-o", compiled / "catalog.yaml"}, yaml.path()});
    is_good = result.status == 0;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(is_good || result.status == 2) << result.status;
  }

  [[nodiscard]] static Json summary_in(const test::ScratchFolder& folder) {
    const Result result =
        run({{"lint", "--summary", "--format", "json", "catalog.yaml"}, folder.path()});
    return Json::parse(result.out)["files"][0]["summary"];
  }

  [[nodiscard]] std::set<std::string> unrequestable() const {
    std::set<std::string> tasks;
    const Result dump = run({{"compile", "--dump", "catalog.yaml"}, compiled.path()});
    const Json content = Json::parse(dump.out);
    for (const Json& group : content["groups"]) {
      for (const Json& task : group["tasks"]) {
        if (task.contains("requestable")) tasks.insert(task["task"]);
      }
    }
    return tasks;
  }

  void write_script(const std::string& name, const std::string& text) const {
    yaml.write(name, text);
    compiled.write(name, text);
  }

  /// Runs the program in both folders.
  void expect_same(const std::vector<std::string>& arguments) const {
    const Result expected = run({arguments, yaml.path()});
    const Result result = run({arguments, compiled.path()});
    EXPECT_EQ(result.status, expected.status);
    EXPECT_TRUE(result.out == expected.out) << result.out << "\ninstead of\n" << expected.out;
    EXPECT_GT(result.out.size(), 100U);
  }

  test::ScratchFolder yaml;
  test::ScratchFolder compiled;
  bool is_good = false;
};

/// A catalog that solve refuses is not compiled, and the other way round.
TEST_P(RoundTrip, IsCompiledIfItCanBeSolved) {
  yaml.write("script.yaml", "- situation: {}\n");
  EXPECT_EQ(run({{"solve", "catalog.yaml", "script.yaml"}, yaml.path()}).status, is_good ? 0 : 2);
  EXPECT_EQ(fs::exists(compiled / "catalog.yaml"), is_good);
}

TEST_P(RoundTrip, GivesTheSameAnswers) {
  if (!is_good) return;
  write_script("script.yaml", script_of(summary_in(yaml), unrequestable()));
  for (const char* format : {"text", "json"}) {
    expect_same({"solve", "catalog.yaml", "script.yaml", "--format", format});
    expect_same({"solve", "catalog.yaml", "script.yaml", "--format", format});
  }
}

TEST_P(RoundTrip, GivesTheSameMission) {
  const fs::path mission = fs::path(GetParam()).replace_extension(".mission.yaml");
  if (!is_good || !fs::exists(mission)) return;
  write_script("mission.yaml", test::read_file(mission));
  for (const char* format : {"text", "json"}) {
    expect_same({"solve", "catalog.yaml", "mission.yaml", "--format", format});
  }
}

/// The findings are those of the text, which a compiled catalog has not.
TEST_P(RoundTrip, GivesTheSameSummary) {
  if (!is_good) return;
  EXPECT_EQ(summary_in(compiled), summary_in(yaml));
  const std::string end = "search space";
  const std::vector<std::string> arguments{"lint", "--summary", "catalog.yaml"};
  const std::string expected = run({arguments, yaml.path()}).out;
  const std::size_t size = expected.find('\n', expected.find(end));
  ASSERT_NE(size, std::string::npos);
  EXPECT_EQ(run({arguments, compiled.path()}).out.substr(0, size), expected.substr(0, size));
}

TEST_P(RoundTrip, IsUpToDate) {
  if (!is_good) return;
  const Result result =
      run({{"compile", "--check", "catalog.yaml", "-o", compiled / "catalog.yaml"}, yaml.path()});
  EXPECT_EQ(result.status, 0) << result.out;
}

INSTANTIATE_TEST_SUITE_P(Catalogs, RoundTrip, testing::ValuesIn(find_catalogs()),
                         [](const auto& tested) {
                           std::string name = fs::path(tested.param).stem().string();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RoundTrips, CoverTheSharedCatalogs) {
  if (!fs::exists(test::shared_catalogs())) GTEST_SKIP() << "no " << test::shared_catalogs();
  EXPECT_GE(find_catalogs().size(), 10U);
}

}  // namespace
}  // namespace cbc::golden::compiled_round_trip_test
