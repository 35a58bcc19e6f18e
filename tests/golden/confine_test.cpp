// --confine: files of others cannot make the program read, or show, what is outside of a folder.
#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "golden/compiled_files.h"

namespace cbc::golden::confine_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* secret = "root:$6$hunter2:19000:0:99999:7:::\n";

class Confine : public CompiledFiles {
 protected:
  void SetUp() override {
    fs::create_directories(folder / "repository/missions");
    folder.write("robot.yaml", robot);
    folder.write("shadow", secret);
    folder.write("secrets.yaml", "password: hunter2\n");
    folder.write("repository/robot.yaml", robot);
    folder.write("repository/mission.yaml", "catalog: robot.yaml\nevents: [{start: HOVER}]\n");
  }

  void name_catalog(const std::string& catalog) const {
    folder.write("repository/missions/bad.yaml",
                 "catalog: " + catalog + "\nevents: [{start: HOVER}]\n");
  }

  /// The file is refused, and nothing of it is shown.
  void expect_refusal(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--confine", "repository"});
    const Result result = cbc(arguments);
    EXPECT_EQ(result.status, 2) << arguments.front();
    EXPECT_NE(result.err.find("it is outside of '"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("(--confine)"), std::string::npos) << result.err;
    EXPECT_EQ((result.out + result.err).find("hunter2"), std::string::npos) << result.err;
  }
};

TEST_F(Confine, FilesInTheFolderAreRead) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"solve", "repository/mission.yaml"},
        {"lint", "repository"},
        {"lint", "repository/robot.yaml"},
        {"compile", "repository/robot.yaml", "-o", "out.cbc"},
        {"verify", "repository/robot.yaml"},
        {"graph", "repository/robot.yaml"}}) {
    std::vector<std::string> confined = arguments;
    confined.insert(confined.end(), {"--confine", "repository"});
    const Result result = cbc(confined);
    EXPECT_EQ(result.status, 0) << arguments.front() << result.err;
    EXPECT_EQ(result.err, "");
  }
}

TEST_F(Confine, NoOtherFileIsNamedByAScript) {
  fs::create_symlink("../../shadow", folder / "repository/missions/link.yaml");
  fs::create_symlink("../..", folder / "repository/missions/up");
  for (const std::string& catalog :
       {folder / "shadow", std::string("../../shadow"), std::string("link.yaml"),
        std::string("up/robot.yaml"), std::string("../../robot.yaml"),
        std::string("../../no_such_file"), std::string("/etc/shadow")}) {
    name_catalog(catalog);
    expect_refusal({"solve", "repository/missions/bad.yaml"});
    expect_refusal({"lint", "repository/missions/bad.yaml"});
    expect_refusal({"graph", "--script", "repository/missions/bad.yaml"});
  }
}

TEST_F(Confine, NoOtherFileIsGiven) {
  folder.write("mission.yaml", script);
  expect_refusal({"solve", "robot.yaml", "repository/mission.yaml"});
  expect_refusal({"solve", "repository/robot.yaml", "mission.yaml"});
  expect_refusal({"lint", "robot.yaml"});
  expect_refusal({"lint", "."});
  expect_refusal({"compile", "robot.yaml", "-o", "-"});
  expect_refusal({"verify", "robot.yaml"});
  expect_refusal({"solve", "--replay", "mission.yaml", "repository/robot.yaml"});
  expect_refusal({"solve", "repository/robot.yaml", "repository/mission.yaml", "--format", "jsonl",
                  "--state-in", "shadow"});
  expect_silence(cbc({"compile", "robot.yaml"}));
  expect_refusal({"graph", "robot.cbc"});
}

TEST_F(Confine, SettingsAboveTheFolderDoNotCount) {
  folder.write(".cbc.yaml", "this: [is no catalog");
  EXPECT_EQ(cbc({"lint", "repository/robot.yaml"}).status, 2);
  EXPECT_EQ(cbc({"lint", "repository/robot.yaml", "--confine", "repository"}).status, 0);
  fs::create_symlink("../shadow", folder / "repository/.cbc.yaml");
  expect_refusal({"solve", "repository/mission.yaml"});
}

/// Without the option, nothing is shown of what links lead to that were found, and not named.
TEST_F(Confine, NothingIsShownOfALinkedFileThatIsNotMeantForIt) {
  const fs::path settings = folder / "repository/.cbc.yaml";
  for (const std::string target : {"../shadow", "../secrets.yaml"}) {
    fs::create_symlink(target, settings);
    expect_result(cbc({"solve", "repository/robot.yaml", "repository/mission.yaml"}), 2, "",
                  "cbc: 'repository/.cbc.yaml' is a link to a file elsewhere that has no valid "
                  "settings\n");
    fs::remove(settings);
  }
  folder.write("key", "password: [hunter2\n");
  fs::create_symlink("../../key", folder / "repository/missions/found.yaml");
  expect_result(cbc({"solve", "repository/robot.yaml", "repository/missions"}), 2, "",
                "cbc: 'repository/missions/found.yaml' is a link to a file elsewhere that is not "
                "valid YAML\n");
}

TEST_F(Confine, NeedsAFolder) {
  expect_result(cbc({"lint", "robot.yaml", "--confine", "no_such"}), 2, "",
                "cbc: --confine: there is no folder 'no_such'\nSee 'cbc lint --help'.\n");
}

/// Also without the option.
TEST_F(Confine, NothingIsShownOfANamedFileThatIsNoCatalog) {
  for (const std::string catalog : {"../../shadow", "../../secrets.yaml"}) {
    name_catalog(catalog);
    const Result result = cbc({"solve", "repository/missions/bad.yaml"});
    EXPECT_EQ(result.status, 2);
    const std::string name = "'" + catalog.substr(6) + "'";
    EXPECT_EQ(result.err, "cbc: " + name +
                              " is not a catalog\n"
                              "cbc: repository/missions/bad.yaml:1:10: the catalog " +
                              name + " cannot be used\n");
    EXPECT_EQ(result.out, "");
  }
}

/// Otherwise a link would tell whether a file exists.
TEST_F(Confine, LinksOutOfTheFolderAreRefusedWhetherOrNotTheyLeadToSomething) {
  fs::create_directories(folder / "elsewhere");
  folder.write("elsewhere/robot.yaml", robot);
  fs::create_symlink("loop.yaml", folder / "repository/loop.yaml");
  for (const std::string target :
       {"../robot.yaml", "../missing.yaml", "second.yaml", "../none/x"}) {
    fs::remove(folder / "repository/link.yaml");
    fs::remove(folder / "repository/second.yaml");
    fs::create_symlink(target, folder / "repository/link.yaml");
    fs::create_symlink("../missing.yaml", folder / "repository/second.yaml");
    SCOPED_TRACE(target);
    expect_refusal({"lint", "repository"});
    expect_refusal({"lint", "repository/link.yaml"});
    name_catalog("../link.yaml");
    expect_refusal({"solve", "repository/missions/bad.yaml"});
  }
  expect_refusal({"lint", "repository/loop.yaml"});
  for (const std::string target : {"../elsewhere", "../missing"}) {
    fs::remove(folder / "repository/linked");
    fs::create_symlink(target, folder / "repository/linked");
    name_catalog("../linked/robot.yaml");
    expect_refusal({"solve", "repository/missions/bad.yaml"});
  }
  // Within the folder, what is missing is missing.
  fs::remove(folder / "repository/link.yaml");
  fs::create_symlink("missions/none.yaml", folder / "repository/link.yaml");
  EXPECT_EQ(cbc({"lint", "repository/link.yaml", "--confine", "repository"}).err,
            "cbc: cannot read 'repository/link.yaml': No such file or directory\n");
}

/// A pipe without a writer would block, also within the folder.
TEST_F(Confine, NoPipeOrDeviceIsNamedByAFile) {
  ASSERT_EQ(::mkfifo((folder / "repository/pipe.yaml").c_str(), 0600), 0);
  for (const std::string catalog : {"../pipe.yaml", "/dev/zero"}) {
    name_catalog(catalog);
    folder.write("repository/missions/bad.properties.yaml",
                 "catalog: " + catalog + "\nproperties: [{can_start: HOVER}]\n");
    const std::string name = catalog.starts_with("..") ? "repository/pipe.yaml" : catalog;
    const std::string message = "cbc: cannot read '" + name + "': it is no regular file\n";
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"solve", "repository/missions/bad.yaml"},
          {"graph", "--script", "repository/missions/bad.yaml"},
          {"lint", "repository/missions/bad.yaml"},
          {"verify", "repository/missions/bad.properties.yaml"}}) {
      const Result result = cbc(arguments);
      EXPECT_EQ(result.status, 2) << arguments.front();
      EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
      EXPECT_EQ(result.out, "") << arguments.front();
    }
  }
}

}  // namespace
}  // namespace cbc::golden::confine_test
