// `cbc compile`: what it writes, and what it leaves behind if it cannot.
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "cbc/version.h"
#include "golden/compiled_files.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::golden::compile_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* wrong = "behaviors: [{behavior: GPS, task: LOCALIZE, suitability: much}]\n";

class Compile : public CompiledFiles {};

/// Nothing is read-only for the administrator of the system.
bool is_writable(const std::string& folder) {
  const std::string probe = folder + "/probe";
  const bool is_open = std::ofstream(probe).is_open();
  if (is_open) fs::remove(probe);
  return is_open;
}

// Writing -----------------------------------------------------------------------------------------

TEST_F(Compile, WritesAFileWithTheSuffixReplaced) {
  fs::create_directory(folder / "sub.d");
  for (const char* name : {"a.yaml", "sub.d/b.v2.yml", "sub.d/c"}) folder.write(name, robot);
  expect_silence(cbc({"compile", "a.yaml"}));
  expect_silence(cbc({"compile", "sub.d/b.v2.yml"}));
  expect_silence(cbc({"compile", "sub.d/c"}));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"a.yaml", "a.cbc", "sub.d"}));
  EXPECT_TRUE(fs::exists(folder / "sub.d/b.v2.cbc"));
  EXPECT_TRUE(fs::exists(folder / "sub.d/c.cbc"));
}

TEST_F(Compile, WritesWhatTheCatalogSays) {
  compile_robot();
  const CompiledFileResult result = load_compiled(folder / "robot.cbc");
  ASSERT_TRUE(result.file) << result.error;
  EXPECT_EQ(result.file->catalog.file, "robot.yaml");
  EXPECT_EQ(result.file->source, digest_of(robot));
  EXPECT_EQ(result.file->written_by, version);
  EXPECT_EQ(result.file->catalog.tasks.size(), 3U);
}

TEST_F(Compile, WritesTheSameBytesEachTimeAndEverywhere) {
  compile_robot();
  for (const char* option : {"-o", "--output"}) {
    expect_silence(cbc({"compile", option, "other", "robot.yaml"}));
    EXPECT_EQ(folder.read("other"), folder.read("robot.cbc"));
  }
  const Result piped = cbc({"compile", "robot.yaml", "-o", "-"});
  expect_result(piped, 0, folder.read("robot.cbc"), "");
  const test::ScratchFolder elsewhere;
  elsewhere.write("robot.yaml", robot);
  expect_silence(run({{"compile", "robot.yaml"}, elsewhere.path()}));
  EXPECT_EQ(elsewhere.read("robot.cbc"), folder.read("robot.cbc"));
}

/// The file of the tests of the newest format was written once, by another compiler than some of
/// those that build this.
TEST_F(Compile, WritesTheSameBytesWhateverItWasBuiltWith) {
  const std::string kept = CBC_SOURCE_DIR "/tests/golden/shared/compiled_format_2_solve/robot";
  fs::copy_file(kept + ".yaml", folder / "robot.yaml");
  const CompiledFileResult before = load_compiled(kept + ".cbc");
  ASSERT_TRUE(before.file) << before.error;
  if (before.file->written_by != version) GTEST_SKIP() << "the file is of an older version";
  const Result result = cbc({"compile", "--check", "robot.yaml", "-o", kept + ".cbc"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
}

TEST_F(Compile, TakesACatalogFromStandardInput) {
  folder.write("robot.yaml", robot);
  expect_silence(cbc_reading("robot.yaml", {"compile", "-", "-o", "robot.cbc"}));
  const CompiledFileResult result = load_compiled(folder / "robot.cbc");
  ASSERT_TRUE(result.file) << result.error;
  EXPECT_EQ(result.file->catalog.file, "<stdin>");
  EXPECT_EQ(result.file->source, digest_of(robot));
}

TEST_F(Compile, ReplacesAFileAndKeepsItsPermissions) {
  folder.write("robot.cbc", "something else");
  fs::permissions(folder / "robot.cbc",
                  fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
  const fs::perms permissions = fs::status(folder / "robot.cbc").permissions();
  compile_robot();
  EXPECT_TRUE(load_compiled(folder / "robot.cbc").file);
  EXPECT_EQ(fs::status(folder / "robot.cbc").permissions(), permissions);
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "robot.cbc"}));
}

TEST_F(Compile, GivesANewFileThePermissionsOfTheUmask) {
  for (const mode_t mask : {mode_t{022}, mode_t{077}}) {
    const mode_t before = umask(mask);
    compile_robot();
    umask(before);
    struct stat status {};
    ASSERT_EQ(stat((folder / "robot.cbc").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0666 & ~mask);
    fs::remove(folder / "robot.cbc");
  }
}

TEST_F(Compile, FollowsALink) {
  fs::create_directory(folder / "store");
  fs::create_symlink("store/real.cbc", folder / "robot.cbc");
  compile_robot();
  EXPECT_TRUE(fs::is_symlink(folder / "robot.cbc"));
  EXPECT_TRUE(load_compiled(folder / "store/real.cbc").file);
}

TEST_F(Compile, RefusesACatalogWithErrors) {
  folder.write("robot.yaml", wrong);
  folder.write("robot.cbc", "as it was");
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--check"}, {"--dump"}, {"-o", "-"}}) {
    std::vector<std::string> arguments{"compile", "robot.yaml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Result result = cbc(arguments);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("robot.yaml:1:58: error: 'suitability' must be"), std::string::npos)
        << result.err;
  }
  EXPECT_EQ(folder.read("robot.cbc"), "as it was");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "robot.cbc"}));
}

TEST_F(Compile, WritesDespiteWarningsAndShowsThem) {
  folder.write("robot.yaml", std::string(robot) + "more: 1\n");
  const Result result = cbc({"compile", "robot.yaml"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("warning: unknown key 'more'"), std::string::npos) << result.err;
  EXPECT_TRUE(load_compiled(folder / "robot.cbc").file);
  folder.write(".cbc.yaml", "error: [unknown-key]\n");
  EXPECT_EQ(cbc({"compile", "robot.yaml", "-o", "strict.cbc"}).status, 2);
  folder.write(".cbc.yaml", "allow: [unknown-key]\n");
  expect_silence(cbc({"compile", "robot.yaml", "-o", "allowed.cbc"}));
  EXPECT_FALSE(fs::exists(folder / "strict.cbc"));
}

TEST_F(Compile, RefusesToWriteOverTheCatalog) {
  folder.write("robot.cbc", robot);
  fs::create_hard_link(folder / "robot.cbc", folder / "hard");
  fs::create_symlink("robot.cbc", folder / "soft");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"robot.cbc"},
                                                    {"robot.cbc", "-o", "./robot.cbc"},
                                                    {"robot.cbc", "-o", "hard"},
                                                    {"robot.cbc", "-o", "soft"},
                                                    {"soft", "-o", "robot.cbc"}}) {
    std::vector<std::string> all{"compile"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Result result = cbc(all);
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("is also an input"), std::string::npos) << result.err;
    EXPECT_EQ(folder.read("robot.cbc"), robot);
  }
}

TEST_F(Compile, LeavesNothingBehindWhereItCannotWrite) {
  folder.write("robot.yaml", robot);
  fs::create_directory(folder / "closed");
  const auto expect_failure = [&](const std::string& output, const std::string& reason) {
    expect_result(cbc({"compile", "robot.yaml", "-o", output}), 2, "",
                  "cbc: cannot write '" + output + "': " + reason + "\n");
  };
  expect_failure("missing/robot.cbc", "No such file or directory");
  expect_failure("robot.yaml/robot.cbc", "Not a directory");
  expect_failure("closed", "Is a directory");
  expect_failure("closed/", "Is a directory");
  expect_failure("/dev/full", "it is not a regular file");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  if (!is_writable(folder / "closed")) expect_failure("closed/robot.cbc", "Permission denied");
  fs::permissions(folder / "closed", fs::perms::owner_all);
  EXPECT_TRUE(fs::is_empty(folder / "closed"));
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "closed"}));
}

}  // namespace
}  // namespace cbc::golden::compile_test
