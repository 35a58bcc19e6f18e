// `cbc tune --write`, which changes a file in place, and its page.
#include <fstream>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::tune_test {
namespace {

constexpr const char* catalog = R"(# How well, in percent.
behaviors:
- {behavior: FAST, task: DRIVE, suitability: 90, requires: [{task: LOCALIZE}]}  # 90?
- behavior: SLOW
  task: DRIVE
  suitability:   80.50   # measured
- {behavior: SLAM, task: LOCALIZE, suitability: 70}
tasks:
- {task: LOCALIZE, start_on_request: false}
)";
constexpr const char* mission = R"(catalog: robot.yaml
events:
- start: DRIVE
- expect: {running: {DRIVE: FAST}}
)";

class Tune : public testing::Test {
 protected:
  Tune() {
    folder.write("robot.yaml", catalog);
    folder.write("drive.mission.yaml", mission);
  }

  [[nodiscard]] Result cbc(const std::vector<std::string>& arguments) const {
    return run({arguments, folder.path()});
  }
  /// The catalog with another text in place of one.
  [[nodiscard]] static std::string with(std::string text, const std::string& old_text,
                                        const std::string& new_text) {
    return text.replace(text.find(old_text), old_text.size(), new_text);
  }

  test::ScratchFolder folder;
};

TEST_F(Tune, WritesTheNumberThatChangesLeastAndNothingElse) {
  EXPECT_EQ(cbc({"solve", "drive.mission.yaml"}).status, 1);
  const Result result = cbc({"tune", "drive.mission.yaml", "--write"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(
      result.out.ends_with("robot.yaml:6: suitability of SLOW for DRIVE is now 62.9999; "
                           "all expectations hold\n"))
      << result.out;
  EXPECT_EQ(folder.read("robot.yaml"), with(catalog, "80.50", "62.9999"));
  EXPECT_EQ(cbc({"solve", "drive.mission.yaml"}).status, 0);
}

TEST_F(Tune, WritesTheNumberThatIsAskedFor) {
  EXPECT_EQ(
      cbc({"tune", "drive.mission.yaml", "--only", "SLAM:LOCALIZE", "--margin", "2", "--write"})
          .status,
      0);
  EXPECT_EQ(folder.read("robot.yaml"), with(catalog, "70", "91.4445"));
  EXPECT_EQ(cbc({"solve", "drive.mission.yaml"}).status, 0);
}

TEST_F(Tune, TakesTheMiddleWhereThereIsNoRoomForTheMargin) {
  EXPECT_EQ(cbc({"tune", "drive.mission.yaml", "--only", "SLOW:DRIVE", "--margin", "70", "--write"})
                .status,
            0);
  EXPECT_EQ(folder.read("robot.yaml"), with(catalog, "80.50", "31.4999"));
}

TEST_F(Tune, KeepsAByteOrderMarkAndLineEnds) {
  const std::string text = "\xEF\xBB\xBF" + with(catalog, "measured\n", "measured\r\n");
  folder.write("robot.yaml", text);
  EXPECT_EQ(cbc({"tune", "drive.mission.yaml", "--write"}).status, 0);
  EXPECT_EQ(folder.read("robot.yaml"), with(text, "80.50", "62.9999"));
}

TEST_F(Tune, WritesNothingWhereAllHolds) {
  folder.write("drive.mission.yaml", with(mission, "FAST", "SLOW"));
  const Result result = cbc({"tune", "drive.mission.yaml", "--write"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
}

TEST_F(Tune, WritesNothingWhereNoNumberHelps) {
  folder.write("drive.mission.yaml", with(mission, "FAST}", "SLOW, LOCALIZE: SLAM}"));
  const Result result = cbc({"tune", "drive.mission.yaml", "--write"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.out.ends_with("nothing is written: no number makes all expectations hold\n"));
  EXPECT_EQ(folder.read("robot.yaml"), catalog);
}

TEST_F(Tune, RefusesANumberThatAnAliasUses) {
  std::string text = with(catalog, "suitability: 90", "suitability: *slow");
  text = "x-slow: &slow 80\n" + with(text, "80.50", "*slow");
  folder.write("robot.yaml", text);
  const Result result = cbc({"tune", "drive.mission.yaml", "--only", "SLOW:DRIVE", "--write"});
  EXPECT_EQ(result.status, 1) << "one number for both, which cannot help";
  text = "x-slow: &slow 80\n" + with(catalog, "80.50", "*slow");
  folder.write("robot.yaml", text);
  const Result refused = cbc({"tune", "drive.mission.yaml", "--only", "SLOW:DRIVE", "--write"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "cbc: robot.yaml:1:15: this number cannot be changed: aliases give it another meaning, "
            "too; write it out there\n");
  EXPECT_EQ(folder.read("robot.yaml"), text);
}

TEST_F(Tune, KeepsATag) {
  const std::string text = with(catalog, "  80.50", "!!float 80.50");
  folder.write("robot.yaml", text);
  EXPECT_EQ(cbc({"tune", "drive.mission.yaml", "--only", "SLOW:DRIVE", "--write"}).status, 0);
  EXPECT_EQ(folder.read("robot.yaml"), with(text, "80.50", "62.9999"));
}

// The program has read the catalog when it opens the pipe with the mission.
TEST_F(Tune, RefusesAFileThatHasChangedMeanwhile) {
  const std::string pipe = folder / "mission";
  ASSERT_EQ(mkfifo(pipe.c_str(), S_IRUSR | S_IWUSR), 0);
  const std::string changed = with(catalog, "# measured", "# measured again");
  const Result result =
      run({{"tune", "robot.yaml", "mission", "--write"}, folder.path()}, [&](pid_t /*program*/) {
        std::ofstream out(pipe);
        folder.write("robot.yaml", changed);
        out << with(mission, "catalog: robot.yaml\n", "");
      });
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "cbc: 'robot.yaml' has changed in the meantime; it is not overwritten\n");
  EXPECT_EQ(folder.read("robot.yaml"), changed);
}

TEST_F(Tune, RefusesADefaultThatStandsNowhere) {
  folder.write("robot.yaml", with(catalog, "  suitability:   80.50   # measured\n", ""));
  const Result result = cbc({"tune", "drive.mission.yaml", "--only", "SLOW:DRIVE", "--write"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "cbc: --write: the default suitability stands nowhere in 'robot.yaml'; write it out "
            "there\n");
}

TEST_F(Tune, RefusesStandardInput) {
  folder.write("drive.mission.yaml", with(mission, "catalog: robot.yaml\n", ""));
  Call call{{"tune", "-", "drive.mission.yaml", "--write"}, folder.path()};
  call.standard_input = folder / "robot.yaml";
  const Result result = run(call);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "cbc: --write: standard input cannot be changed in place; give the name of the file\n");
}

TEST_F(Tune, DrawsEachNumberOnAPage) {
  folder.write("robot.yaml", with(catalog, "behavior: SLAM", "behavior: '<SLAM>'"));
  EXPECT_EQ(cbc({"tune", "drive.mission.yaml", "--html", "page.html"}).status, 1);
  const std::string page = folder.read("page.html");
  EXPECT_NE(page.find("<h3>each of these numbers alone makes all expectations hold</h3>"),
            std::string::npos);
  EXPECT_NE(page.find("suitability of &lt;SLAM&gt; for LOCALIZE"), std::string::npos);
  EXPECT_NE(page.find(R"(<rect class="same" x="0" width="89.6444" height="8"/>)"),
            std::string::npos)
      << page;
  EXPECT_NE(page.find(R"(<circle class="value" cx="70" cy="4" r="1.5"/>)"), std::string::npos);
  EXPECT_EQ(page.find("<SLAM>"), std::string::npos);
}

}  // namespace
}  // namespace cbc::golden::tune_test
