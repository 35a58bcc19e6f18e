// `cbc compile`: what it writes, and what it leaves behind if it cannot.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <vector>

#include <fmt/format.h>
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
  const std::string kept = CBC_SOURCE_DIR "/tests/golden/cases/compiled_format_2_solve/robot";
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

/// Catalog of many tasks, for which writing takes a while.
std::string large_catalog() {
  constexpr int tasks = 20'000;
  std::string text = "behaviors:\n";
  for (int task = 0; task < tasks; ++task) {
    text += fmt::format("- {{behavior: BEHAVIOR_{0}, task: TASK_{0}}}\n", task);
  }
  return text;
}

/// What files of the program may grow to, while this object lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

/// As on a full disk: a part can be written, then no more.
TEST_F(Compile, LeavesNothingBehindWhereOnlyAPartCanBeWritten) {
  folder.write("large.yaml", large_catalog());
  folder.write("large.cbc", "as it was");
  Result result;
  {
    const FileSizeLimit limit(64 << 10);
    result = cbc({"compile", "large.yaml"});
  }
  expect_result(result, 2, "", "cbc: cannot write 'large.cbc': File too large\n");
  EXPECT_EQ(folder.read("large.cbc"), "as it was");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"large.yaml", "large.cbc"}));
}

TEST_F(Compile, RemovesLeftoversOfRunsThatWereKilled) {
  folder.write("robot.yaml", robot);
  folder.write(".cbc-0123456789abcdef.tmp", "of an old run");
  folder.write(".cbc-0123456789abcdee.tmp", "of a run that may go on");
  fs::last_write_time(folder / ".cbc-0123456789abcdef.tmp",
                      fs::file_time_type::clock::now() - std::chrono::hours(2));
  expect_silence(cbc({"compile", "robot.yaml"}));
  EXPECT_EQ(folder.names(),
            (std::set<std::string>{".cbc-0123456789abcdee.tmp", "robot.cbc", "robot.yaml"}));
}

/// Whether a process, which nobody has waited for yet, is at its end.
bool has_ended(pid_t process) {
  siginfo_t state{};
  waitid(P_PID, static_cast<id_t>(process), &state, WEXITED | WNOHANG | WNOWAIT);
  return state.si_pid == process;
}

/// Whatever the moment, there is the old file or the new one, whole, and nothing else.
TEST_F(Compile, LeavesAWholeFileWhenASignalComes) {
  folder.write("large.yaml", large_catalog());
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(cbc({"compile", "large.yaml"}).status, 0);
  const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - start);
  const std::string complete = folder.read("large.cbc");
  const std::set<std::string> names = folder.names();
  const std::string old = "as it was";
  const auto size = [&] { return fs::file_size(folder / "large.cbc"); };

  constexpr int rounds = 16;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> moment(0, whole.count());
  int killed = 0;
  for (int round = 0; round < rounds; ++round) {
    folder.write("large.cbc", old);
    const int signal = round % 4 == 3 ? SIGINT : SIGTERM;
    const Result result = run({{"compile", "large.yaml"}, folder.path()}, [&](pid_t process) {
      if (round % 2 == 0) {
        std::this_thread::sleep_for(std::chrono::microseconds(moment(random)));
      } else {
        // As soon as anything is written.
        while (!has_ended(process) && folder.names() == names && size() == old.size()) {
        }
      }
      kill(process, signal);
    });
    constexpr int signal_base = 128;
    if (result.status != 0) {
      EXPECT_EQ(result.status, signal_base + signal) << result.err;
      ++killed;
    }
    const std::string left = folder.read("large.cbc");
    EXPECT_TRUE(left == complete || left == old) << left.size() << " bytes";
    EXPECT_TRUE(result.status != 0 || left == complete);
    EXPECT_EQ(folder.names(), names);
  }
  EXPECT_GT(killed, 0);
}

}  // namespace
}  // namespace cbc::golden::compile_test
