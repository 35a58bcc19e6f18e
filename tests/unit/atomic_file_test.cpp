#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/support/system.h"
#include "support/scratch_folder.h"

namespace cbc::atomic_file_test {
namespace {

using Names = std::set<std::string>;

unsigned mode_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(AtomicFile, MakesANewFile) {
  const test::ScratchFolder folder;
  const mode_t before = umask(027);
  EXPECT_EQ(write_atomically(folder / "a", "new"), std::nullopt);
  umask(before);
  EXPECT_EQ(folder.read("a"), "new");
  EXPECT_EQ(mode_of(folder / "a"), 0640U);
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, MakesAFileThatMustNotExist) {
  const test::ScratchFolder folder;
  EXPECT_EQ(create_atomically(folder / "a", "first"), std::nullopt);
  EXPECT_EQ(create_atomically(folder / "a", "second"), "File exists");
  std::filesystem::create_symlink("nowhere", folder / "link");
  EXPECT_EQ(create_atomically(folder / "link", "third"), "File exists");
  EXPECT_EQ(create_atomically(folder / "missing/a", "fourth"), "No such file or directory");
  EXPECT_EQ(folder.read("a"), "first");
  EXPECT_EQ(folder.names(), (Names{"a", "link"}));
}

TEST(AtomicFile, ReplacesAFileAndKeepsItsMode) {
  const test::ScratchFolder folder;
  folder.write("a", "a longer old content");
  ASSERT_EQ(chmod((folder / "a").c_str(), 0606), 0);
  const std::string content = std::string(300'000, 'x') + '\0' + "end";
  EXPECT_EQ(write_atomically(folder / "a", content), std::nullopt);
  EXPECT_EQ(folder.read("a"), content);
  EXPECT_EQ(mode_of(folder / "a"), 0606U);
  EXPECT_EQ(write_atomically(folder / "a", ""), std::nullopt);
  EXPECT_EQ(folder.read("a"), "");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST(AtomicFile, RefusesWhatAProgramHasOpen) {
  const test::ScratchFolder folder;
  folder.write("a", "old");
  const int descriptor = open((folder / "a").c_str(), O_WRONLY | O_CLOEXEC);
  std::filesystem::create_symlink("/dev/fd/" + std::to_string(descriptor), folder / "link");
  for (const std::string& path : {"/dev/fd/" + std::to_string(descriptor),
                                  "/proc/self/fd/" + std::to_string(descriptor), folder / "link"}) {
    EXPECT_EQ(write_atomically(path, "new"), "it is not the name of a file; '-' is standard output")
        << path;
  }
  close(descriptor);
  EXPECT_EQ(folder.read("a"), "old");
}

TEST(AtomicFile, FollowsLinks) {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("sub/target", "old");
  std::filesystem::create_symlink("sub/target", folder / "link");
  std::filesystem::create_symlink(folder / "link", folder / "absolute");
  EXPECT_EQ(write_atomically(folder / "absolute", "new"), std::nullopt);
  EXPECT_EQ(folder.read("sub/target"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "absolute"));
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "sub/target"));
  // To a file that is not there yet.
  std::filesystem::create_symlink("sub/later", folder / "dangling");
  EXPECT_EQ(write_atomically(folder / "dangling", "made"), std::nullopt);
  EXPECT_EQ(folder.read("sub/later"), "made");
  // To itself.
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_NE(write_atomically(folder / "loop", "new"), std::nullopt);
}

TEST(AtomicFile, InTheWorkingFolder) {
  const test::ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  EXPECT_EQ(write_atomically("a", "new"), std::nullopt);
  std::filesystem::current_path(before);
  EXPECT_EQ(folder.read("a"), "new");
}

TEST(AtomicFile, SaysWhyItCannot) {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("a", "old");
  EXPECT_EQ(write_atomically(folder / "no/such", "new"), "No such file or directory");
  EXPECT_EQ(write_atomically(folder / "sub", "new"), "Is a directory");
  EXPECT_EQ(write_atomically(folder / "sub/", "new"), "Is a directory");
  EXPECT_EQ(write_atomically(folder / "a/b", "new"), "Not a directory");
  EXPECT_EQ(write_atomically("/dev/null", "new"), "it is not a regular file");
  EXPECT_EQ(folder.names(), (Names{"a", "sub"}));
}

TEST(AtomicFile, KnowsObstaclesBefore) {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "sub");
  folder.write("a", "old");
  EXPECT_EQ(find_obstacle(folder / "a"), std::nullopt);
  EXPECT_EQ(find_obstacle(folder / "new"), std::nullopt);
  EXPECT_EQ(find_obstacle(folder / "no/such"), "No such file or directory");
  EXPECT_EQ(find_obstacle(folder / "sub"), "Is a directory");
  EXPECT_EQ(find_obstacle(folder / "a/b"), "Not a directory");
  EXPECT_EQ(find_obstacle("/dev/null"), "it is not a regular file");
  EXPECT_EQ(folder.read("a"), "old");
  EXPECT_EQ(folder.names(), (Names{"a", "sub"}));
}

/// Runs a check in a process of its own, which may change what is common to a process.
template <typename Check>
int in_child(Check check) {
  const pid_t child = fork();
  if (child == 0) _exit(check());
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(AtomicFile, LeavesReadOnlyFilesAndFoldersAlone) {
  const test::ScratchFolder folder;
  folder.write("a", "old");
  folder.write("b", "old");
  ASSERT_EQ(chmod((folder / "a").c_str(), 0444), 0);
  ASSERT_EQ(chmod((folder / "b").c_str(), 0666), 0);
  const auto try_file = [&](const char* name) {
    return in_child([&] {
      // The administrator may write everywhere.
      if (geteuid() == 0 && setuid(65534) != 0) return 3;
      const bool is_denied = write_atomically(folder / name, "new") == "Permission denied" &&
                             find_obstacle(folder / name) == "Permission denied";
      return is_denied ? 0 : 1;
    });
  };
  ASSERT_EQ(chmod(folder.path().c_str(), 0777), 0);
  EXPECT_EQ(try_file("a"), 0);
  ASSERT_EQ(chmod(folder.path().c_str(), 0555), 0);
  EXPECT_EQ(try_file("b"), 0);
  ASSERT_EQ(chmod(folder.path().c_str(), 0755), 0);
  EXPECT_EQ(folder.read("a"), "old");
  EXPECT_EQ(folder.read("b"), "old");
  EXPECT_EQ(folder.names(), (Names{"a", "b"}));
}

/// In containers every run has the same process number, so leftovers of killed ones could take all
/// names made of it.
TEST(AtomicFile, IsNotHinderedByLeftovers) {
  const test::ScratchFolder folder;
  folder.write("a", "old");
  EXPECT_EQ(in_child([&] {
              for (int number = 0; number < 100; ++number) {
                folder.write(fmt::format(".cbc-{}-{}", getpid(), number), "");
              }
              return find_obstacle(folder / "a") || write_atomically(folder / "a", "new") ? 1 : 0;
            }),
            0);
  EXPECT_EQ(folder.read("a"), "new");
}

TEST(AtomicFile, LeavesNothingBehindWhenThereIsNoSpace) {
  const test::ScratchFolder folder;
  folder.write("a", "old");
  const auto write_too_much = [&] {
    const rlimit limit{1'000, 1'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    return write_atomically(folder / "a", std::string(5'000, 'x')) == "File too large" ? 0 : 1;
  };
  EXPECT_EQ(in_child([&] {
              std::signal(SIGXFSZ, SIG_IGN);
              return write_too_much();
            }),
            0);
  EXPECT_EQ(folder.names(), Names{"a"});
  EXPECT_EQ(folder.read("a"), "old");
  // The signal ends the program, but not before it has cleaned up.
  const int status = in_child([&] {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    return write_too_much();
  });
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
  EXPECT_EQ(folder.names(), Names{"a"});
  EXPECT_EQ(folder.read("a"), "old");
}

TEST(AtomicFile, ASignalLeavesTheOldOrTheNewFile) {
  const test::ScratchFolder folder;
  const std::string old_content(200'000, 'o');
  const std::string new_content(200'000, 'n');
  folder.write("a", old_content);
  for (int delay = 0; delay < 20; ++delay) {
    const pid_t child = fork();
    if (child == 0) {
      for (;;) (void)write_atomically(folder / "a", new_content);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500 + 777 * delay));
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
    ASSERT_EQ(folder.names(), Names{"a"});
    const std::string content = folder.read("a");
    ASSERT_TRUE(content == old_content || content == new_content);
  }
}

TEST(AtomicFile, AReaderSeesNoPart) {
  const test::ScratchFolder folder;
  folder.write("a", std::string(100'000, '0'));
  std::thread writer([&] {
    for (int round = 0; round < 50; ++round) {
      (void)write_atomically(folder / "a",
                             std::string(100'000, static_cast<char>('0' + round % 10)));
    }
  });
  for (int round = 0; round < 50; ++round) {
    const std::string content = folder.read("a");
    ASSERT_EQ(content.size(), 100'000U);
    ASSERT_EQ(std::count(content.begin(), content.end(), content[0]), 100'000);
  }
  writer.join();
}

}  // namespace
}  // namespace cbc::atomic_file_test
