#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/severity_settings.h"
#include "core/diagnostic/rules.h"
#include "findings.h"
#include "support/scratch_folder.h"

namespace cbc::settings_file_test {
namespace {

namespace fs = std::filesystem;

// Texts ---------------------------------------------------------------------------------------

std::string errors_of(std::string_view text) {
  Diagnostics diagnostics;
  const bool has_settings = read_settings(text, ".cbc.yaml", diagnostics).has_value();
  EXPECT_NE(has_settings, diagnostics.has_errors()) << text;
  return show(diagnostics);
}

SeveritySettings read(std::string_view text) {
  Diagnostics diagnostics;
  const std::optional<SeveritySettings> settings = read_settings(text, ".cbc.yaml", diagnostics);
  EXPECT_EQ(show(diagnostics), "");
  return settings.value_or(SeveritySettings{});
}

std::string severity(const SeveritySettings& settings, std::string_view rule,
                     Severity found = Severity::note) {
  const auto result = settings.severity_of({rule, found, "a", {}, "", {}, {}});
  return result ? std::string(name_of(*result)) : "none";
}

TEST(SettingsFile, IsRead) {
  const SeveritySettings settings = read(
      "# ours\nerror: [unknown-key, 'dead-behavior', missing-key]\nwarn:\n- exclusive-requirement\n"
      "note: [task-without-behavior]\nallow:\n  - required-goal\nstrict: TRUE\nx-own: {a: 1}\n");
  EXPECT_EQ(severity(settings, rule::unknown_key), "error");
  EXPECT_EQ(severity(settings, rule::dead_behavior), "error");
  EXPECT_EQ(severity(settings, rule::exclusive_requirement), "warning");
  EXPECT_EQ(severity(settings, rule::task_without_behavior, Severity::warning), "note");
  EXPECT_EQ(severity(settings, rule::required_goal), "none");
  EXPECT_EQ(severity(settings, rule::dead_task), "note");
  EXPECT_TRUE(settings.is_strict());
}

TEST(SettingsFile, ListsTasksThatNeverRunTogether) {
  const SeveritySettings settings =
      read("never_together:\n- [LAND, FOLLOW_PATH]\n- [HOVER, LAND, ROTATE]\n");
  ASSERT_EQ(settings.never_together().size(), 2U);
  const NeverTogether& list = settings.never_together()[1];
  EXPECT_EQ(list.file, ".cbc.yaml");
  EXPECT_EQ(show(list.range), "3:4-23");
  EXPECT_EQ(list.tasks, (std::vector<std::string>{"HOVER", "LAND", "ROTATE"}));
  EXPECT_EQ(show(list.ranges[1]), "3:11-15");
}

TEST(SettingsFile, ReportsWhatIsWrongWithListsOfTasks) {
  EXPECT_EQ(errors_of("never_together: [[LAND], [A, B, A], C, [{}, D]]\n"),
            "1:18-19 error invalid-value: a list of 'never_together' must have at least two tasks\n"
            "1:33-34 error invalid-value: task 'A' is given twice\n"
            "  1:27-28 first given here\n"
            "1:37-38 error wrong-type: 'never_together' must be a list of lists of names of tasks, "
            "found 'C'\n"
            "1:41-42 error wrong-type: 'never_together' must be a list of lists of names of tasks, "
            "found an empty mapping\n");
}

std::string unknown_names(std::string_view settings, const std::vector<std::string_view>& known) {
  Diagnostics diagnostics;
  check_never_together_names(read(settings).never_together(), known, diagnostics);
  return show(diagnostics);
}

TEST(SettingsFile, NamesTasksOfItsCatalogs) {
  const std::vector<std::string_view> known{"FOLLOW_PATH", "HOVER", "LAND"};
  EXPECT_EQ(unknown_names("never_together: [[LAND, FOLLOW_PATH]]", known), "");
  EXPECT_EQ(unknown_names("never_together: [[LAND, FOLOW_PATH]]", known),
            "1:25-35 error undefined-task: no catalog has task 'FOLOW_PATH'; did you mean "
            "'FOLLOW_PATH'?\n");
  EXPECT_EQ(unknown_names("never_together: [[LAND, DOCK]]", known),
            "1:25-29 warning undefined-task: no catalog has task 'DOCK'\n");
  // What stands beside the name cannot be meant.
  EXPECT_EQ(unknown_names("never_together: [[LAND, LNAD]]", known),
            "1:25-29 warning undefined-task: no catalog has task 'LNAD'\n");
  // These are the tasks of another catalog.
  EXPECT_EQ(unknown_names("never_together: [[DIVE, DOCK]]", known), "");
}

TEST(SettingsFile, MayBeEmpty) {
  for (const std::string_view text : {"", "\n\n", "# nothing\n", "---\n", "{}", "~", "\xEF\xBB\xBF",
                                      "error:\nwarn: ~\nallow: []\nstrict:\n", "strict: false"}) {
    const SeveritySettings settings = read(text);
    EXPECT_FALSE(settings.is_strict()) << text;
    EXPECT_EQ(severity(settings, rule::dead_task), "note") << text;
  }
}

TEST(SettingsFile, AllThatIsWrongIsReported) {
  EXPECT_EQ(errors_of("error: [ded-task, {a: 1}, '', ~]\n"
                      "warn: dead-task\n"
                      "allow: [missing-key, invalid_value]\n"
                      "strict: maybe\n"
                      "alow: [dead-task]\n"
                      "strict: 'true'\n"),
            "1:9-17 error unknown-rule: there is no rule 'ded-task'; did you mean 'dead-task'?\n"
            "1:19-20 error wrong-type: 'error' must be a list of names of rules, found a mapping\n"
            "1:27-29 error invalid-value: 'error' must be a list of names of rules, found an empty "
            "text\n"
            "1:31-32 error wrong-type: 'error' must be a list of names of rules, found nothing\n"
            "2:7-16 error wrong-type: 'warn' must be a list of names of rules, found 'dead-task'\n"
            "3:9-20 error invalid-value: 'missing-key' is always an error: a file that breaks this "
            "rule has no meaning\n"
            "3:22-35 error unknown-rule: there is no rule 'invalid_value'; did you mean "
            "'invalid-value'?\n"
            "4:9-14 error wrong-type: 'strict' must be true or false, found 'maybe'\n"
            "5:1-5 error unknown-key: unknown key 'alow' in the settings\n"
            "6:1-7 error duplicate-key: 'strict' is given twice\n"
            "  4:1-7 first given here\n");
}

TEST(SettingsFile, ARuleIsGivenOnce) {
  EXPECT_EQ(errors_of("allow: [dead-task]\nwarn: [unknown-key, unknown-key]\nerror: [dead-task]\n"),
            "2:21-32 error invalid-value: rule 'unknown-key' is given twice\n"
            "  2:8-19 first given here\n"
            "3:9-18 error invalid-value: rule 'dead-task' is given twice\n"
            "  1:9-18 first given here\n");
  EXPECT_EQ(errors_of("error: [dead-task]\nwarn: [dead-task]\nallow: [dead-task]\n"),
            "2:8-17 error invalid-value: rule 'dead-task' is given twice\n"
            "  1:9-18 first given here\n"
            "3:9-18 error invalid-value: rule 'dead-task' is given twice\n"
            "  1:9-18 first given here\n");
  EXPECT_EQ(errors_of("allow: [dead-task]\nwarn: [dead-task]\nerror: [dead-task]\n"),
            "2:8-17 error invalid-value: rule 'dead-task' is given twice\n"
            "  1:9-18 first given here\n"
            "3:9-18 error invalid-value: rule 'dead-task' is given twice\n"
            "  2:8-17 first given here\n");
}

TEST(SettingsFile, MustBeAMapping) {
  EXPECT_EQ(errors_of("- error\n"),
            "1:1-2 error wrong-type: settings must be a mapping with the keys 'error', 'warn', "
            "'note', 'allow', 'strict' and 'never_together', found a list\n");
  EXPECT_EQ(errors_of("strict"),
            "1:1-7 error wrong-type: settings must be a mapping with the keys 'error', 'warn', "
            "'note', 'allow', 'strict' and 'never_together', found 'strict'\n");
  for (const std::string_view text :
       {"error: [", "a: b: c", "\xFF", "a: 1\n---\nb: 2\n", "error: *a"}) {
    EXPECT_NE(errors_of(text).find("error yaml-syntax"), std::string::npos) << text;
  }
}

TEST(SettingsFile, ManyWrongNamesTakeNoLongTime) {
  std::string text = "allow:\n";
  for (int i = 0; i < 20'000; ++i) text += "- rule-number-" + std::to_string(i) + "\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_settings(text, ".cbc.yaml", diagnostics).has_value());
  EXPECT_EQ(diagnostics.all().size(), 20'000U);
}

// Places --------------------------------------------------------------------------------------

/// A folder of its own, which is the current one.
class SettingsPlaces : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    fs::current_path(root_);
  }

  void TearDown() override {
    fs::current_path(before_);
    std::error_code ignored;
    fs::permissions(root_ / "closed", fs::perms::owner_all, ignored);
  }

  void write(const fs::path& path) const {
    if (!path.parent_path().empty()) fs::create_directories(root_ / path.parent_path());
    std::ofstream(root_ / path) << "strict: true\n";
  }

  /// The result, relative to the folder of the test.
  [[nodiscard]] static std::string find(const std::string& file) {
    return find_settings_file(file).value_or("-");
  }

  [[nodiscard]] const fs::path& root() const { return root_; }

 private:
  test::ScratchFolder folder_;
  fs::path before_;
  fs::path root_ = fs::canonical(folder_.path());
};

TEST_F(SettingsPlaces, TheNearestUpwardCounts) {
  write(".cbc.yaml");
  write("a/.cbc.yaml");
  write("a/b/c/x.yaml");
  write("d/e/x.yaml");
  EXPECT_EQ(find("x.yaml"), ".cbc.yaml");
  EXPECT_EQ(find("./x.yaml"), ".cbc.yaml");
  EXPECT_EQ(find("a/x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find("a/b/c/x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find("d/e/x.yaml"), ".cbc.yaml");
  EXPECT_EQ(find("d/e/../../a/b/x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find("a//b/./x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find((root() / "a/b/x.yaml").string()), (root() / "a/.cbc.yaml").string());
  // Neither the file nor its folder need exist.
  EXPECT_EQ(find("a/none/none/x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find("-"), ".cbc.yaml");
  EXPECT_EQ(find(""), ".cbc.yaml");
}

TEST_F(SettingsPlaces, AboveTheCurrentFolder) {
  write(".cbc.yaml");
  write("a/b/x.yaml");
  fs::current_path(root() / "a/b");
  EXPECT_EQ(find("x.yaml"), "../../.cbc.yaml");
  EXPECT_EQ(find("../x.yaml"), "../../.cbc.yaml");
  EXPECT_EQ(find("../../x.yaml"), "../../.cbc.yaml");
}

TEST_F(SettingsPlaces, NoneMayExist) {
  write("a/x.yaml");
  write("a/b/.cbc.yaml");
  write("a/.cbc.yml");
  const std::string found = find("a/x.yaml");
  // The machine may have one above.
  EXPECT_EQ(found.find("a/"), std::string::npos) << found;
}

TEST_F(SettingsPlaces, OnlyFilesCount) {
  write(".cbc.yaml");
  fs::create_directories(root() / "a/.cbc.yaml");
  EXPECT_EQ(find("a/x.yaml"), ".cbc.yaml");
  fs::create_directories(root() / "b");
  fs::create_symlink("nowhere", root() / "b/.cbc.yaml");
  EXPECT_EQ(find("b/x.yaml"), ".cbc.yaml");
  fs::create_symlink(".cbc.yaml", root() / "a/.cbc.yaml/loop");
  fs::create_directories(root() / "c");
  fs::create_symlink("../.cbc.yaml", root() / "c/.cbc.yaml");
  EXPECT_EQ(find("c/x.yaml"), "c/.cbc.yaml");
}

TEST_F(SettingsPlaces, Links) {
  write(".cbc.yaml");
  write("a/.cbc.yaml");
  write("a/b/x.yaml");
  // Of a file: the folder of the link counts.
  fs::create_directories(root() / "c");
  fs::create_symlink("../a/b/x.yaml", root() / "c/x.yaml");
  EXPECT_EQ(find("c/x.yaml"), ".cbc.yaml");
  // Of a folder: what is above it is above where it leads to, and so is "..".
  fs::create_directory_symlink("a/b", root() / "link");
  EXPECT_EQ(find("link/x.yaml"), "a/.cbc.yaml");
  EXPECT_EQ(find("link/../x.yaml"), "a/.cbc.yaml");
  fs::create_directory_symlink("self", root() / "self");
  EXPECT_EQ(find("self/x.yaml"), ".cbc.yaml");
}

TEST_F(SettingsPlaces, FoldersThatCannotBeSearchedArePassedOver) {
  write(".cbc.yaml");
  write("closed/a/.cbc.yaml");
  fs::permissions(root() / "closed", fs::perms::none);
  const bool may_search = access((root() / "closed/a").c_str(), F_OK) == 0;  // a privileged user
  EXPECT_EQ(find("closed/a/x.yaml"), may_search ? "closed/a/.cbc.yaml" : ".cbc.yaml");
}

TEST_F(SettingsPlaces, StrangePaths) {
  write(".cbc.yaml");
  write("x.yaml");
  EXPECT_EQ(find("x.yaml/y.yaml"), ".cbc.yaml");
  EXPECT_EQ(find(std::string(5000, 'a') + "/x.yaml"), ".cbc.yaml");
  EXPECT_EQ(find("\xFF\n/x.yaml"), ".cbc.yaml");
  EXPECT_EQ(find(".cbc.yaml"), ".cbc.yaml");
  const std::string from_root = find("/x.yaml");
  EXPECT_TRUE(from_root == "-" || from_root == "/.cbc.yaml") << from_root;
}

}  // namespace
}  // namespace cbc::settings_file_test
