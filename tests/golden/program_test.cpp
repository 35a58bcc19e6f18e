// What golden files do not show: the program on a terminal, and what differs from build to build.
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cbc/version.h"
#include "commands.h"
#include "golden/process.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"

namespace cbc::golden::program_test {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& name) {
  return fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "shared" / name;
}

/// Without escape sequences of colors, and with the line ends of files.
std::string plain(const std::string& text) {
  std::string result;
  for (std::size_t place = 0; place < text.size(); ++place) {
    if (text.compare(place, 2, "\x1b[") == 0) {
      place = text.find('m', place);
      if (place == std::string::npos) break;
    } else if (text[place] != '\r') {
      result += text[place];
    }
  }
  return result;
}

bool has_color(const std::string& text) { return text.find('\x1b') != std::string::npos; }

Call mission_call() {
  return {{"solve", "catalog.yaml", "script.yaml"}, folder_of("mission_text")};
}

Call error_call() {
  return {{"solve", "catalog.yaml", "script.yaml"}, folder_of("catalog_undefined_task")};
}

Call lint_call() {
  return {{"lint", "--summary", "catalog.yaml", "good.yaml"}, folder_of("lint_summary")};
}

Call lint_findings_call() { return {{"lint", "catalog.yaml"}, folder_of("lint_format_text")}; }

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    try {
      static_cast<void>(run_on_terminal({{"--version"}, "/"}));
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "no terminal here: " << error.what();
    }
  }
};

/// The words of a text, one blank between them.
std::string words(const std::string& text) {
  std::istringstream stream(text);
  std::string joined;
  for (std::string word; stream >> word;) joined += word + " ";
  return joined;
}

/// Runs on a terminal; says whether there were colors, and that all else but the ends of lines is
/// as in a file.
bool shows_color(const Call& call) {
  const Result shown = run_on_terminal(call);
  const Result written = run(call);
  EXPECT_FALSE(has_color(written.out + written.err));
  EXPECT_EQ(words(plain(shown.out)), words(written.out + written.err));
  EXPECT_EQ(shown.status, written.status);
  return has_color(shown.out);
}

TEST_F(Terminal, ShowsResultsAndFindingsInColor) {
  EXPECT_TRUE(shows_color(mission_call()));
  EXPECT_TRUE(shows_color(error_call()));
  EXPECT_TRUE(shows_color(lint_call()));
  EXPECT_TRUE(shows_color(lint_findings_call()));
  EXPECT_TRUE(shows_color({{"lint", "--explain", "dead-task"}, "/"}));
  EXPECT_TRUE(shows_color({{"verify", "robot.properties.yaml"}, folder_of("verify_properties")}));
  EXPECT_TRUE(shows_color({{"lint", "--list-rules"}, "/"}));
}

std::size_t longest_line(const std::string& text) {
  std::istringstream stream(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(stream, line);) longest = std::max(longest, line.size());
  return longest;
}

TEST_F(Terminal, WrapsTheTextOfARun) {
  const Call call{{"solve", "catalog.yaml", "script.yaml", "--why", "PARK"},
                  folder_of("why_nobody_requested")};
  EXPECT_LE(longest_line(plain(run_on_terminal(call).out)), 80U) << "nobody said how wide it is";
  EXPECT_GT(longest_line(run(call).out), 100U) << "grep would miss what is on two lines";
}

TEST_F(Terminal, WrapsTheTextsOfCoverageMutantsAndTests) {
  const test::ScratchFolder scratch;
  scratch.write("robot.yaml", R"(
behaviors:
- {behavior: CARRY_PARCEL_WITH_A_VERY_CAREFUL_DRIVER, task: CARRY_PARCEL_TO_THE_OFFICE, requires: [{task: LOCALIZE_IN_BUILDING}]}
- {behavior: LOCALIZE_WITH_CEILING_CAMERA, task: LOCALIZE_IN_BUILDING}
tasks:
- {task: CARRY_PARCEL_TO_THE_OFFICE}
- {task: LOCALIZE_IN_BUILDING, start_on_request: false, execution_goal: keep_running, timeout: 5}
- {task: WAIT_AT_THE_CHARGING_STATION_ON_THE_GROUND_FLOOR_NOW}
)");
  scratch.write("mission.yaml", "- start: CARRY_PARCEL_TO_THE_OFFICE\n");
  const std::vector<std::vector<std::string>> calls{
      {"coverage", "robot.yaml", "mission.yaml", "--prove"},
      {"coverage", "robot.yaml", "mission.yaml", "--mutants"},
      {"coverage", "robot.yaml", "--write-missing", "tests"}};
  for (const std::vector<std::string>& arguments : calls) {
    const Call call{arguments, scratch.path()};
    const Result written = run(call);
    const Result shown = run_on_terminal(call);
    // Lines of scripts are there to be copied.
    const std::regex of_scripts("\n *- \\{[^\n]*");
    EXPECT_GT(longest_line(std::regex_replace(written.out, of_scripts, "")), 80U) << written.out;
    EXPECT_LE(longest_line(std::regex_replace(plain(shown.out), of_scripts, "")), 80U) << shown.out;
    EXPECT_EQ(words(plain(shown.out)), words(written.out + written.err));
  }
}

TEST_F(Terminal, ShowsTheSignsOfChangesInColor) {
  const std::string shown = run_on_terminal(mission_call()).out;
  EXPECT_NE(shown.find("\x1b[32m+\x1b[0m Y"), std::string::npos);
  EXPECT_NE(shown.find("\x1b[31m-\x1b[0m Y"), std::string::npos);
}

TEST_F(Terminal, ShowsWhatOtherProgramsReadWithoutColor) {
  for (const char* format : {"json", "sarif", "github", "gcc"}) {
    Call call = lint_findings_call();
    call.arguments.insert(call.arguments.end(), {"--format", format});
    EXPECT_FALSE(shows_color(call)) << format;
  }
  EXPECT_FALSE(shows_color({{"lint", "--diff", "catalog.yaml"}, folder_of("lint_diff")}));
}

TEST_F(Terminal, ShowsReportsForProgramsWithoutColor) {
  for (const char* format : {"json", "junit", "github"}) {
    for (Call call :
         {Call{{"solve", "catalog.yaml", "script.yaml"}, folder_of("expectation_fails")},
          Call{{"verify", "robot.properties.yaml"}, folder_of("verify_properties")}}) {
      call.arguments.insert(call.arguments.end(), {"--format", format});
      std::string shown = run_on_terminal(call).out;
      std::erase(shown, '\r');
      EXPECT_NE(shown.find(run(call).out), std::string::npos) << format;
    }
  }
}

TEST_F(Terminal, ShowsNoColorWhereNoneIsWanted) {
  for (Call call : {mission_call(), error_call(), lint_call(), lint_findings_call()}) {
    call.environment = {{"TERM", "xterm"}, {"NO_COLOR", "1"}};
    EXPECT_FALSE(shows_color(call));
  }
}

TEST_F(Terminal, TakesAnEmptyNoColorAsUnset) {
  Call call = mission_call();
  call.environment = {{"TERM", "xterm"}, {"NO_COLOR", ""}};
  EXPECT_TRUE(shows_color(call));
}

TEST_F(Terminal, ShowsNoColorIfItIsDumb) {
  for (Call call : {mission_call(), error_call(), lint_call(), lint_findings_call()}) {
    call.environment = {{"TERM", "dumb"}};
    EXPECT_FALSE(shows_color(call));
  }
}

TEST_F(Terminal, TellsHowFarALongSweepIs) {
  const std::string catalog = CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";
  const Result result =
      run_on_terminal_until({{"sweep", catalog, "--sequences", "1000000000"}, "/"},
                            "\rsweeping 1 of 1: " + catalog + " (0 %)");
  EXPECT_EQ(result.status, 128 + SIGINT);
  EXPECT_EQ(result.out.find("sweep of"), std::string::npos);
}

TEST_F(Terminal, IsNoPlaceForACompiledCatalog) {
  const Call call{{"compile", "catalog.yaml", "-o", "-"}, folder_of("mission_text")};
  const Result result = run_on_terminal(call);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(plain(result.out),
            "cbc: a compiled catalog is not written to a terminal; expected a file or a pipe\n");
  EXPECT_EQ(run(call).status, 0);
}

/// In the folder catalogs/: NAME.yaml, each with a NAME.mission.yaml and a NAME.properties.yaml.
std::vector<std::string> names_of_published_catalogs() {
  std::vector<std::string> names;
  for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/catalogs")) {
    names.push_back(file.stem());
  }
  return names;
}

/// A NAME.mission.yaml for each, and those of other folders.
std::size_t count_published_missions() {
  std::size_t count = names_of_published_catalogs().size();
  for (const char* const folder : {"/catalogs/missions", "/catalogs/tests"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(CBC_SOURCE_DIR + std::string(folder))) {
      if (entry.path().extension() == ".yaml") ++count;
    }
  }
  return count;
}

TEST(PublishedCatalogs, HaveNoFindings) {
  const std::vector<std::string> names = names_of_published_catalogs();
  ASSERT_GE(names.size(), 2U);
  Call call{{"lint", "--strict", "catalogs"}, CBC_SOURCE_DIR};
  Result result = run(call);
  EXPECT_EQ(result.status, 0);
  const std::string count = std::to_string(names.size());
  EXPECT_EQ(result.out, "no findings in " + count + " catalogs, " +
                            std::to_string(count_published_missions()) + " scripts, " + count +
                            " property files\n");
  EXPECT_EQ(result.err, "");
  for (const std::string& name : names) {
    const std::string path = "catalogs/" + name;
    call.arguments = {"lint", "--strict", "--script", path + ".mission.yaml", path + ".yaml"};
    result = run(call);
    EXPECT_EQ(result.out, "no findings in 1 catalog, 1 script\n") << name;
    // It names its catalog.
    call.arguments = {"lint", "--strict", path + ".properties.yaml"};
    result = run(call);
    EXPECT_EQ(result.out, "no findings in 1 property file\n") << name;
    EXPECT_EQ(result.err, "") << name;
  }
}

/// Whoever changes a published catalog or a mission finds out here whether the story still holds.
TEST(PublishedMissions, MeetTheirExpectations) {
  const Result result = run({{"solve", "catalogs", "--format", "json"}, CBC_SOURCE_DIR});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_EQ(result.err, "");
  const nlohmann::json report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["runs"].size(), count_published_missions());
  for (const nlohmann::json& run : report["runs"]) {
    EXPECT_GT(run["expectations"]["passed"], 0) << run["script"];
  }
}

/// What the comment at the beginning of a catalog says of its size.
TEST(PublishedCatalogs, AreAsLargeAsTheySay) {
  const Result result = run({{"lint", "--format", "json", "catalogs"}, CBC_SOURCE_DIR});
  const nlohmann::json report = nlohmann::json::parse(result.out);
  ASSERT_GE(report["files"].size(), 18U);
  for (const nlohmann::json& file : report["files"]) {
    const nlohmann::json& summary = file["summary"];
    if (summary.is_null()) continue;  // a mission, or a property file
    const nlohmann::json& constraints = summary["constraints"];
    const auto count = [](const nlohmann::json& number, const std::string& what) {
      const std::string text = number.dump() + " " + what;
      return number == 1 ? text : text + "s";
    };
    const std::string said = "# " + count(summary["tasks"], "task") + ", " +
                             count(summary["behaviors"], "behavior") + ", " +
                             count(constraints["total"], "constraint") + " (" +
                             count(constraints["exclusive_pairs"], "exclusive pair") + ", " +
                             count(constraints["requirements"], "requirement") + "), ";
    const fs::path path = fs::path(CBC_SOURCE_DIR) / file["file"];
    EXPECT_NE(test::read_file(path).find(said), std::string::npos)
        << path << " does not say " << said;
  }
}

/// A command that a page shows, and what it prints, in parts; "..." stands between them.
struct Excerpt {
  std::vector<std::string> arguments;
  std::vector<std::string> parts = {""};
};

/// The console blocks of a page, each with one command.
std::vector<Excerpt> excerpts_of(const std::string& page) {
  std::ifstream text(fs::path(CBC_SOURCE_DIR) / page);
  std::vector<Excerpt> excerpts;
  std::string line;
  while (std::getline(text, line)) {
    if (line != "```console") continue;
    Excerpt& excerpt = excerpts.emplace_back();
    while (std::getline(text, line) && line != "```") {
      if (line.substr(0, 6) == "$ cbc ") {
        std::istringstream words(line.substr(6));
        for (std::string word; words >> word;) excerpt.arguments.push_back(word);
      } else if (line == "...") {
        excerpt.parts.emplace_back();
      } else {
        excerpt.parts.back() += line + "\n";
      }
    }
  }
  return excerpts;
}

TEST(Readme, FitsOnAFewScreens) {
  std::ifstream readme(fs::path(CBC_SOURCE_DIR) / "README.md");
  std::size_t words = 0;
  for (std::string word; readme >> word;) ++words;
  EXPECT_LT(words, 1200U);
}

TEST(Readme, ShowsTheCatalogThatItRuns) {
  const std::string readme = test::read_file(CBC_SOURCE_DIR "/README.md");
  const std::size_t begin = readme.find("```yaml\n") + 8;
  const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
  EXPECT_NE(test::read_file(CBC_SOURCE_DIR "/docs/fetch.yaml").find(shown), std::string::npos)
      << shown;
}

class ExcerptsOf : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(ExcerptsOf, AreWhatTheProgramPrints) {
  const auto& [page, count] = GetParam();
  const std::vector<Excerpt> excerpts = excerpts_of(page);
  ASSERT_EQ(excerpts.size(), count);
  for (const Excerpt& excerpt : excerpts) {
    ASSERT_GT(excerpt.parts.size(), 1U);
    const Result result = run({excerpt.arguments, CBC_SOURCE_DIR});
    // What docs/ has is wrong, to show it; recipes are right.
    const std::string& file = excerpt.arguments.back();
    const bool is_wrong = (file.starts_with("docs/") && !file.starts_with("docs/recipes/")) ||
                          file.find("/verify_lasting/") != std::string::npos;
    EXPECT_EQ(result.status, is_wrong ? 1 : 0);
    std::size_t place = 0;
    for (const std::string& part : excerpt.parts) {
      ASSERT_GT(part.size(), 30U);
      place = result.out.find(part, place);
      ASSERT_NE(place, std::string::npos) << "not printed here: " << part;
      place += part.size();
    }
  }
}

TEST(Pages, ShowFilesAsTheyAre) {
  const std::string root = CBC_SOURCE_DIR;
  for (const char* const name : {"verify_conditions", "verify_lasting", "verify_outcomes_link"}) {
    const std::string file =
        test::read_file(root + "/tests/golden/shared/" + name + "/robot.properties.yaml");
    EXPECT_NE(test::read_file(root + "/docs/verify.md").find("```yaml\n" + file + "```\n"),
              std::string::npos)
        << name;
  }
}

TEST(Pages, LinkToFilesThatExist) {
  const fs::path root(CBC_SOURCE_DIR);
  std::vector<fs::path> pages = {root / "README.md", root / "CONTRIBUTING.md",
                                 root / "catalogs" / "README.md", root / "schemas" / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  for (const fs::path& page : pages) {
    const std::string text = test::read_file(page);
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      EXPECT_TRUE(fs::exists(page.parent_path() / (*at)[1].str())) << page << ": " << (*at)[1];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Pages, ExcerptsOf,
    testing::Values(std::pair("README.md", 2U), std::pair("docs/coverage.md", 2U),
                    std::pair("docs/recipes.md", 19U), std::pair("docs/sweeps.md", 1U),
                    std::pair("docs/tuning.md", 4U), std::pair("docs/verify.md", 7U)));

/// One screen: `man` has the rest.
TEST(Help, FitsOnAScreen) {
  const auto expect_fit = [](const std::vector<std::string>& arguments) {
    const Result result = run({arguments, "/"});
    EXPECT_EQ(result.status, 0);
    EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 50) << result.out;
    EXPECT_LE(longest_line(result.out), 80U) << result.out;
  };
  expect_fit({"--help"});
#define CBC_EXPECT_FIT(name) expect_fit({#name, "--help"});
  CBC_COMMANDS(CBC_EXPECT_FIT)
#undef CBC_EXPECT_FIT
}

/// Of a mission in which more expectations fail than anybody reads.
TEST(FailedExpectations, AreExplainedUpToABound) {
  const test::ScratchFolder folder;
  const std::string catalog = "behaviors: [{behavior: GPS, task: LOCALIZE}]\n";
  std::string script = "- start: LOCALIZE\n";
  for (int i = 0; i < 5000; ++i) script += "- expect: {stopped: [LOCALIZE]}\n";
  std::ofstream(folder / "catalog.yaml") << catalog;
  std::ofstream(folder / "script.yaml") << script;
  Call call{{"solve", "catalog.yaml", "script.yaml"}, folder.path()};
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const std::string text = run(call).out;
  EXPECT_EQ(count(text, "\nscript.yaml:"), 5000U);
  EXPECT_EQ(count(text, "decided at event 1"), 100U);
  EXPECT_EQ(count(text, "not explained"), 1U);
  call.arguments.insert(call.arguments.end(), {"--format", "json"});
  const auto report = nlohmann::json::parse(run(call).out);
  std::size_t explained = 0;
  for (const auto& failure : report["runs"][0]["expectations"]["failures"]) {
    explained += failure["why"].size();
  }
  EXPECT_EQ(explained, 100U);
}

TEST(Version, IsThatOfTheHeaders) {
  const Result result = run({{"--version"}, "/"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "cbc " + std::string(version) + "\n");
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace cbc::golden::program_test
