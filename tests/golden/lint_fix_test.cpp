// `cbc lint --fix`, which writes files in place.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::lint_fix_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* before = R"(# A snow plow.
default_values:
- tasks:
  - category: recurrent     # most of them
  - automatic_activation: TRUE
behaviors:
# The standard one.
- behavior: PLOW_IN_LANES
  task: PLOW
  efficacy: 85              # in fresh snow
  requires:
  - task: LOCALIZE          # by day and night
  - task: LOCALIZE
- behavior: PLOW_BY_HEART
  task: PLOW
  suitability: 0.5          # a guess
- {behavior: GPS, task: LOCALIZE, 'efficacy': 95}
- behavior: HEATER
  task: MELT

tasks:
- task: PLOW
  category: goal_based
  automatic_activation: no
- task: LOCALIZE
- task: LOCALIZE
- {task: MELT, start_on_request: yes}
exclusivity_constraints:
- mutually_exclusive: [PLOW, MELT, PLOW]
- mutually_exclusive: [MELT, PLOW]
# the end
)";

constexpr const char* after = R"(# A snow plow.
default_values:
- tasks:
  - execution_goal: keep_running     # most of them
  - start_on_request: FALSE
behaviors:
# The standard one.
- behavior: PLOW_IN_LANES
  task: PLOW
  suitability: 85              # in fresh snow
  requires:
  - task: LOCALIZE          # by day and night
- behavior: PLOW_BY_HEART
  task: PLOW
  suitability: 0.5          # a guess
- {behavior: GPS, task: LOCALIZE, 'suitability': 95}
- behavior: HEATER
  task: MELT

tasks:
- task: PLOW
  execution_goal: achieve_goal
  start_on_request: yes
- task: LOCALIZE
- {task: MELT, start_on_request: yes}
exclusivity_constraints:
- mutually_exclusive: [PLOW, MELT]
# the end
)";

constexpr const char* small = "behaviors:\n- behavior: GPS\n  task: LOCALIZE\n  efficacy: 95\n";
constexpr const char* small_mended =
    "behaviors:\n- behavior: GPS\n  task: LOCALIZE\n  suitability: 95\n";

class LintFix : public testing::Test {
 protected:
  Result fix(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"lint", "--fix"});
    return run({std::move(arguments), folder.path()});
  }

  test::ScratchFolder folder;
};

TEST_F(LintFix, MendsInPlaceAndReportsTheRest) {
  folder.write("plow.yaml", before);
  const Result result = fix({"plow.yaml"});
  EXPECT_EQ(folder.read("plow.yaml"), after);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "cbc: plow.yaml: 10 findings fixed\n");
  EXPECT_EQ(result.out,
            "plow.yaml:15:16: warning: a suitability of 0.5 % is very low; did you mean 50 %? "
            "[suspicious-suitability]\n"
            "    suitability: 0.5          # a guess\n"
            "                 ^~~\n"
            "1 warning in 1 catalog\n");
  EXPECT_EQ(folder.names(), std::set<std::string>{"plow.yaml"});
}

TEST_F(LintFix, ChangesNothingTheSecondTime) {
  folder.write("plow.yaml", after);
  struct stat first {};
  ASSERT_EQ(stat((folder / "plow.yaml").c_str(), &first), 0);
  const Result result = fix({"plow.yaml"});
  struct stat second {};
  ASSERT_EQ(stat((folder / "plow.yaml").c_str(), &second), 0);
  EXPECT_EQ(folder.read("plow.yaml"), after);
  EXPECT_EQ(first.st_ino, second.st_ino) << "written anew";
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "cbc: none of these findings can be fixed in place\n");
}

TEST_F(LintFix, KeepsPermissionsAndLineEnds) {
  std::string text(small);
  std::string expected(small_mended);
  for (std::string* changed : {&text, &expected}) {
    for (std::size_t at = 0; (at = changed->find('\n', at)) != std::string::npos; at += 2) {
      changed->insert(at, "\r");
    }
    changed->erase(changed->size() - 2);  // the last line has no end
  }
  folder.write("gps.yaml", text);
  fs::permissions(folder / "gps.yaml", fs::perms::owner_read | fs::perms::owner_write |
                                           fs::perms::owner_exec | fs::perms::others_read);
  const fs::perms permissions = fs::status(folder / "gps.yaml").permissions();
  EXPECT_EQ(fix({"gps.yaml"}).err, "cbc: gps.yaml: 1 finding fixed\n");
  EXPECT_EQ(folder.read("gps.yaml"), expected);
  EXPECT_EQ(fs::status(folder / "gps.yaml").permissions(), permissions);
}

TEST_F(LintFix, KeepsSituations) {
  const std::string text =
      "situation:\n"
      "- {variable: LIGHT, values: [bright, dark]}   # outside\n"
      "- {variable: RAIN}\n"
      "behaviors:\n"
      "- {behavior: CAMERA, task: SEE, efficacy: 90, situation: {LIGHT: bright, RAIN: false}}\n"
      "- {behavior: RADAR, task: SEE, situation: {RAIN: true}}\n"
      "tasks:\n"
      "- task: SEE\n";
  folder.write("see.yaml", text);
  EXPECT_EQ(fix({"see.yaml"}).err, "cbc: see.yaml: 1 finding fixed\n");
  std::string expected = text;
  expected.replace(expected.find("efficacy"), 8, "suitability");
  EXPECT_EQ(folder.read("see.yaml"), expected);
}

TEST_F(LintFix, MendsWhateverTheSeverityIs) {
  folder.write("gps.yaml", small);
  const Result result = fix({"--error", "deprecated-key", "gps.yaml"});
  EXPECT_EQ(folder.read("gps.yaml"), small_mended);
  EXPECT_EQ(result.status, 0);
}

/// Of two entries with one mistake each, one goes, and its error with it.
TEST_F(LintFix, MayLeaveFewerErrors) {
  folder.write("a.yaml", R"(default_values: {tasks: {reactive_start: on}}
behaviors: [{behavior: b, task: t0}, {behavior: c, task: t1}]
tasks:
- task: t0
- task: t0
  start_on_request: true
- task: t1
)");
  const Result result = fix({"a.yaml"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "cbc: a.yaml: 1 finding fixed\n");
}

TEST_F(LintFix, MendsAllFilesOfAFolder) {
  fs::create_directory(folder / "old");
  folder.write("a.yaml", small);
  folder.write("b.yaml", small_mended);
  folder.write("old/c.yml", small);
  folder.write("script.yaml", "events: []  # efficacy: 95\n");
  const Result result = fix({"."});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "cbc: ./a.yaml: 1 finding fixed\ncbc: ./old/c.yml: 1 finding fixed\n");
  EXPECT_EQ(folder.read("a.yaml"), small_mended);
  EXPECT_EQ(folder.read("b.yaml"), small_mended);
  EXPECT_EQ(folder.read("old/c.yml"), small_mended);
  EXPECT_EQ(folder.read("script.yaml"), "events: []  # efficacy: 95\n");
}

TEST_F(LintFix, MendsWhatItCanOfACatalogWithErrors) {
  const std::string error =
      "exclusivity_constraints:\n- mutually_exclusive: [LOCALIZE, LOCALISE]\n";
  folder.write("gps.yaml", small + error);
  const Result result = fix({"gps.yaml"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "cbc: gps.yaml: 1 finding fixed\n");
  EXPECT_EQ(folder.read("gps.yaml"), small_mended + error);
}

TEST_F(LintFix, LeavesWhatIsNoYamlAlone) {
  const std::string text = std::string(small) + " tasks: [\n";
  folder.write("gps.yaml", text);
  const Result result = fix({"gps.yaml"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "cbc: none of these findings can be fixed in place\n");
  EXPECT_EQ(folder.read("gps.yaml"), text);
}

TEST_F(LintFix, LeavesWhatIsAllowedAlone) {
  const std::string comment =
      std::string(small).insert(std::string(small).size() - 1, "  # cbc: allow deprecated-key");
  folder.write("comment.yaml", comment);
  folder.write("option.yaml", small);
  fs::create_directory(folder / "settings");
  folder.write("settings/.cbc.yaml", "allow: [deprecated-key]\n");
  folder.write("settings/gps.yaml", small);
  EXPECT_EQ(fix({"comment.yaml", "settings"}).err, "");
  EXPECT_EQ(fix({"--allow", "deprecated-key", "option.yaml"}).err, "");
  EXPECT_EQ(folder.read("comment.yaml"), comment);
  EXPECT_EQ(folder.read("option.yaml"), small);
  EXPECT_EQ(folder.read("settings/gps.yaml"), small);
}

TEST_F(LintFix, ReportsAsJsonWhatIsLeft) {
  folder.write("plow.yaml", before);
  const Result result = fix({"--format", "json", "plow.yaml"});
  const auto report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["warnings"], 1);
  EXPECT_EQ(report["files"][0]["diagnostics"][0]["line"], 15);
  EXPECT_EQ(folder.read("plow.yaml"), after);
}

TEST_F(LintFix, WritesNothingWithDiff) {
  folder.write("plow.yaml", before);
  const Result result = fix({"--diff", "plow.yaml"});
  EXPECT_EQ(result.out.substr(0, 34), "--- a/plow.yaml\n+++ b/plow.yaml\n@@");
  EXPECT_EQ(folder.read("plow.yaml"), before);
}

TEST_F(LintFix, SaysWhatItCouldNotWrite) {
  folder.write("gps.yaml", small);
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const bool is_writable = std::ofstream(folder / "new").is_open();
  const Result result = is_writable ? Result() : fix({"gps.yaml"});
  fs::permissions(folder.path(), fs::perms::owner_all);
  if (is_writable) GTEST_SKIP() << "nothing is read-only for this user";
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "cbc: cannot write 'gps.yaml': Permission denied\n");
  EXPECT_EQ(folder.read("gps.yaml"), small);
}

}  // namespace
}  // namespace cbc::golden::lint_fix_test
