// Inputs that went wrong for their users, if they are at hand: what the program has to say of each.
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/shared_folder.h"

namespace cbc::golden::reported_cases_test {
namespace {

namespace fs = std::filesystem;

struct ReportedCase {
  const char* folder;
  std::vector<std::string> arguments;
  int status;
  std::vector<std::string> said;      ///< is in the output
  std::vector<std::string> not_said;  ///< is not

  // GoogleTest looks for this name.
  // NOLINTNEXTLINE(readability-identifier-naming)
  friend void PrintTo(const ReportedCase& reported, std::ostream* out) {
    *out << reported.folder;
    for (const std::string& argument : reported.arguments) *out << ' ' << argument;
  }
};

class ReportedCases : public testing::TestWithParam<ReportedCase> {};

TEST_P(ReportedCases, AreAnswered) {
  const ReportedCase& reported = GetParam();
  const fs::path folder = test::shared_folder() / "cases" / reported.folder;
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const Result result = run({reported.arguments, folder});
  const std::string all = result.out + result.err;
  EXPECT_EQ(result.status, reported.status) << all;
  for (const std::string& text : reported.said) {
    EXPECT_NE(all.find(text), std::string::npos) << text << "\n" << all;
  }
  for (const std::string& text : reported.not_said) {
    EXPECT_EQ(all.find(text), std::string::npos) << text << "\n" << all;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Case, ReportedCases,
    testing::Values(
        ReportedCase{"active-means-two-things",
                     {"verify", "robot.properties.yaml"},
                     1,
                     {"some state in which only behavior IMU_RELAY is active", "there is none"},
                     {}},
        ReportedCase{"cutsets-joint-situation",
                     {"verify", "c.yaml", "--cut-sets", "INSPECT"},
                     0,
                     {"INSPECT_CAM, INSPECT_IR\n", "INSPECT_CAM, STARS\n", "INSPECT_IR, SUN\n",
                      "STARS, SUN\n", "in every\n  situation\n"},
                     {}},
        ReportedCase{"cutsets-joint-situation",
                     {"verify", "d.yaml", "--cut-sets", "INSPECT"},
                     0,
                     {"it can never run"},
                     {"INSPECT_CAM", "STARS"}},
        ReportedCase{"cutsets-joint-situation",
                     {"verify", "d.yaml"},
                     0,
                     {"INSPECT  it can never run"},
                     {"INSPECT  INSPECT_CAM"}},
        ReportedCase{"cut-sets-mix-situations",
                     {"verify", "c.yaml", "--cut-sets", "FLY", "--order", "3"},
                     0,
                     {"FLY_A, FLY_B\n", "FLY_B, LOC_B\n", "2 sets"},
                     {"LOC_A"}},
        ReportedCase{"cut-sets-mix-situations",
                     {"verify", "d.yaml", "--cut-sets", "FLY", "--cut-sets", "SWIM"},
                     0,
                     {"  LOC_B\n", "it can never run"},
                     {"SWIM_A", "SEE_A"}},
        ReportedCase{"expect-active-no-difference",
                     {"solve", "--brief", "mission.yaml"},
                     1,
                     {"not expected: 'BEHAVIOR_17'"},
                     {"to be 'BEHAVIOR_1'"}},
        ReportedCase{"folder-skips-broken-catalogs",
                     {"lint", "."},
                     1,
                     {"first-line-tab.yaml:1:1: error", "indented.yaml:3:2: error",
                      "old-format-with-tabs.yaml:3:1: error", "utf16.yaml:1:1: error",
                      "4 files were not understood"},
                     {"no findings"}},
        ReportedCase{"never-other-variable",
                     {"verify", "p3.yaml"},
                     1,
                     {"6  violated", "7  proved", "8  proved", "9  proved", "10  proved"},
                     {}},
        ReportedCase{"never-other-variable",
                     {"verify", "p.yaml"},
                     1,
                     {"situation AIRBORNE is false", "violated after 4 events"},
                     {}},
        ReportedCase{"never-unused-variable", {"verify", "p2.yaml"}, 0, {"1 proved"}, {}},
        ReportedCase{"never-unused-variable",
                     {"coverage", "c.yaml", "m.yaml", "--prove", "--assume", "p.yaml"},
                     0,
                     {"LIGHT was night\n    no situation in which LIGHT is night can be reached"},
                     {}},
        ReportedCase{"reactive-cannot-preempt",
                     {"solve", "mission.yaml"},
                     1,
                     {"MRM starts by itself only while no task that it excludes runs on request; "
                      "DRIVE does (car.yaml:11)",
                      "10.000 s"},
                     {"no other choice"}},
        ReportedCase{"no-not-faulty",
                     {"verify", "robot.properties.yaml"},
                     2,
                     {"'faulty' must be a list of behaviors or 'none', found an empty list"},
                     {"needs a condition"}},
        ReportedCase{"request-not-resumed",
                     {"solve", "mission.yaml"},
                     1,
                     {"its request (priority 1) ended there; request it again"},
                     {}},
        ReportedCase{"request-not-resumed",
                     {"solve", "mission.yaml", "--format", "junit"},
                     1,
                     {"its request (priority 1) ended there; request it again"},
                     {}},
        ReportedCase{"request-not-resumed",
                     {"solve", "mission.yaml", "--format", "json"},
                     1,
                     {"its request (priority 1) ended there; request it again"},
                     {}},
        ReportedCase{"request-not-resumed",
                     {"solve", "mission.yaml", "--format", "github"},
                     1,
                     {"its request (priority 1) ended there; request it again"},
                     {}},
        ReportedCase{"same-as-timeouts",
                     {"verify", "new.yaml", "--same-as", "old.yaml"},
                     1,
                     {"DOCK1: timeout 5 s in old.yaml, none in new.yaml"},
                     {}},
        ReportedCase{"same-as-task-gone",
                     {"verify", "new.yaml", "--same-as", "old.yaml"},
                     1,
                     {"task LAND can be requested in old.yaml only"},
                     {}},
        ReportedCase{"same-as-task-gone",
                     {"verify", "new.yaml", "--same-as", "old.yaml", "--allow-missing"},
                     0,
                     {"decided alike"},
                     {}},
        ReportedCase{"same-as-task-gone",
                     {"verify", "renamed.yaml", "--same-as", "old2.yaml"},
                     1,
                     {"nothing was compared"},
                     {"decided alike"}},
        ReportedCase{"vacuous-never",
                     {"verify", "p.yaml"},
                     0,
                     {"'never' keeps 'FLYING' and 'HEIGHT' from ever changing",
                      "'together: [[FLYING, HEIGHT]]'", "no variable changes"},
                     {"all variables change"}},
        ReportedCase{"verify-reactive-stop",
                     {"verify", "p.yaml"},
                     1,
                     {"violated after 2 events", "stop HOVER"},
                     {}},
        ReportedCase{"violated-after-1-event-none-shown",
                     {"verify", "robot.properties.yaml"},
                     1,
                     {"0.080  GO_HOME is due, and cannot start by itself",
                      "DRIVE_HOME_AND_CHARGE does not fit: BATTERY is ok"},
                     {}},
        ReportedCase{"why-after-failover",
                     {"solve", "mission.yaml", "--why", "FLY"},
                     0,
                     {"FAST would suit FLY better (100 %, SLOW 40 %): FAST does not fit: GPS is "
                      "false"},
                     {}}));

}  // namespace
}  // namespace cbc::golden::reported_cases_test
