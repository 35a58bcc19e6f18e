// `cbc rename`, which writes files in place.
#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/renamed.h"
#include "support/scratch_folder.h"

namespace cbc::golden::rename_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* catalog = R"(# What DRIVE means.
behaviors:
- {behavior: WHEELS, task: DRIVE}   # DRIVE
- {behavior: DRIVE, task: "STEER"}
)";
constexpr const char* mission = R"(catalog: robot.yaml
events:
- start: 'DRIVE'
- expect: {running: {DRIVE: WHEELS}}
)";

class Rename : public testing::Test {
 protected:
  Rename() {
    folder.write("robot.yaml", catalog);
    folder.write("a.mission.yaml", mission);
  }

  [[nodiscard]] Result cbc(const std::vector<std::string>& arguments) const {
    return run({arguments, folder.path()});
  }

  test::ScratchFolder folder;
};

TEST_F(Rename, ChangesTheBytesOfTheNameAlone) {
  const Result result = cbc({"rename", "task", "DRIVE", "GO FAST", "."});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out,
            "./robot.yaml: 1 place\n"
            "./a.mission.yaml: 2 places\n"
            "task 'DRIVE' is now 'GO FAST' in 3 places of 2 files\n"
            "./robot.yaml: every reachable event is decided as before: 4 pairs of states, depth "
            "1\n");
  EXPECT_EQ(folder.read("robot.yaml"), R"(# What DRIVE means.
behaviors:
- {behavior: WHEELS, task: GO FAST}   # DRIVE
- {behavior: DRIVE, task: "STEER"}
)");
  EXPECT_EQ(folder.read("a.mission.yaml"), R"(catalog: robot.yaml
events:
- start: 'GO FAST'
- expect: {running: {GO FAST: WHEELS}}
)");
  EXPECT_EQ(cbc({"solve", "a.mission.yaml"}).status, 0);
}

TEST_F(Rename, AndBackLeavesNoTrace) {
  EXPECT_EQ(cbc({"rename", "behavior", "DRIVE", "STEERING", "."}).status, 0);
  EXPECT_NE(folder.read("robot.yaml"), catalog);
  EXPECT_EQ(cbc({"rename", "behavior", "STEERING", "DRIVE", "."}).status, 0);
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
  EXPECT_EQ(folder.read("a.mission.yaml"), mission);
}

TEST_F(Rename, ShowsADifferenceThatPatchTakes) {
  const Result shown = cbc({"rename", "--diff", "task", "DRIVE", "GO", "robot.yaml"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
  EXPECT_EQ(shown.out,
            "--- a/robot.yaml\n+++ b/robot.yaml\n@@ -1,4 +1,4 @@\n # What DRIVE means.\n"
            " behaviors:\n-- {behavior: WHEELS, task: DRIVE}   # DRIVE\n"
            "+- {behavior: WHEELS, task: GO}   # DRIVE\n - {behavior: DRIVE, task: \"STEER\"}\n");
}

TEST_F(Rename, ChangesAllFilesOrNone) {
  if (geteuid() == 0) {
    // Whom no permission stops, but a folder in place of the file would be read as one.
    folder.write("b.mission.yaml", "catalog: robot.yaml\nevents: [{start: DRIVEN}]\n");
  } else {
    folder.write("b.mission.yaml", mission);
    chmod((folder / "b.mission.yaml").c_str(), S_IRUSR);
  }
  const Result result = cbc({"rename", "task", "DRIVE", "GO", "."});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("b.mission.yaml"), std::string::npos) << result.err;
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
  EXPECT_EQ(folder.read("a.mission.yaml"), mission);
}

/// A file with two names is changed once.
TEST_F(Rename, FollowsLinks) {
  fs::create_symlink("robot.yaml", folder / "linked.yaml");
  const Result result =
      cbc({"rename", "task", "DRIVE", "GO", "linked.yaml", "robot.yaml", "a.mission.yaml"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(fs::is_symlink(folder / "linked.yaml"));
  EXPECT_NE(folder.read("robot.yaml").find("task: GO}"), std::string::npos);
}

TEST_F(Rename, ReadsNothingOutside) {
  folder.write("a.mission.yaml", "catalog: ../robot.yaml\nevents: [{start: DRIVE}]\n");
  const Result result =
      cbc({"rename", "task", "DRIVE", "GO", "robot.yaml", "/etc/hostname", "--confine", "."});
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("--confine"), std::string::npos) << result.err;
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
}

TEST_F(Rename, RefusesWhatIsNoText) {
  EXPECT_EQ(cbc({"compile", "robot.yaml"}).status, 0);
  EXPECT_EQ(cbc({"rename", "task", "DRIVE", "GO", "robot.cbc"}).err,
            "cbc: 'robot.cbc' is a compiled catalog; rename in its YAML, and compile that anew\n");
  folder.write("log.jsonl", cbc({"solve", "a.mission.yaml", "--format", "jsonl"}).out);
  EXPECT_EQ(cbc({"rename", "task", "DRIVE", "GO", "robot.yaml", "log.jsonl"}).err,
            "cbc: 'log.jsonl' is the log of a stream, which says what happened under the old "
            "name\n");
}

// The gallery: every mission gives the same before and after, whatever gets another name. ---------

constexpr const char* new_name = "QUITE_ANOTHER";

/// A folder with a catalog of catalogs/ and all that is about it.
class Copy {
 public:
  explicit Copy(const std::string& name) : name_(name) {
    const fs::path from = fs::path(CBC_SOURCE_DIR) / "catalogs";
    for (const char* const suffix : {".yaml", ".mission.yaml", ".properties.yaml"}) {
      copy(from, name + suffix);
    }
    for (const auto& entry : fs::recursive_directory_iterator(from / "tests" / name)) {
      copy(from, fs::relative(entry.path(), from));
    }
    for (const auto& entry : fs::directory_iterator(from / "missions")) {
      const std::string file = entry.path().filename();
      if (file.starts_with(name + "-")) copy(from, fs::path("missions") / file);
    }
  }

  [[nodiscard]] Result cbc(const std::vector<std::string>& arguments) const {
    return run({arguments, folder_.path()});
  }

  /// What comes of all missions, as JSON.
  [[nodiscard]] std::string outcomes() const {
    std::vector<std::string> arguments{"solve", name_ + ".yaml", name_ + ".mission.yaml", "tests"};
    if (fs::exists(folder_ / "missions")) arguments.emplace_back("missions");
    arguments.insert(arguments.end(), {"--format", "json"});
    const Result result = cbc(arguments);
    EXPECT_EQ(result.status, 0) << result.err;
    auto json = nlohmann::ordered_json::parse(result.out);
    test::drop_messages(json);
    return json.dump();
  }

  [[nodiscard]] std::map<std::string, std::string> texts() const {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) texts[entry.path()] = test::read_file(entry.path());
    }
    return texts;
  }

 private:
  void copy(const fs::path& from, const fs::path& file) {
    if (!fs::is_regular_file(from / file)) return;
    const fs::path to = fs::path(folder_.path()) / file;
    fs::create_directories(to.parent_path());
    fs::copy_file(from / file, to);
  }

  std::string name_;
  test::ScratchFolder folder_;
};

std::vector<std::string> names_of_catalogs() {
  std::vector<std::string> names;
  for (const fs::path& file : test::catalog_files(CBC_SOURCE_DIR "/catalogs")) {
    names.push_back(file.stem());
  }
  return names;
}

class RenameInGallery : public testing::TestWithParam<std::string> {};

TEST_P(RenameInGallery, LeavesAllOutcomes) {
  const Copy copy(GetParam());
  const std::string file = GetParam() + ".yaml";
  const auto dump = nlohmann::json::parse(copy.cbc({"compile", "--dump", file}).out);
  const std::string outcomes = copy.outcomes();
  const auto before = copy.texts();
  const auto& task = dump["groups"].back()["tasks"].back();
  std::vector<std::pair<std::string, std::string>> names{
      {"task", task["task"]}, {"behavior", task["behaviors"].back()["behavior"]}};
  if (!dump["variables"].empty()) {
    names.emplace_back("variable", dump["variables"].back()["variable"]);
  }
  for (const auto& [kind, name] : names) {
    const Result result = copy.cbc({"rename", kind, name, new_name, ".", "--max-states", "200"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(test::with_name(copy.outcomes(), new_name, name), outcomes);
    for (const auto& [path, text] : copy.texts()) {
      EXPECT_EQ(test::with_name(text, new_name, name), before.at(path));
    }
    EXPECT_EQ(copy.cbc({"lint", "."}).status, 0);
    ASSERT_EQ(copy.cbc({"rename", kind, new_name, name, ".", "--max-states", "200"}).status, 0);
    EXPECT_EQ(copy.texts(), before);
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogs, RenameInGallery, testing::ValuesIn(names_of_catalogs()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace cbc::golden::rename_test
