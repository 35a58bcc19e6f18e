#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lint/report/lint_report.h"
#include "support/lines.h"

namespace cbc::rule_text_test {
namespace {

using test::lines_of;

constexpr Rule made_up{
    .name = "too-blue",
    .severity = Severity::note,
    .summary = "A wall is blue.",
    .explanation =
        "A blue wall is hard to see against the sky, and so the robot may fly into it. The color "
        "is measured.\n\n"
        "Green is allowed.",
    .example = "walls:\n- blue\n",
    .mending = "Paint it.",
    .mended = "walls:\n- green\n"};

TEST(RuleText, SaysAllAboutARule) {
  EXPECT_EQ(rule_text(made_up, plain_style()),
            "too-blue (note)\n"
            "\n"
            "A wall is blue.\n"
            "\n"
            "A blue wall is hard to see against the sky, and so the robot may fly into it.\n"
            "The color is measured.\n"
            "\n"
            "Green is allowed.\n"
            "\n"
            "Example:\n"
            "\n"
            "    walls:\n"
            "    - blue\n"
            "\n"
            "How to fix it:\n"
            "\n"
            "Paint it.\n"
            "\n"
            "Fixed:\n"
            "\n"
            "    walls:\n"
            "    - green\n");
}

TEST(RuleText, FillsLinesToTheLastColumn) {
  const std::string word(39, 'a');
  const std::string longer(41, 'b');
  const std::string longest(90, 'c');
  const std::string explanation = word + " " + word + "a " + word + " " + longer + " " + longest;
  Rule rule = made_up;
  rule.explanation = explanation;
  const std::vector<std::string> lines = lines_of(rule_text(rule, plain_style()));
  ASSERT_GT(lines.size(), 7U);
  EXPECT_EQ(lines[4], word + " " + word + "a");
  EXPECT_EQ(lines[4].size(), 80U);
  EXPECT_EQ(lines[5], word);
  EXPECT_EQ(lines[6], longer);
  EXPECT_EQ(lines[7], longest);
}

TEST(RuleText, SaysThatASeverityIsFixed) {
  Rule rule = made_up;
  rule.severity = Severity::error;
  rule.is_fixed = true;
  EXPECT_EQ(lines_of(rule_text(rule, plain_style())).front(),
            "too-blue (error; settings cannot change it)");
}

TEST(RuleText, GivesTheCatalogOfAScript) {
  Rule rule = made_up;
  rule.is_of_scripts = true;
  const std::string text = rule_text(rule, plain_style());
  const std::vector<std::string> lines = lines_of(text);
  EXPECT_NE(std::find(lines.begin(), lines.end(), "Example, a script for the catalog below:"),
            lines.end());
  auto line = std::find(lines.begin(), lines.end(), "The catalog:");
  ASSERT_NE(line, lines.end());
  ++line;
  EXPECT_EQ(*line, "");
  std::string catalog;
  for (++line; line != lines.end(); ++line) {
    EXPECT_EQ(line->substr(0, 4), "    ");
    catalog += line->substr(4) + "\n";
  }
  EXPECT_EQ(catalog, example_catalog());
}

TEST(RuleText, StressesHeadings) {
  EXPECT_EQ(rule_text(made_up, color_style()).substr(0, 24), "\x1b[1mtoo-blue\x1b[0m (note)\n");
  EXPECT_NE(rule_text(made_up, color_style()).find("\x1b[1mExample:\x1b[0m\n"), std::string::npos);
}

TEST(RuleText, SaysIfTheRuleIsOff) {
  Rule rule = rule::dead_task;
  EXPECT_TRUE(rule_text(rule, plain_style()).starts_with("dead-task (warning)\n"));
  rule.is_off = true;
  EXPECT_TRUE(rule_text(rule, plain_style())
                  .starts_with("dead-task (warning; off unless settings ask for it)\n"));
}

TEST(RuleText, FitsATerminal) {
  for (const Rule& rule : all_rules()) {
    for (const std::string& line : lines_of(rule_text(rule, plain_style()))) {
      EXPECT_LE(line.size(), 80U) << rule.name << ": " << line;
      EXPECT_FALSE(line.ends_with(' ')) << rule.name << ": " << line;
    }
  }
}

TEST(RuleList, HasALineForEachRule) {
  const std::vector<std::string> lines = lines_of(rule_list(plain_style()));
  EXPECT_EQ(lines.size(), all_rules().size());
  for (const Rule& rule : all_rules()) {
    const auto line = std::find_if(lines.begin(), lines.end(), [&rule](const std::string& text) {
      return text.starts_with(std::string(rule.name) + " ");
    });
    ASSERT_NE(line, lines.end()) << rule.name;
    // The longest name, conflicting-requirements, has 24 characters.
    const std::string_view severity = rule.is_off ? "off" : name_of(rule.severity);
    EXPECT_EQ(line->find(severity, rule.name.size()), 26U) << *line;
    EXPECT_EQ(line->substr(35), rule.summary);
  }
}

TEST(RuleList, BeginsWithTheErrors) {
  std::vector<int> ranks;
  std::vector<std::string> names;
  for (const std::string& line : lines_of(rule_list(plain_style()))) {
    names.push_back(line.substr(0, line.find(' ')));
    const Rule* rule = find_rule(names.back());
    ASSERT_NE(rule, nullptr) << line;
    ranks.push_back(-static_cast<int>(rule->severity));
  }
  EXPECT_EQ(names.front(), "can-run-together");
  EXPECT_TRUE(std::is_sorted(ranks.begin(), ranks.end()));
  for (std::size_t i = 1; i < names.size(); ++i) {
    EXPECT_TRUE(ranks[i - 1] < ranks[i] || names[i - 1] < names[i]) << names[i];
  }
}

}  // namespace
}  // namespace cbc::rule_text_test
