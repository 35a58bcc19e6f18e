// What `cbc init` writes passes all checks; it never overwrites a file.
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <sys/wait.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::init_test {
namespace {

namespace fs = std::filesystem;

class Init : public testing::Test {
 protected:
  [[nodiscard]] Result cbc(std::vector<std::string> arguments) const {
    return run({std::move(arguments), folder.path()});
  }
  void init() const {
    const Result result = cbc({"init"});
    ASSERT_EQ(result.status, 0) << result.err;
  }
  /// The exit status of a command of the shell, which runs in the folder with the program on the
  /// PATH.
  [[nodiscard]] int shell(const std::string& command) const {
    const std::string bin = folder / "bin";
    fs::create_directory(bin);
    if (!fs::exists(bin + "/cbc")) fs::create_symlink(CBC_PROGRAM_PATH, bin + "/cbc");
    const std::string line =
        "cd '" + folder.path() + "' && PATH=\"$PWD/bin:$PATH\" && { " + command + "\n} >log 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  test::ScratchFolder folder;
};

TEST_F(Init, WritesWhatPassesAllChecks) {
  init();
  Result result = cbc({"lint", "--strict", "."});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  result = cbc({"solve", "missions"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("\nexpectations: 5 passed, 0 failed\n"), std::string::npos)
      << result.out;
  EXPECT_EQ(cbc({"compile", "robot.yaml"}).status, 0);
}

TEST_F(Init, WritesAScriptForCiThatFindsMistakes) {
  init();
  EXPECT_EQ(shell("sh ci.sh"), 0) << folder.read("log");
  fs::create_directory(folder / "elsewhere");
  EXPECT_EQ(shell("cd elsewhere && sh ../ci.sh"), 0) << folder.read("log");
  EXPECT_EQ(shell("sed -i 's/running: {CHARGE: DOCK}, stopped/running: {CHARGE: any}, started/' "
                  "missions/delivery.yaml && sh ci.sh"),
            1)
      << "the mission has an unknown key";
  EXPECT_EQ(shell("sed -i 's/suitability: 80/suitability: 60/; s/, started/, stopped/' robot.yaml "
                  "missions/delivery.yaml && GITHUB_ACTIONS=true sh ci.sh"),
            1)
      << "the robot drives fast, with the camera";
  EXPECT_EQ(folder.read("log").rfind("::error file=missions/delivery.yaml,line=15", 0), 0U)
      << folder.read("log");
}

TEST_F(Init, WritesTheSchemasThatTheFilesName) {
  init();
  for (const std::string name : {"catalog", "script", "settings"}) {
    EXPECT_EQ(folder.read(".cbc/" + name + ".json"), cbc({"schema", name}).out);
  }
  for (const std::string name : {"robot.yaml", "missions/delivery.yaml", ".cbc.yaml"}) {
    const std::string text = folder.read(name);
    const std::string line = text.substr(0, text.find('\n'));
    const std::string key = "# yaml-language-server: $schema=";
    ASSERT_EQ(line.rfind(key, 0), 0U) << name;
    EXPECT_TRUE(fs::exists(fs::path(folder / name).parent_path() / line.substr(key.size())));
  }
}

TEST_F(Init, NamesCommandsThatWork) {
  const std::string out = cbc({"init", "new/robot"}).out;
  const std::string commands = out.substr(out.find("\nnext:\n") + 7);
  EXPECT_EQ(commands.rfind("  cd new/robot\n", 0), 0U) << commands;
  EXPECT_EQ(shell("set -e\n" + commands), 0) << folder.read("log");
  EXPECT_TRUE(fs::exists(folder / "new/robot/missions.html"));
}

TEST_F(Init, NeverOverwritesAFile) {
  folder.write("robot.yaml", "mine\n");
  fs::create_symlink("nowhere", folder / "ci.sh");
  const Result result = cbc({"init"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "cbc: 'robot.yaml', 'ci.sh' exist; nothing is written\n");
  EXPECT_EQ(folder.read("robot.yaml"), "mine\n");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "ci.sh"}));
  EXPECT_EQ(cbc({"init", "sub/.."}).err, result.err);
}

TEST_F(Init, CompletesWhatAnInterruptedRunHasLeft) {
  init();
  const std::set<std::string> names = folder.names();
  fs::remove(folder / "ci.sh");
  fs::remove_all(folder / "missions");
  const Result result = cbc({"init"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.rfind("wrote missions/delivery.yaml  ", 0), 0U) << result.out;
  EXPECT_EQ(folder.names(), names);
  EXPECT_EQ(shell("sh ci.sh"), 0) << folder.read("log");

  fs::remove(folder / "ci.sh");
  folder.write("robot.yaml", folder.read("robot.yaml") + "# mine\n");
  EXPECT_EQ(cbc({"init"}).status, 2);
  EXPECT_FALSE(fs::exists(folder / "ci.sh"));
}

TEST_F(Init, LeavesNoPartOfAFile) {
  EXPECT_EQ(shell("ulimit -f 1; cbc init"), 2);  // of 512 bytes
  EXPECT_EQ(folder.read("log"), "cbc: cannot write 'robot.yaml': File too large\n");
  EXPECT_FALSE(fs::exists(folder / "robot.yaml"));
}

TEST_F(Init, SaysWhyItCannotWrite) {
  folder.write("file", "");
  const Result result = cbc({"init", "file"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "cbc: cannot write 'file/robot.yaml': Not a directory\n");
  Call call{{"init"}, folder.path()};
  call.standard_output = "/dev/full";
  EXPECT_EQ(run(call).status, 2);
}

}  // namespace
}  // namespace cbc::golden::init_test
