// What settings and comments make of a catalog holds for all commands: one that lint refuses is
// neither compiled nor solved.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/rules.h"
#include "golden/compiled_files.h"

namespace cbc::golden::settings_test {
namespace {

namespace fs = std::filesystem;

class Settings : public CompiledFiles {
 protected:
  void SetUp() override { folder.write("script.yaml", "[]\n"); }

  /// Checks whether all commands take the catalog, and that nothing is left behind otherwise.
  void expect_usable(bool is_usable, const std::string& what) const {
    EXPECT_EQ(cbc({"lint", "robot.yaml"}).status, is_usable ? 0 : 1) << what;
    const Result compiled = cbc({"compile", "robot.yaml"});
    EXPECT_EQ(compiled.status, is_usable ? 0 : 2) << what << "\n" << compiled.err;
    EXPECT_EQ(fs::exists(folder / "robot.cbc"), is_usable) << what;
    fs::remove(folder / "robot.cbc");
    const Result solved = cbc({"solve", "robot.yaml", "script.yaml"});
    EXPECT_EQ(solved.status, is_usable ? 0 : 2) << what << "\n" << solved.err;
    EXPECT_EQ(solved.out.empty(), !is_usable) << what;
  }
};

/// The rules that settings can change, with examples that are catalogs. `undecided` depends on a
/// limit that only lint has.
std::vector<const Rule*> rules_of_catalogs() {
  std::vector<const Rule*> rules;
  for (const Rule& rule : all_rules()) {
    if (!rule.is_of_scripts && !rule.is_fixed && rule.name != rule::undecided.name) {
      rules.push_back(&rule);
    }
  }
  return rules;
}

TEST_F(Settings, AnErrorOfAnyRuleHoldsEverywhere) {
  for (const Rule* rule : rules_of_catalogs()) {
    const std::string name(rule->name);
    folder.write("robot.yaml", std::string(rule->example));
    const std::string others(rule->settings);
    folder.write(".cbc.yaml", others + "error: [" + name + "]\n");
    expect_usable(false, name);
    EXPECT_NE(cbc({"compile", "robot.yaml"}).err.find("error: "), std::string::npos) << name;
    EXPECT_NE(cbc({"compile", "robot.yaml"}).err.find("[" + name + "]\n"), std::string::npos);
    folder.write(".cbc.yaml", others + "allow: [" + name + "]\n");
    expect_usable(true, name);
  }
}

TEST_F(Settings, StrictOnesHoldEverywhere) {
  folder.write(".cbc.yaml", "strict: true\n");
  for (const Rule* rule : rules_of_catalogs()) {
    if (rule->severity != Severity::warning) continue;
    folder.write("robot.yaml", std::string(rule->example));
    expect_usable(false, std::string(rule->name));
  }
  folder.write("robot.yaml", std::string(rule::suspicious_suitability.example));
  const std::string message = cbc({"solve", "robot.yaml", "script.yaml"}).err;
  EXPECT_NE(message.find(" without 'strict: true' in '.cbc.yaml'\n"), std::string::npos) << message;
  folder.write("robot.yaml", std::string(rule::trivial_exclusion.example));  // a note
  expect_usable(true, "note");
  folder.write("robot.yaml", robot);
  expect_usable(true, "no findings");
}

/// A comment allows the finding for all commands, and one that allows nothing is known only if all
/// rules are checked.
TEST_F(Settings, CommentsHoldEverywhere) {
  folder.write(".cbc.yaml", "error: [requires-on-request, unused-allow]\n");
  const std::string catalog = R"(behaviors:
- behavior: PHOTOGRAPH_WITH_CAMERA
  task: PHOTOGRAPH
  requires:
  - task: HOVER%
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: PHOTOGRAPH
- {task: HOVER, execution_goal: keep_running}
)";
  const auto with = [&catalog](const std::string& comment) {
    std::string text = catalog;
    return text.replace(text.find('%'), 1, comment);
  };
  folder.write("robot.yaml", with(""));
  expect_usable(false, "no comment");
  folder.write("robot.yaml", with("  # cbc: allow requires-on-request"));
  expect_usable(true, "a comment");
  folder.write("robot.yaml", with("  # cbc: allow requires-on-request, dead-behavior"));
  expect_usable(false, "a comment that allows too much");
}

TEST_F(Settings, HoldForScripts) {
  folder.write("robot.yaml", std::string(example_catalog()));
  for (const Rule& rule : all_rules()) {
    if (!rule.is_of_scripts || rule.is_fixed) continue;
    const std::string name(rule.name);
    folder.write("script.yaml", std::string(rule.example));
    folder.write(".cbc.yaml", "error: [" + name + "]\n");
    EXPECT_EQ(cbc({"lint", "--script", "script.yaml", "robot.yaml"}).status, 1) << name;
    const Result refused = cbc({"solve", "robot.yaml", "script.yaml"});
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_EQ(refused.out, "") << name;
    folder.write(".cbc.yaml", "allow: [" + name + "]\n");
    EXPECT_EQ(cbc({"lint", "--script", "script.yaml", "robot.yaml"}).status, 0) << name;
    EXPECT_NE(cbc({"solve", "robot.yaml", "script.yaml"}).status, 2) << name;
  }
  folder.write("script.yaml", "- start: ROTATE  # cbc: allow still-available\n");
  folder.write(".cbc.yaml", "error: [unused-allow]\n");
  EXPECT_EQ(cbc({"lint", "--script", "script.yaml", "robot.yaml"}).status, 1);
  EXPECT_EQ(cbc({"solve", "robot.yaml", "script.yaml"}).status, 2);
}

TEST_F(Settings, WithoutThemNothingIsSearched) {
  // What a search would find is a warning, and solving does not wait for it.
  folder.write("robot.yaml", std::string(rule::dead_task.example));
  expect_silence(cbc({"compile", "robot.yaml"}));
  folder.write("robot.yaml", std::string(rule::conflicting_requirements.example));
  const Result result = cbc({"compile", "robot.yaml"});
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: "), std::string::npos);
  EXPECT_NE(result.err.find("[conflicting-requirements]"), std::string::npos);
}

TEST_F(Settings, HoldForCatalogsOfScriptsThatAreLinted) {
  folder.write("robot.yaml", std::string(rule::exclusive_requirement.example));
  folder.write("named.yaml", "catalog: robot.yaml\nevents: [{start: MPC_CONTROL}]\n");
  EXPECT_EQ(cbc({"lint", "named.yaml"}).status, 2);
  folder.write(".cbc.yaml", "warn: [exclusive-requirement]\n");
  EXPECT_EQ(cbc({"lint", "named.yaml"}).status, 0);
  fs::remove(folder / ".cbc.yaml");
  EXPECT_EQ(cbc({"lint", "--warn", "exclusive-requirement", "named.yaml"}).status, 0);
}

TEST_F(Settings, OlderKeysAreOnlyCounted) {
  folder.write("robot.yaml",
               "behaviors: [{behavior: PID, task: HOVER, efficacy: 90}]\n"
               "tasks: [{task: HOVER, category: recurrent, default: FALSE}]\n");
  expect_result(cbc({"compile", "robot.yaml"}), 0, "",
                "robot.yaml: warning: 3 keys have older names; see 'cbc lint', or 'cbc lint --fix' "
                "[deprecated-key]\n");
  folder.write(".cbc.yaml", "error: [deprecated-key]\n");
  const Result refused = cbc({"compile", "robot.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("error: 'efficacy' is an older name"), std::string::npos);
}

}  // namespace
}  // namespace cbc::golden::settings_test
