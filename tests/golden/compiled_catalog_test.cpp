// Compiled catalogs in the place of YAML, for all commands.
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "golden/compiled_files.h"
#include "support/read_file.h"

namespace cbc::golden::compiled_catalog_test {
namespace {

namespace fs = std::filesystem;

class CompiledCatalog : public CompiledFiles {};

TEST_F(CompiledCatalog, TakesNoCompiledCatalogAgain) {
  compile_robot();
  fs::rename(folder / "robot.cbc", folder / "again.yaml");
  const std::string complaint =
      "cbc: 'again.yaml' is a compiled catalog already; expected one in YAML\n";
  expect_result(cbc({"compile", "again.yaml"}), 2, "", complaint);
  expect_result(cbc({"compile", "again.yaml", "--check"}), 2, "", complaint);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "again.yaml"}));
}

TEST_F(CompiledCatalog, GivesSolveACatalogByContentNotByName) {
  compile_robot();
  folder.write("script.yaml", script);
  for (const char* format : {"text", "json"}) {
    const Result expected = cbc({"solve", "robot.yaml", "script.yaml", "--format", format});
    EXPECT_EQ(expected.status, 0);
    fs::copy_file(folder / "robot.cbc", folder / "named.yaml",
                  fs::copy_options::overwrite_existing);
    for (const char* name : {"robot.cbc", "named.yaml", "./named.yaml"}) {
      expect_result(cbc({"solve", name, "script.yaml", "--format", format}), 0, expected.out, "");
    }
    expect_result(cbc_reading("robot.cbc", {"solve", "-", "script.yaml", "--format", format}), 0,
                  expected.out, "");
  }
}

TEST_F(CompiledCatalog, GivesSolveACatalogThatTheScriptNames) {
  fs::create_directory(folder / "missions");
  compile_robot();
  folder.write("missions/a.yaml", "catalog: ../robot.cbc\nevents: " + std::string(script));
  const Result result = cbc({"solve", "missions/a.yaml"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.substr(0, result.out.find('\n')), "missions/a.yaml with robot.yaml");
  EXPECT_EQ(cbc({"lint", "missions/a.yaml"}).status, 0);
  folder.write("missions/b.yaml", "catalog: ../robot.cbc\nevents: [{start: HOVR}]\n");
  EXPECT_EQ(cbc({"solve", "missions/b.yaml"}).status, 2);
  EXPECT_EQ(cbc({"lint", "missions/b.yaml"}).status, 1);
}

TEST_F(CompiledCatalog, GivesSolveNoScript) {
  compile_robot();
  folder.write("script.yaml", script);
  fs::create_directory(folder / "missions");
  fs::rename(folder / "robot.cbc", folder / "missions/robot.yaml");
  expect_result(cbc({"solve", "robot.yaml", "missions/robot.yaml"}), 2, "",
                "cbc: 'missions/robot.yaml' is a catalog; expected a script here (a catalog goes "
                "first)\n");
  expect_result(cbc({"solve", "missions/robot.yaml"}), 2, "",
                "cbc: no event script given for catalog 'missions/robot.yaml'\n");
  expect_result(cbc({"solve", "robot.yaml", "missions"}), 2, "",
                "cbc: found no event script in 'missions'\n");
  folder.write("missions/script.yaml", script);
  const Result result = cbc({"solve", "robot.yaml", "missions"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  expect_result(cbc({"lint", "--script", "missions/robot.yaml", "robot.yaml"}), 2,
                "no findings in 1 catalog\n",
                "cbc: 'missions/robot.yaml' is a catalog; expected an event script or a property "
                "file\n");
}

TEST_F(CompiledCatalog, IsTrustedByNoCommandIfDamaged) {
  compile_robot();
  folder.write("script.yaml", script);
  const std::string content = folder.read("robot.cbc");
  folder.write("robot.cbc", content.substr(0, content.size() / 2));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"solve", "robot.cbc", "script.yaml"},
        {"lint", "--summary", "robot.cbc"},
        {"compile", "--dump", "robot.cbc"}}) {
    const Result result = cbc(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.find("cbc: cannot read 'robot.cbc': it is damaged"), 0U) << result.err;
  }
}

TEST_F(CompiledCatalog, GivesLintASummary) {
  fs::create_directory(folder / "compiled");
  folder.write("robot.yaml", robot);
  ASSERT_EQ(cbc({"compile", "robot.yaml", "-o", "compiled/robot.yaml"}).status, 0);
  for (const char* format : {"text", "json"}) {
    const std::vector<std::string> arguments{"lint", "--summary", "--format", format, "robot.yaml"};
    const Result expected = cbc(arguments);
    EXPECT_EQ(expected.status, 0);
    expect_result(run({arguments, folder / "compiled"}), 0, expected.out, "");
  }
  const Result piped = cbc_reading("compiled/robot.yaml", {"lint", "--summary", "-"});
  EXPECT_EQ(piped.status, 0);
  EXPECT_EQ(piped.out.find("<stdin>\n  tasks                      3\n"), 0U) << piped.out;
}

TEST_F(CompiledCatalog, GivesLintNoText) {
  compile_robot();
  const std::string complaint =
      "cbc: 'robot.cbc' is a compiled catalog; expected YAML (--summary takes either)\n";
  for (const std::vector<std::string>& options : {std::vector<std::string>{},
                                                  {"--format", "json"},
                                                  {"--format", "sarif"},
                                                  {"--fix"},
                                                  {"--fix", "--summary"},
                                                  {"--diff"}}) {
    std::vector<std::string> arguments{"lint", "robot.cbc"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_result(cbc(arguments), 2, "", complaint);
  }
  const Result both = cbc({"lint", "robot.cbc", "robot.yaml"});
  expect_result(both, 2, "no findings in 1 catalog\n", complaint);
  EXPECT_EQ(folder.read("robot.yaml"), robot);
}

bool has_mapped(pid_t process, std::string_view file) {
  const std::string maps = test::read_file(fmt::format("/proc/{}/maps", process));
  return maps.find(file) != std::string::npos;
}

/// The catalog is cut off when it is in memory already, and the script has yet to come.
TEST_F(CompiledCatalog, ThatIsCutOffMeanwhileEndsTheProgramWithAMessage) {
  compile_robot();
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const int pipe = open((folder / "pipe").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(pipe, 0);
  const Call call{{"solve", "robot.cbc", "-"}, folder.path(), folder / "pipe"};
  const Result result = run(call, [&](pid_t process) {
    for (int wait = 0; wait < 2000 && !has_mapped(process, "robot.cbc"); ++wait) usleep(5000);
    fs::resize_file(folder / "robot.cbc", 0);
    EXPECT_EQ(write(pipe, script, std::strlen(script)), static_cast<ssize_t>(std::strlen(script)));
    close(pipe);
  });
  expect_result(result, 2, "",
                "cbc: a compiled catalog was truncated or became unreadable while it was in use\n");
}

/// In folders, lint looks for catalogs to mend.
TEST_F(CompiledCatalog, IsPassedOverByLintInFolders) {
  compile_robot();
  fs::copy_file(folder / "robot.cbc", folder / "copy.yaml");
  expect_result(cbc({"lint", "."}), 0, "no findings in 1 catalog\n", "");
}

TEST_F(CompiledCatalog, GivesLintACatalogForScripts) {
  compile_robot();
  folder.write("good.yaml", script);
  folder.write("bad.yaml", "[{start: HOVR}]\n");
  expect_result(cbc({"lint", "--script", "good.yaml", "robot.cbc"}), 0, "no findings in 1 script\n",
                "");
  const Result result = cbc({"lint", "--script", "bad.yaml", "robot.cbc"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.out.find("did you mean 'HOVER'?"), std::string::npos) << result.out;
  const Result summary = cbc({"lint", "--summary", "--script", "good.yaml", "robot.cbc"});
  EXPECT_EQ(summary.status, 0);
  EXPECT_EQ(summary.out.find("robot.cbc\n  tasks"), 0U) << summary.out;
}

}  // namespace
}  // namespace cbc::golden::compiled_catalog_test
