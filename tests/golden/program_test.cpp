// What golden files do not show: the program on a terminal, and what differs from build to build.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

#include "cbc/version.h"
#include "golden/process.h"

namespace cbc::golden {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& name) {
  return fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "cases" / name;
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

/// Runs on a terminal; says whether there were colors, and that all else is as in a file.
bool shows_color(const Call& call) {
  const Result shown = run_on_terminal(call);
  const Result written = run(call);
  EXPECT_FALSE(has_color(written.out + written.err));
  EXPECT_EQ(plain(shown.out), written.out + written.err);
  EXPECT_EQ(shown.status, written.status);
  return has_color(shown.out);
}

TEST_F(Terminal, ShowsResultsAndFindingsInColor) {
  EXPECT_TRUE(shows_color(mission_call()));
  EXPECT_TRUE(shows_color(error_call()));
}

TEST_F(Terminal, ShowsJsonWithoutColor) {
  Call call = mission_call();
  call.arguments.insert(call.arguments.end(), {"--format", "json"});
  EXPECT_FALSE(shows_color(call));
}

TEST_F(Terminal, ShowsNoColorWhereNoneIsWanted) {
  for (Call call : {mission_call(), error_call()}) {
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
  for (Call call : {mission_call(), error_call()}) {
    call.environment = {{"TERM", "dumb"}};
    EXPECT_FALSE(shows_color(call));
  }
}

/// Whoever changes a published catalog or a mission finds out here whether the story still holds.
TEST(PublishedMissions, MeetTheirExpectations) {
  const Result result = run({{"solve", "catalogs"}, CBC_SOURCE_DIR});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_EQ(result.err, "");
}

/// The lines of the README's first console block, the command and the "..." left out.
std::vector<std::string> lines_of_readme() {
  std::ifstream readme(fs::path(CBC_SOURCE_DIR) / "README.md");
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(readme, line) && line != "```console") continue;
  while (std::getline(readme, line) && line != "```") {
    if (line != "..." && line.substr(0, 1) != "$") lines.push_back(line);
  }
  return lines;
}

TEST(Readme, ShowsWhatTheProgramPrints) {
  const Result result = run(
      {{"solve", "catalogs/quadrotor.yaml", "catalogs/quadrotor.mission.yaml"}, CBC_SOURCE_DIR});
  const std::vector<std::string> lines = lines_of_readme();
  ASSERT_GT(lines.size(), 10U);
  std::size_t place = 0;
  for (const std::string& line : lines) {
    place = result.out.find(line + "\n", place);
    ASSERT_NE(place, std::string::npos) << "not printed here: " << line;
  }
}

TEST(Version, IsThatOfTheHeaders) {
  const Result result = run({{"--version"}, "/"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "cbc " + std::string(version) + "\n");
  EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace cbc::golden
