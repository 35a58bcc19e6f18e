// No output replaces a file that was read, whatever it was read for, and under whatever name.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/compiled_files.h"

namespace cbc::golden::protected_inputs_test {
namespace {

namespace fs = std::filesystem;

/// A command line that ends with the name of an output.
using CommandLine = std::vector<std::string>;

class ProtectedInputs : public CompiledFiles {
 protected:
  void SetUp() override {
    compile_robot();
    folder.write(".cbc.yaml", "allow: [duplicate-exclusion]\n");
    fs::create_directory(folder / "missions");
    folder.write("missions/mission.yaml", script);
    folder.write("named.yaml", "catalog: robot.yaml\nevents: [{start: HOVER}]\n");
    folder.write("properties.yaml", "catalog: robot.yaml\nproperties: [{can_start: LAND}]\n");
    folder.write("log.jsonl",
                 cbc({"solve", "robot.cbc", "missions/mission.yaml", "--format", "jsonl"}).out);
  }

  /// Tries to replace an input by its name, by a symbolic and by a hard link.
  void expect_protected(const CommandLine& command, const std::string& input) const {
    const std::string before = folder.read(input);
    const std::string target = fs::absolute(folder / input).string();
    fs::create_symlink(target, folder / "soft");
    fs::create_hard_link(folder / input, folder / "hard");
    for (const std::string& output :
         {input, "./" + input, std::string("soft"), std::string("hard")}) {
      CommandLine arguments = command;
      arguments.push_back(output);
      const Result result = cbc(arguments);
      std::string shown;
      for (const std::string& argument : arguments) shown += argument + " ";
      EXPECT_EQ(result.status, 2) << shown << result.err;
      EXPECT_NE(result.err.find("the output '" + output + "' is also an input"), std::string::npos)
          << shown << result.err;
      EXPECT_EQ(folder.read(input), before) << shown;
    }
    fs::remove(folder / "soft");
    fs::remove(folder / "hard");
  }
};

TEST_F(ProtectedInputs, AreTheSettings) {
  const std::vector<CommandLine> commands{
      {"compile", "robot.yaml", "-o"},
      {"graph", "robot.yaml", "--format", "dot", "-o"},
      {"graph", "robot.yaml", "--view", "together", "--format", "text", "-o"},
      {"graph", "robot.yaml", "--script", "missions/mission.yaml", "--format", "dot", "-o"},
      {"graph", "--diff", "robot.yaml", "robot.cbc", "--format", "text", "-o"},
      {"solve", "robot.yaml", "missions", "--html"},
      {"solve", "robot.yaml", "missions/mission.yaml", "--format", "jsonl", "--state-out"},
      {"sweep", "robot.yaml", "--sequences", "2", "--slowest"},
      {"coverage", "robot.yaml", "missions", "--output"},
      {"solve", "--replay", "log.jsonl", "robot.yaml", "--to-script"},
      {"verify", "robot.yaml", "--output"},
      {"verify", "robot.yaml", "properties.yaml", "--output"}};
  for (const CommandLine& command : commands) expect_protected(command, ".cbc.yaml");
}

TEST_F(ProtectedInputs, AreFilesThatOtherFilesName) {
  expect_protected({"solve", "named.yaml", "--html"}, "robot.yaml");
  expect_protected({"solve", "named.yaml", "--format", "jsonl", "--state-out"}, "robot.yaml");
  expect_protected({"solve", "robot.cbc", "missions", "--html"}, "missions/mission.yaml");
  expect_protected({"graph", "--script", "named.yaml", "--format", "dot", "-o"}, "robot.yaml");
  expect_protected({"verify", "properties.yaml", "--output"}, "robot.yaml");
}

TEST_F(ProtectedInputs, AreFilesOfTheCommandLine) {
  expect_protected({"solve", "--replay", "log.jsonl", "robot.cbc", "--to-script"}, "log.jsonl");
  expect_protected({"solve", "--replay", "log.jsonl", "robot.cbc", "--to-script"}, "robot.cbc");
  expect_protected({"verify", "properties.yaml", "--html"}, "properties.yaml");
}

/// Also where the catalog is wrong, and a report says so.
TEST_F(ProtectedInputs, AreProtectedFromReportsOfErrors) {
  folder.write("robot.yaml", "behaviors: [{behavior: A}]\n");
  expect_protected({"verify", "properties.yaml", "--format", "junit", "--output"}, ".cbc.yaml");
}

TEST_F(ProtectedInputs, AreNamedAsTheyWereRead) {
  fs::create_symlink(".cbc.yaml", folder / "page.html");
  expect_result(cbc({"solve", "robot.yaml", "missions", "--html", "page.html"}), 2, "",
                "cbc: the output 'page.html' is also an input: it is the same file as "
                "'.cbc.yaml', which was read\n");
}

/// A state may be replaced by the next one, and by nothing else.
TEST_F(ProtectedInputs, AreStatesThatAStreamContinues) {
  const CommandLine stream{"solve", "robot.cbc", "missions/mission.yaml", "--format", "jsonl"};
  CommandLine first = stream;
  first.insert(first.end(), {"--state-out", "state.json"});
  EXPECT_EQ(cbc(first).status, 0);
  CommandLine second = stream;
  second.insert(second.end(), {"--state-in", "state.json"});
  const Result log = cbc(second);
  EXPECT_EQ(log.status, 0) << log.err;
  folder.write("second.jsonl", log.out);
  expect_protected(
      {"solve", "--replay", "second.jsonl", "robot.cbc", "--state-in", "state.json", "--html"},
      "state.json");
  second.insert(second.end(), {"--state-out", "state.json"});
  EXPECT_EQ(cbc(second).status, 0);
}

TEST_F(ProtectedInputs, AreScriptsThatWouldBeReplaced) {
  EXPECT_EQ(cbc({"coverage", "robot.yaml", "--write-missing", "tests"}).status, 0);
  const fs::path script = fs::directory_iterator(folder / "tests")->path().filename();
  fs::create_directory(folder / "links");
  fs::create_symlink(fs::path("../tests") / script, folder / "links" / script);
  const std::string before = folder.read("tests/" + script.string());
  const Result result = cbc({"coverage", "robot.yaml", "links", "--write-missing", "tests"});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("is also an input"), std::string::npos) << result.err;
  EXPECT_EQ(folder.read("tests/" + script.string()), before);
}

/// Two names of a file that does not exist yet.
TEST_F(ProtectedInputs, AreNotTheOnlyFilesThatAreWrittenOnce) {
  fs::create_symlink("page.html", folder / "link.html");
  for (const std::string other : {"./page.html", "missions/../page.html", "link.html"}) {
    expect_result(cbc({"verify", "properties.yaml", "-o", "page.html", "--html", other}), 2, "",
                  "cbc: '" + other + "' would be written twice\nSee 'cbc verify --help'.\n");
  }
}

/// What is read to be replaced: a state that goes on, and what --fix mends.
TEST_F(ProtectedInputs, MayBeReplacedWhereThatIsMeant) {
  const CommandLine stream{"solve", "robot.cbc", "missions/mission.yaml", "--format", "jsonl"};
  CommandLine first = stream;
  first.insert(first.end(), {"--state-out", "state.json"});
  EXPECT_EQ(cbc(first).status, 0);
  const std::string before = folder.read("state.json");
  CommandLine second = first;
  second.insert(second.end(), {"--state-in", "state.json"});
  EXPECT_EQ(cbc(second).status, 0);
  EXPECT_NE(folder.read("state.json"), before);

  fs::create_directory(folder / "other");
  folder.write("other/old.yaml", std::string(robot) + "- mutually_exclusive: [LAND, HOVER]\n");
  EXPECT_EQ(cbc({"lint", "--fix", "other/old.yaml"}).status, 0);
}

}  // namespace
}  // namespace cbc::golden::protected_inputs_test
