#include "core/check/severity_settings.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::severity_settings_test {
namespace {

std::string severity(const SeveritySettings& settings, std::string_view rule,
                     const Standing& found = {Severity::note}) {
  const std::optional<Severity> result = settings.severity_of(
      {rule, found.severity, "a", {}, "", {}, {}, found.is_fixed, found.is_off});
  return result ? std::string(name_of(*result)) : "none";
}

/// The messages about options, one on a line.
std::string errors_of(const SeverityOptions& options) {
  std::vector<std::string> errors;
  static_cast<void>(settings_of_options(options, errors));
  std::string text;
  for (const std::string& error : errors) text += error + "\n";
  return text;
}

SeveritySettings read(const SeverityOptions& options) {
  std::vector<std::string> errors;
  SeveritySettings settings = settings_of_options(options, errors);
  EXPECT_EQ(errors, std::vector<std::string>{});
  return settings;
}

TEST(SeveritySettings, LeaveFindingsAsTheyAre) {
  const SeveritySettings settings;
  for (const Severity found : {Severity::note, Severity::warning, Severity::error}) {
    EXPECT_EQ(severity(settings, rule::dead_task, {found}), name_of(found));
    EXPECT_EQ(severity(settings, rule::dead_task, {found, false, true}), "none");
  }
  EXPECT_FALSE(settings.is_strict());
}

TEST(SeveritySettings, ReadOptions) {
  const SeveritySettings settings = read({.error = {"dead-task", "missing-key"},
                                          .warn = {"implicit-task", "exclusive-requirement"},
                                          .note = {"dead-behavior"},
                                          .allow = {"unknown-key", "unknown-key"},
                                          .strict = true});
  EXPECT_EQ(severity(settings, rule::dead_task, {Severity::warning}), "error");
  EXPECT_EQ(severity(settings, rule::missing_key, {Severity::error}), "error");
  EXPECT_EQ(severity(settings, rule::implicit_task, {Severity::note}), "warning");
  EXPECT_EQ(severity(settings, rule::exclusive_requirement, {Severity::error}), "warning");
  EXPECT_EQ(severity(settings, rule::unknown_key, {Severity::warning}), "none");
  EXPECT_EQ(severity(settings, rule::unknown_key, {Severity::error}), "none");
  // In a script, where it is always an error, it stays one.
  EXPECT_EQ(severity(settings, rule::unknown_key, {Severity::error, true}), "error");
  EXPECT_EQ(severity(settings, rule::dead_behavior, {Severity::warning}), "note");
  EXPECT_EQ(severity(settings, rule::required_goal), "note");
  EXPECT_TRUE(settings.is_strict());
  EXPECT_FALSE(read({.error = {"dead-task"}, .warn = {}, .allow = {}}).is_strict());
}

TEST(SeveritySettings, ReportAllBadOptions) {
  EXPECT_EQ(
      errors_of({.error = {"ded-task", "dead-behavior"},
                 .warn = {"missing-key", "", "Dead_Task"},
                 .allow = {"dead-behavior", "no-such-thing"}}),
      "--error: there is no rule 'ded-task'; did you mean 'dead-task'?\n"
      "--warn: 'missing-key' is always an error: a file that breaks this rule has no meaning\n"
      "--warn: there is no rule ''\n"
      "--warn: there is no rule 'Dead_Task'; did you mean 'dead-task'?\n"
      "--allow: rule 'dead-behavior' is also given to --error\n"
      "--allow: there is no rule 'no-such-thing'\n");
}

TEST(SeveritySettings, OnlyFixedRulesCannotBeLowered) {
  for (const Rule& rule : all_rules()) {
    const std::string name(rule.name);
    EXPECT_EQ(errors_of({.error = {name}, .warn = {}, .allow = {}}), "");
    EXPECT_EQ(errors_of({.error = {}, .warn = {name}, .allow = {}}).empty(), !rule.is_fixed);
    EXPECT_EQ(errors_of({.error = {}, .warn = {}, .allow = {name}}).empty(), !rule.is_fixed);
  }
}

TEST(SeveritySettings, TheStrongerOnesWin) {
  SeveritySettings settings =
      read({.error = {"dead-task"}, .warn = {"unknown-key"}, .allow = {"implicit-task"}});
  settings.override_with(read({.error = {}, .warn = {"dead-task"}, .allow = {"unknown-key"}}));
  EXPECT_EQ(severity(settings, rule::dead_task), "warning");
  EXPECT_EQ(severity(settings, rule::unknown_key), "none");
  EXPECT_EQ(severity(settings, rule::implicit_task), "none");
  EXPECT_FALSE(settings.is_strict());

  SeveritySettings strict;
  strict.make_strict({});
  settings.override_with(strict);
  EXPECT_TRUE(settings.is_strict());
  settings.override_with(SeveritySettings{});
  EXPECT_TRUE(settings.is_strict());
  EXPECT_EQ(severity(settings, rule::dead_task), "warning");
}

TEST(SeveritySettings, TurnFindingsOn) {
  const Standing off{Severity::note, false, true};
  const std::string name(rule::required_goal.name);
  EXPECT_EQ(severity(SeveritySettings(), rule::required_goal, off), "none");
  EXPECT_EQ(severity(read({.note = {name}}), rule::required_goal, off), "note");
  EXPECT_EQ(severity(read({.warn = {name}}), rule::required_goal, off), "warning");
  EXPECT_EQ(severity(read({.error = {name}}), rule::required_goal, off), "error");
  EXPECT_EQ(severity(read({.allow = {name}}), rule::required_goal, off), "none");
}

TEST(SeveritySettings, AddFailures) {
  EXPECT_FALSE(SeveritySettings().add_failures());
  for (const Rule& rule : all_rules()) {
    const std::string name(rule.name);
    EXPECT_EQ(read({.error = {name}}).add_failures(), rule.severity != Severity::error) << name;
    if (rule.is_fixed) continue;
    EXPECT_FALSE(read({.warn = {name}}).add_failures()) << name;
  }
  EXPECT_TRUE(read({.strict = true}).add_failures());
}

TEST(SeveritySettings, NeedASearchOnlyForWhatMayFail) {
  EXPECT_FALSE(SeveritySettings().need_search());
  EXPECT_FALSE(read({.error = {"required-goal"}}).need_search());
  EXPECT_FALSE(read({.warn = {"undecided"}}).need_search());
  for (const Rule& rule : all_rules()) {
    const std::string name(rule.name);
    // There are findings of this one only if the settings say what to look for.
    const bool has_findings = rule.name != rule::can_run_together.name;
    EXPECT_EQ(read({.error = {name}}).need_search(), rule.needs_search && has_findings) << name;
  }
  EXPECT_TRUE(read({.strict = true}).need_search());
  // Strict settings under which no rule that needs a search is a warning.
  SeverityOptions options{.strict = true};
  for (const Rule& rule : all_rules()) {
    if (rule.needs_search && !rule.is_fixed) options.allow.emplace_back(rule.name);
  }
  EXPECT_FALSE(read(options).need_search());
  options.allow.pop_back();
  EXPECT_TRUE(read(options).need_search());

  SeveritySettings settings;
  settings.add_never_together({});
  EXPECT_TRUE(settings.need_search());
  EXPECT_TRUE(settings.add_failures());
}

}  // namespace
}  // namespace cbc::severity_settings_test
