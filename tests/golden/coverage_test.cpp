// `cbc coverage` from outside: the scripts that it writes, their folder, and what is refused.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/exclusive_tasks.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"

namespace cbc::golden::coverage_test {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

class Coverage : public testing::Test {
 protected:
  static Result cbc(std::vector<std::string> arguments) {
    return run({std::move(arguments), CBC_SOURCE_DIR});
  }
  Result write_missing(const std::string& catalog, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"coverage", catalog, "--write-missing", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return cbc(arguments);
  }
  [[nodiscard]] Files files() const {
    Files files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files[entry.path().filename().string()] = test::read_file(entry.path());
    }
    return files;
  }
  /// The reachable goals are met by these missions, and all expectations hold.
  void expect_complete(const std::string& catalog, std::vector<std::string> missions) {
    std::vector<std::string> arguments{"coverage", catalog};
    arguments.insert(arguments.end(), missions.begin(), missions.end());
    for (const char* const option : {"--prove", "--fail-under", "100"}) {
      arguments.emplace_back(option);
    }
    const Result covered = cbc(arguments);
    EXPECT_EQ(covered.status, 0) << covered.out << covered.err;
  }

  /// There are scripts, which say that others are missing, and their expectations hold.
  void expect_incomplete() {
    ASSERT_TRUE(fs::exists(folder));
    EXPECT_FALSE(files().empty());
    for (const auto& [name, text] : files()) {
      EXPECT_NE(text.find("\n# Incomplete: a limit or an interrupt ended that call"),
                std::string::npos)
          << text;
    }
    const Result solved = cbc({"solve", folder});
    EXPECT_EQ(solved.status, 0) << solved.out << solved.err;
  }

  /// A report whose first line has another end.
  static std::string with_heading(std::string report, const std::string& end) {
    return report.insert(report.find('\n'), end);
  }

  test::ScratchFolder scratch;
  const std::string folder = scratch / "tests";
};

using WriteMissing = Coverage;
using Mutants = Coverage;

constexpr const char* robot = R"(
behaviors:
- {behavior: FOLLOW_PATH, task: FOLLOW_PATH, requires: [{task: LOCALIZE}]}
- {behavior: DESCEND, task: LAND}
- {behavior: GPS, task: LOCALIZE, suitability: 90}
- {behavior: CAMERA, task: LOCALIZE, suitability: 60}
tasks:
- {task: FOLLOW_PATH}
- {task: LAND, timeout: 20}
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
exclusivity_constraints:
- mutually_exclusive: [FOLLOW_PATH, LAND]
)";

TEST_F(WriteMissing, MeetsAllGoals) {
  scratch.write("robot.yaml", robot);
  const Result result = write_missing(scratch / "robot.yaml");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  expect_complete(scratch / "robot.yaml", {folder});
}

TEST_F(WriteMissing, KeepsItsScriptsIfALimitComesFirst) {
  scratch.write("robot.yaml", robot);
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  const Files before = files();
  const Result result = write_missing(scratch / "robot.yaml", {"--max-states", "2"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err,
            "cbc: a limit ended the exploration; the folder '" + folder + "' is as it was\n");
  EXPECT_NE(result.out.find("\nincomplete: a limit ended the exploration\n"), std::string::npos)
      << result.out;
  EXPECT_EQ(result.out.find(folder), std::string::npos) << "no file was written";
  EXPECT_EQ(files(), before);
}

TEST_F(WriteMissing, ReplacesIncompleteScripts) {
  scratch.write("robot.yaml", robot);
  EXPECT_EQ(write_missing(scratch / "robot.yaml", {"--max-states", "2"}).status, 1);
  const Files before = files();
  EXPECT_EQ(write_missing(scratch / "robot.yaml", {"--max-states", "6"}).status, 1);
  expect_incomplete();
  EXPECT_NE(files(), before);
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  for (const auto& [name, text] : files()) {
    EXPECT_EQ(text.find("Incomplete"), std::string::npos) << text;
  }
  expect_complete(scratch / "robot.yaml", {folder});
}

TEST_F(WriteMissing, MeetsWhatTheMissionOfTheQuadrotorDoesNot) {
  const std::string catalog = "catalogs/quadrotor.yaml";
  const std::string mission = "catalogs/quadrotor.mission.yaml";
  const Result result = write_missing(catalog, {mission});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  expect_complete(catalog, {mission, folder});
  // What docs/coverage.md shows, and how good it is.
  const std::string shown = result.out.substr(0, result.out.find(" each\n") + 6);
  const std::string page = test::read_file(CBC_SOURCE_DIR "/docs/coverage.md");
  EXPECT_NE(page.find("```text\n" + shown + "```\n"), std::string::npos) << shown;
  const std::string bound = "; at least ";
  const int least = std::stoi(shown.substr(shown.find(bound) + bound.size()));
  EXPECT_LE(2 * files().size(), 3 * static_cast<std::size_t>(least));
}

TEST_F(WriteMissing, WritesTheSameAgain) {
  scratch.write("robot.yaml", robot);
  const Result first = write_missing(scratch / "robot.yaml");
  const Files before = files();
  EXPECT_FALSE(before.empty());
  // Its own scripts do not count as missions that exist.
  const Result second = write_missing(scratch / "robot.yaml", {folder});
  EXPECT_EQ(second.out, with_heading(first.out, " beside no mission"));
  EXPECT_EQ(files(), before);
}

/// Wherever the folder is made, and whether it was there before.
TEST_F(WriteMissing, NamesTheCatalogByItsPathFromTheFolder) {
  scratch.write("robot.yaml", robot);
  for (int time = 0; time < 2; ++time) {
    EXPECT_EQ(run({{"coverage", "robot.yaml", "--write-missing", "tests"}, scratch / ""}).status,
              0);
    for (const auto& [name, text] : files()) {
      EXPECT_NE(text.find("\ncatalog: \"../robot.yaml\"\n"), std::string::npos) << text;
    }
  }
  scratch.write("start.yaml", "[{start: FOLLOW_PATH}]\n");
  const Result mutants = run(
      {{"coverage", "robot.yaml", "--mutants", "start.yaml", "--scripts", "a/more"}, scratch / ""});
  EXPECT_EQ(mutants.status, 0) << mutants.err;
  const Result all = run({{"solve", "a/more"}, scratch / ""});
  EXPECT_EQ(all.status, 0) << all.out << all.err;
}

/// Names, and paths, with characters that YAML and JSON write in different ways: tags, musical
/// signs.
TEST_F(WriteMissing, WritesScriptsThatCanBeReadWhateverTheNamesAre) {
  fs::create_directory(scratch / "it's; echo \U000E0041");
  scratch.write("it's; echo \U000E0041/robot.yaml",
                "behaviors:\n- {behavior: B, task: 'T\U000E0041\U0001D173\u200B''\"\\'}\n");
  const Result written = write_missing(scratch / "it's; echo \U000E0041/robot.yaml");
  EXPECT_EQ(written.status, 0) << written.err;
  EXPECT_NE(written.out.find("it'\\''s; echo"), std::string::npos) << written.out;
  const Result solved = cbc({"solve", folder});
  EXPECT_EQ(solved.status, 0) << solved.err;
}

TEST_F(WriteMissing, RemovesScriptsThatAreNotNeededAnyMore) {
  scratch.write("robot.yaml", robot);
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  fs::create_directory(scratch / "missions");
  for (const auto& [name, text] : files()) scratch.write("missions/" + name, text);
  const Result result = write_missing(scratch / "robot.yaml", {scratch / "missions"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("\nnothing is missing\n"), std::string::npos) << result.out;
  EXPECT_EQ(files(), Files());
}

TEST_F(WriteMissing, MakesNoFolderForNothing) {
  scratch.write("robot.yaml", robot);
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  fs::rename(folder, scratch / "missions");
  EXPECT_EQ(write_missing(scratch / "robot.yaml", {scratch / "missions"}).status, 0);
  EXPECT_FALSE(fs::exists(folder));
}

TEST_F(WriteMissing, NamesTheCommandForWhatIsLeft) {
  scratch.write("robot.yaml", robot);
  const Result result = write_missing(scratch / "robot.yaml");
  const std::string command =
      "cbc coverage " + (scratch / "robot.yaml") + " " + folder + " --mutants --scripts DIR\n";
  EXPECT_NE(result.out.find("\n  " + command), std::string::npos) << result.out;
  const std::string more = scratch / "more";
  EXPECT_EQ(
      cbc({"coverage", scratch / "robot.yaml", "--mutants", folder, "--scripts", more}).status, 0);
  const Result judged =
      cbc({"coverage", scratch / "robot.yaml", "--mutants", folder, more, "--fail-under", "100"});
  EXPECT_EQ(judged.status, 0) << judged.out << judged.err;
}

/// Of px4.yaml what is known then are the values of variables at the beginning.
TEST_F(WriteMissing, WritesWhatIsKnownOnceTheTimeIsOver) {
  const Result result = write_missing("catalogs/px4.yaml", {"--time-limit", "0.000001"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "");
  const std::string expected =
      "\nincomplete: --time-limit 0.000001 ended it in the exploration, after ";
  EXPECT_NE(result.out.find(expected), std::string::npos);
  expect_incomplete();
}

TEST_F(WriteMissing, SaysWhereTheTimeWasOver) {
  const Result result = write_missing(
      "catalogs/quadrotor.yaml", {"catalogs/quadrotor.mission.yaml", "--time-limit", "0.0000010"});
  EXPECT_EQ(result.status, 1);
  const std::string expected =
      "\nincomplete: --time-limit 0.000001 ended it in the missions that exist\n";
  EXPECT_NE(result.out.find(expected), std::string::npos);
  EXPECT_NE(result.out.find("\nno test was found\n"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder));
}

TEST_F(WriteMissing, WritesWhatIsKnownAfterAnInterrupt) {
  Result result;
  try {
    result = run_on_terminal_until(
        {{"coverage", "catalogs/autoware.yaml", "--write-missing", folder}, CBC_SOURCE_DIR},
        "\rexploring ");
  } catch (const std::system_error& error) {
    GTEST_SKIP() << "no terminal here: " << error.what();
  }
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("incomplete: interrupted in the exploration, after "),
            std::string::npos);
  expect_incomplete();
}

TEST_F(WriteMissing, KeepsWhatAnybodyHasWritten) {
  scratch.write("robot.yaml", robot);
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  const Files before = files();
  const std::string changed = before.begin()->second + "# a remark\n";
  scratch.write("tests/" + before.begin()->first, changed);
  const Result result = write_missing(scratch / "robot.yaml");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("'" + before.begin()->first + "'"), std::string::npos) << result.err;
  EXPECT_EQ(files().begin()->second, changed);
}

TEST_F(WriteMissing, RefusesFoldersWithOtherThings) {
  scratch.write("robot.yaml", robot);
  fs::create_directories(folder + "/inner.yaml");
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 2);
  fs::remove(folder + "/inner.yaml");
  scratch.write("tests/notes.txt", "mine");
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 2);
  EXPECT_EQ(files(), (Files{{"notes.txt", "mine"}}));
  fs::remove(folder + "/notes.txt");
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 0);
  fs::create_symlink(scratch / "robot.yaml", folder + "/link.yaml");
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 2);
}

TEST_F(WriteMissing, RefusesFilesAndFoldersThatCannotBeWritten) {
  scratch.write("robot.yaml", robot);
  scratch.write("tests", "a file");
  EXPECT_EQ(write_missing(scratch / "robot.yaml").status, 2);
  EXPECT_EQ(test::read_file(folder), "a file");
  const Result below =
      cbc({"coverage", scratch / "robot.yaml", "--write-missing", folder + "/a/b/"});
  EXPECT_EQ(below.status, 2);
  EXPECT_EQ(below.err, "cbc: cannot write to the folder '" + folder + "/a/b/': Not a directory\n");
  fs::remove(folder);
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::create_directory(folder);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  const Result refused = write_missing(scratch / "robot.yaml");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err, "cbc: cannot write to the folder '" + folder + "': Permission denied\n");
  fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(WriteMissing, GivesSafeNames) {
  scratch.write("odd.yaml", R"(
behaviors:
- {behavior: "../../X", task: "a/b"}
- {behavior: "../../x", task: "A/B"}
- {behavior: "…", task: "\u0001"}
exclusivity_constraints: [{mutually_exclusive: ["a/b", "A/B", "\u0001"]}]
)");
  const Result result = write_missing(scratch / "odd.yaml");
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  for (const auto& [name, text] : files()) {
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-."), std::string::npos)
        << name;
    EXPECT_NE(name.front(), '-');
    EXPECT_NE(name.front(), '.');
  }
  expect_complete(scratch / "odd.yaml", {folder});
}

TEST_F(WriteMissing, SaysThatOneTestIsNeeded) {
  scratch.write("small.yaml", "behaviors:\n- {behavior: HORN, task: SIGNAL}\n");
  const Result result = write_missing(scratch / "small.yaml");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find("1 test with 4 events; at least one is needed, with at most"),
            std::string::npos)
      << result.out;
}

/// Two reactive tasks take turns, with more timeouts than a script may have, before the timeout of
/// the survey comes.
TEST_F(WriteMissing, ListsATimeoutThatWaitingDoesNotShow) {
  scratch.write("late.yaml", R"(
tasks:
- {task: SURVEY, timeout: 100}
- {task: LOOK_LEFT, reactive_start: true, timeout: 5}
- {task: LOOK_RIGHT, reactive_start: true, timeout: 5}
- {task: SEE, start_on_request: false, execution_goal: keep_running}
behaviors:
- {behavior: SCAN, task: SURVEY, requires: [{task: SEE}]}
- {behavior: TURN_LEFT, task: LOOK_LEFT, requires: [{task: SEE}]}
- {behavior: TURN_RIGHT, task: LOOK_RIGHT, requires: [{task: SEE}]}
- {behavior: CAMERA, task: SEE}
exclusivity_constraints:
- mutually_exclusive: [LOOK_LEFT, LOOK_RIGHT]
)");
  const Result result = write_missing(scratch / "late.yaml");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("\nno test shows that\n  task SURVEY ran into its timeout\n"
                            "    waiting in the states that were tried did not show it; events at "
                            "other times were not tried\n"),
            std::string::npos)
      << result.out;
  // A script by hand shows it, and is taken into account.
  const std::string mission = scratch / "late.mission.yaml";
  scratch.write(
      "late.mission.yaml",
      "- situation: {TURN_LEFT: false, TURN_RIGHT: false}\n- start: SURVEY\n- wait: 100\n");
  EXPECT_EQ(write_missing(scratch / "late.yaml", {mission}).status, 0);
}

TEST_F(WriteMissing, SaysWhatALimitLeavesOpen) {
  const Result result = write_missing("catalogs/quadrotor.yaml", {"--max-states", "10"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("a limit ended the exploration"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("needed"), std::string::npos);
  for (const auto& [name, text] : files()) {
    EXPECT_EQ(cbc({"solve", "catalogs/quadrotor.yaml", folder + "/" + name}).status, 0) << name;
  }
}

/// A folder with the missions that would notice survivors, beside those that exist: then nothing
/// survives.
TEST_F(Mutants, WritesTheMissionsThatNoticeSurvivors) {
  const std::string cases = "tests/golden/shared/coverage_mutants/";
  const auto judge = [&](const std::string& beside) {
    const Result result = cbc({"coverage", cases + "robot.yaml", cases + "delivery.mission.yaml",
                               beside, "--mutants", "--scripts", folder, "--format", "json"});
    EXPECT_EQ(result.status, 0) << result.err;
    return nlohmann::json::parse(result.out);
  };
  const nlohmann::json before = judge(cases + "delivery.mission.yaml");
  EXPECT_GT(before["survived"], 5);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const Result solved =
        run({{"solve", cases + "robot.yaml", entry.path().string()}, CBC_SOURCE_DIR});
    EXPECT_EQ(solved.status, 0) << solved.out << solved.err;
  }
  const nlohmann::json after = judge(folder);
  EXPECT_EQ(after["survived"], 0);
  EXPECT_EQ(after["equivalent"], before["equivalent"]);
  EXPECT_EQ(after["percent"], 100);
}

/// The output does not depend on the number of threads.
TEST_F(Mutants, JudgesMutantsAlikeWithAnyNumberOfJobs) {
  std::vector<std::string> arguments = {
      "coverage", "catalogs/quadrotor.yaml", "catalogs/quadrotor.mission.yaml", "--mutants", "-j",
      "1"};
  const Result one = cbc(arguments);
  EXPECT_EQ(one.status, 0) << one.err;
  arguments.back() = "3";
  EXPECT_EQ(cbc(arguments).out, one.out);
}

/// Each of these pairs would be a goal, and a mutant.
TEST_F(Coverage, RefusesToListMillionsOfPairs) {
  scratch.write("many.yaml", test::exclusive_tasks(1001));
  scratch.write("mission.yaml", "[{start: T0}]\n");
  const std::string message = "the exclusivity lists of '" + (scratch / "many.yaml") +
                              "' have 500500 pairs of tasks; expected at most 500000\n";
  const auto expect_refusal = [&](const Result& result, const std::string& option) {
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "cbc: " + option + message);
  };
  const std::string many = scratch / "many.yaml";
  const std::string mission = scratch / "mission.yaml";
  expect_refusal(cbc({"coverage", many, mission, "--mutants"}), "--mutants: ");
  expect_refusal(cbc({"coverage", many, "--write-missing", scratch / "tests"}),
                 "--write-missing: ");
  EXPECT_FALSE(fs::exists(scratch / "tests"));
  expect_refusal(cbc({"coverage", many, mission}), "");
}

}  // namespace
}  // namespace cbc::golden::coverage_test
