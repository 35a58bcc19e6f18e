// `cbc verify` from outside: the files that it writes, what must not depend on the machine, and the
// properties of the published catalogs.
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/catalog_files.h"
#include "support/scratch_folder.h"

namespace cbc::golden::verify_test {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

class Verify : public testing::Test {
 protected:
  static Result verify(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "verify");
    return run({arguments, CBC_SOURCE_DIR});
  }

  const std::string catalog = "tests/golden/shared/verify_groups/catalog.yaml";
  const std::string properties = "tests/golden/shared/verify_properties/robot.properties.yaml";
  test::ScratchFolder scratch;
};

TEST_F(Verify, WritesScriptsThatSolveRepeats) {
  const std::string folder = scratch / "new/scripts";
  const Result result = verify({properties, "--scripts", folder});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "");
  Names names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
    const Result solved = run({{"solve", catalog, entry.path().string()}, CBC_SOURCE_DIR});
    EXPECT_EQ(solved.status, 0) << solved.out << solved.err;
    EXPECT_NE(solved.out.find("expectations: 1 passed, 0 failed"), std::string::npos);
  }
  EXPECT_EQ(names,
            (Names{"robot.13.mission.yaml", "robot.14.mission.yaml", "robot.16.mission.yaml",
                   "robot.18.mission.yaml", "robot.5.mission.yaml", "robot.9.mission.yaml"}));
  EXPECT_NE(result.out.find("violated after 2 events; see " + folder + "/robot.5.mission.yaml\n"),
            std::string::npos);
}

TEST_F(Verify, WritesTheScriptsOfOutcomes) {
  const std::string cart = "tests/golden/shared/verify_outcomes/cart.properties.yaml";
  const Result result = verify({cart, "--outcomes", "--scripts", scratch.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  const nlohmann::json report =
      nlohmann::json::parse(verify({cart, "--outcomes", "--format", "json"}).out);
  std::size_t outcomes = 0;
  for (const auto& group : report["groups"]) {
    for (const auto& outcome : group["outcomes"]) {
      const std::string name = "cart.outcome-" + std::to_string(++outcomes) + ".mission.yaml";
      EXPECT_EQ(scratch.read(name), outcome["script"].get<std::string>());
      const Result solved =
          run({{"solve", "tests/golden/shared/verify_outcomes/catalog.yaml", scratch / name},
               CBC_SOURCE_DIR});
      EXPECT_EQ(solved.status, 0) << solved.out << solved.err;
      EXPECT_NE(solved.out.find("expectations: 1 passed, 0 failed"), std::string::npos);
    }
  }
  EXPECT_GT(outcomes, 5U);
  const std::string names = scratch / "cart.outcome-1.mission.yaml";
  EXPECT_NE(result.out.find("\nscripts: " + names + " to "), std::string::npos) << result.out;
}

TEST_F(Verify, HasAPageOfEffects) {
  const std::string mower = "tests/golden/shared/verify_effects/catalog.yaml";
  const Result alone = verify({mower, "--effects"});
  const Result both = verify({mower, "--effects", "--html", scratch / "page.html"});
  EXPECT_EQ(both.status, 0);
  EXPECT_EQ(both.out, alone.out);
  const std::string page = scratch.read("page.html");
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  for (const char* const part :
       {"<h1>Effects of faults: tests/golden/shared/verify_effects/catalog.yaml</h1>",
        "<h2>MOW: 93.1 % with BLADES, WHEELS, RTK</h2>",
        "<tr><th scope=\"row\">degraded</th><td>26.6 %</td><td>28.5 %</td><td>RTK</td>"
        "<td>TRACKS, WIRE</td></tr>",
        "<tr><th scope=\"row\">lost</th><td></td><td></td><td>HORN</td><td></td></tr>"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  }
}

TEST_F(Verify, NamesScriptsInJson) {
  const Result result = verify({properties, "--scripts", scratch.path(), "--format", "json"});
  const nlohmann::json report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["properties"][0]["script"], scratch / "robot.5.mission.yaml");
  EXPECT_TRUE(report["properties"][1]["script"].is_null());
}

TEST_F(Verify, GivesEachScriptANameOfItsOwn) {
  fs::create_directory(scratch / "a");
  scratch.write("a/x.yaml",
                "properties: [{reachable: {running: [PING]}}, "
                "{reachable: {running: [LAND]}}]\n");
  scratch.write("x.properties.yaml", "properties: [{reachable: {running: [PING]}}]\n");
  const Result result = verify({catalog, scratch / "a/x.yaml", scratch / "x.properties.yaml",
                                "--scripts", scratch / "scripts"});
  EXPECT_EQ(result.status, 0) << result.err;
  Names names;
  for (const auto& entry : fs::directory_iterator(scratch / "scripts")) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (Names{"x.1.mission.yaml", "x.1-2.mission.yaml", "x.1-3.mission.yaml"}));
}

TEST_F(Verify, ListsAllPropertiesAndDrawsCounterexamplesAndWitnesses) {
  const Result alone = verify({properties});
  const Result result = verify({properties, "--html", scratch / "page.html"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, alone.out);
  const std::string page = scratch.read("page.html");
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_NE(page.find(properties + ":5: landing is always possible"), std::string::npos);
  EXPECT_NE(page.find(properties + ":14: dead reckoning helps out"), std::string::npos);
  EXPECT_NE(page.find(properties + ":7:"), std::string::npos);
  EXPECT_EQ(page.find(R"("script":")" + properties + ":7:"), std::string::npos);
}

TEST_F(Verify, DrawsAPageWithoutCounterexamples) {
  scratch.write("x.yaml", "properties: [{can_start: PING}]\n");
  const Result result = verify({catalog, scratch / "x.yaml", "--html", scratch / "page.html"});
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string page = scratch.read("page.html");
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  EXPECT_NE(page.find(R"("statement":"PING can always start with priority 1","result":"proved",)"),
            std::string::npos);
  EXPECT_NE(page.find(R"(,"run":null}])"), std::string::npos);
}

TEST_F(Verify, WritesItsReportToAFile) {
  for (const char* const format : {"text", "json", "junit", "github"}) {
    const Result shown = verify({properties, "--format", format});
    const Result written = verify({properties, "--format", format, "-o", scratch / "report"});
    EXPECT_EQ(written.status, shown.status);
    EXPECT_EQ(written.out, "");
    EXPECT_EQ(scratch.read("report"), shown.out) << format;
  }
}

TEST_F(Verify, TakesCompiledCatalogs) {
  const std::string compiled = scratch / "robot.cbc";
  ASSERT_EQ(run({{"compile", catalog, "-o", compiled}, CBC_SOURCE_DIR}).status, 0);
  EXPECT_EQ(verify({compiled}).out, verify({catalog}).out);
  EXPECT_EQ(verify({compiled, properties}).out, verify({catalog, properties}).out);
}

TEST_F(Verify, ReportsTheSameWhateverTheJobs) {
  const std::vector<std::vector<std::string>> calls = {
      {properties, "--format", "json"},
      {catalog, "--format", "json"},
      {"catalogs/mobile-manipulator.properties.yaml", "--format", "json"},
      {"catalogs/hospital.properties.yaml", "--format", "json"},
  };
  for (std::vector<std::string> call : calls) {
    call.insert(call.end(), {"--jobs", "1"});
    const Result one = verify(call);
    call.back() = "5";
    EXPECT_EQ(verify(call).out, one.out);
  }
}

/// A catalog of one group with more states than anyone waits for.
std::string endless_catalog() {
  constexpr int tasks = 60;
  std::string behaviors = "behaviors:\n";
  std::string pairs = "exclusivity_constraints:\n";
  for (int task = 0; task < tasks; ++task) {
    const std::string name = "T" + std::to_string(task);
    behaviors += "- {behavior: " + name + ", task: " + name + "}\n";
    if (task == 0) continue;
    pairs += "- mutually_exclusive: [T" + std::to_string(task - 1) + ", " + name + "]\n";
  }
  return behaviors + pairs;
}

TEST_F(Verify, TellsHowFarItIsAndWhatItKnowsWhenInterrupted) {
  scratch.write("endless.yaml", endless_catalog());
  Result result;
  try {
    result =
        run_on_terminal_until({{"verify", "endless.yaml", "--max-memory", "1G"}, scratch.path()},
                              "\rexploring 1 of 1: group 0 (");
  } catch (const std::system_error& error) {
    GTEST_SKIP() << "no terminal here: " << error.what();
  }
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_NE(result.out.find("interrupted; every state up to depth"), std::string::npos);
  EXPECT_NE(result.out.find(" moves/s)"), std::string::npos);
}

TEST_F(Verify, EndsAtTheTimeLimit) {
  scratch.write("endless.yaml", endless_catalog());
  const Result result = verify({scratch / "endless.yaml", "--time-limit", "0.05"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("ended by --time-limit 0.05;"), std::string::npos);
}

TEST_F(Verify, RefusesGroupsThatAreTooLarge) {
  std::string behaviors = "behaviors:\n";
  for (int behavior = 0; behavior <= 65'000; ++behavior) {
    behaviors += "- {behavior: B" + std::to_string(behavior) + ", task: T}\n";
  }
  scratch.write("many.yaml", behaviors);
  const std::string many = scratch / "many.yaml";
  scratch.write("many.properties.yaml", "catalog: many.yaml\nproperties: [{can_start: T}]\n");
  const std::string properties_of_many = scratch / "many.properties.yaml";
  for (const std::string& file : {many, properties_of_many}) {
    const Result result = verify({file});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.find("cbc: '" + file + "': too large to explore: "), 0U) << result.err;
  }
}

/// The comments of catalogs/hospital.properties.yaml say why these are there.
const Names violated_on_purpose = {"it can always clear the way",
                                   "who drives past people spots them"};

/// Whoever changes a published catalog finds out here whether its properties still hold.
TEST(PublishedProperties, HoldUnlessTheySayOtherwise) {
  Names violated;
  for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/catalogs")) {
    const std::string name = "catalogs/" + file.stem().string() + ".properties.yaml";
    const Result result = run({{"verify", name, "--format", "json"}, CBC_SOURCE_DIR});
    EXPECT_EQ(result.err, "") << name;
    const nlohmann::json report = nlohmann::json::parse(result.out);
    EXPECT_GE(report["properties"].size(), 3U) << name;
    int status = 0;
    for (const nlohmann::json& property : report["properties"]) {
      const nlohmann::json& its_name = property["name"];
      const bool is_violated = its_name.is_string() && violated_on_purpose.contains(its_name);
      EXPECT_EQ(property["result"], is_violated ? "violated" : "proved")
          << name << ":" << property["line"];
      if (!is_violated) continue;
      violated.insert(its_name);
      status = 1;
    }
    EXPECT_EQ(result.status, status) << result.out;
  }
  EXPECT_EQ(violated, violated_on_purpose);
}

}  // namespace
}  // namespace cbc::golden::verify_test
