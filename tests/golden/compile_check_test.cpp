// `cbc compile --check` and `--dump`, which write nothing.
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cbc/version.h"
#include "golden/compiled_files.h"
#include "runtime/compiled/compiled_file.h"
#include "support/content_place.h"

namespace cbc::golden::compile_check_test {
namespace {

namespace fs = std::filesystem;

class CompileCheck : public CompiledFiles {};

TEST_F(CompileCheck, ChecksWithoutWriting) {
  compile_robot();
  fs::create_directory(folder / "sub");
  struct stat before {};
  ASSERT_EQ(stat((folder / "robot.cbc").c_str(), &before), 0);
  expect_silence(cbc({"compile", "--check", "robot.yaml"}));
  expect_silence(cbc({"compile", "--check", "./robot.yaml", "-o", "sub/../robot.cbc"}));
  expect_silence(cbc({"compile", "--check", folder / "robot.yaml"}));
  expect_silence(cbc_reading("robot.yaml", {"compile", "--check", "-", "-o", "robot.cbc"}));
  struct stat after {};
  ASSERT_EQ(stat((folder / "robot.cbc").c_str(), &after), 0);
  EXPECT_EQ(before.st_ino, after.st_ino);
  EXPECT_EQ(before.st_mtim.tv_nsec, after.st_mtim.tv_nsec);
}

TEST_F(CompileCheck, TellsWhyAFileIsStale) {
  folder.write("robot.yaml", robot);
  const auto expect_stale = [&](const std::string& reason) {
    const std::set<std::string> names = folder.names();
    const std::string content = folder.read("robot.cbc");
    expect_result(cbc({"compile", "--check", "robot.yaml"}), 1,
                  "'robot.cbc' is not up to date: " + reason + "\n", "");
    EXPECT_EQ(folder.names(), names);
    EXPECT_EQ(folder.read("robot.cbc"), content);
  };
  expect_stale("it does not exist");
  fs::create_symlink("nowhere", folder / "robot.cbc");
  expect_stale("it does not exist");
  fs::remove(folder / "robot.cbc");

  folder.write("robot.cbc", "");
  expect_stale("it is not a compiled catalog");
  folder.write("robot.cbc", std::string(robot) + "\n");
  expect_stale("it is not a compiled catalog");

  compile_robot();
  std::string content = folder.read("robot.cbc");
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
  folder.write("robot.cbc", content);
  expect_stale("it is damaged: its content does not match its digest");
  folder.write("robot.cbc", content.substr(0, content.size() / 2));
  EXPECT_EQ(cbc({"compile", "--check", "robot.yaml"}).status, 1);

  compile_robot();
  folder.write("robot.yaml", std::string(robot) + "# more\n");
  expect_stale("'robot.yaml' has changed since it was compiled");
}

/// Replaces a text, which is as long, in a compiled file, and makes the digest fit again.
std::string forge(std::string file, const std::string& from, const std::string& to) {
  const test::ContentPlace content = test::find_content(file);
  const std::size_t place = file.find(from, content.begin);
  EXPECT_NE(place, std::string::npos);
  file.replace(place, from.size(), to);
  test::sign_anew(file, content);
  return file;
}

TEST_F(CompileCheck, TellsThatAFileIsOfAnotherVersion) {
  compile_robot();
  const std::string now(version);
  const std::string old(now.size(), '0');
  folder.write("robot.cbc", forge(folder.read("robot.cbc"), now, old));
  expect_result(cbc({"compile", "--check", "robot.yaml"}), 1,
                "'robot.cbc' is not up to date: it was written by cbc " + old +
                    ", and this is cbc " + now + "\n",
                "");
}

TEST_F(CompileCheck, TellsThatAFileIsNotWhatItSeems) {
  compile_robot();
  folder.write("robot.cbc", forge(folder.read("robot.cbc"), "LAND_SOFTLY", "LAND_GENTLY"));
  expect_result(
      cbc({"compile", "--check", "robot.yaml"}), 1,
      "'robot.cbc' is not up to date: its bytes differ from what cbc compile would write\n", "");
}

TEST_F(CompileCheck, CannotCheckWhatIsNoFile) {
  folder.write("robot.yaml", robot);
  fs::create_directory(folder / "folder");
  expect_result(cbc({"compile", "--check", "robot.yaml", "-o", "folder"}), 2, "",
                "cbc: cannot read 'folder': Is a directory\n");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_result(cbc({"compile", "--check", "robot.yaml", "-o", "pipe"}), 2, "",
                "cbc: cannot read 'pipe': it is not a regular file\n");
}

class CompileDump : public CompiledFiles {};

TEST_F(CompileDump, ListsACompiledCatalogAsItsSource) {
  compile_robot();
  const Result compiled = cbc({"compile", "--dump", "robot.cbc"});
  EXPECT_EQ(compiled.status, 0);
  EXPECT_GT(compiled.out.size(), 100U);
  expect_result(cbc({"compile", "--dump", "robot.yaml"}), 0, compiled.out, "");
  expect_result(cbc_reading("robot.cbc", {"compile", "--dump", "-"}), 0, compiled.out, "");
  EXPECT_EQ(folder.names(), (std::set<std::string>{"robot.yaml", "robot.cbc"}));
}

TEST_F(CompileDump, ListsWhatTheFileIs) {
  compile_robot();
  const CompiledFileResult file = load_compiled(folder / "robot.cbc");
  ASSERT_TRUE(file.file);
  const nlohmann::ordered_json json =
      nlohmann::ordered_json::parse(cbc({"compile", "--dump", "robot.cbc"}).out);
  EXPECT_EQ(json["schema"], "cbc.catalog/1");
  EXPECT_EQ(json["format"], file.file->format);
  EXPECT_EQ(json["written_by"], version);
  EXPECT_EQ(json["source"],
            nlohmann::ordered_json({{"file", "robot.yaml"}, {"digest", to_hex(digest_of(robot))}}));
  EXPECT_EQ(json["content_digest"], to_hex(file.file->content));
  EXPECT_EQ(json["size"], fs::file_size(folder / "robot.cbc"));
  EXPECT_EQ(json["groups"][0]["tasks"][0]["task"], "HOVER");
}

TEST_F(CompileDump, ListsNoDamagedFile) {
  compile_robot();
  std::string content = folder.read("robot.cbc");
  content.back() = static_cast<char>(content.back() ^ 1);
  content[content.size() / 2] = static_cast<char>(content[content.size() / 2] ^ 1);
  folder.write("robot.cbc", content);
  expect_result(cbc({"compile", "--dump", "robot.cbc"}), 2, "",
                "cbc: cannot read 'robot.cbc': it is damaged: its content does not match its "
                "digest\n");
}

}  // namespace
}  // namespace cbc::golden::compile_check_test
