#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lint/report/lint_report.h"
#include "support/lines.h"

namespace cbc::rule_text_test {
namespace {

using test::lines_of;

TEST(RuleText, FillsLinesToTheLastColumn) {
  const std::string word(39, 'a');
  const std::string longer(41, 'b');
  const std::string longest(90, 'c');
  const std::string explanation = word + " " + word + "a " + word + " " + longer + " " + longest;
  Rule rule = rule::dead_task;
  rule.explanation = explanation;
  const std::vector<std::string> lines = lines_of(rule_text(rule, plain_style()));
  ASSERT_GT(lines.size(), 7U);
  EXPECT_EQ(lines[4], word + " " + word + "a");
  EXPECT_EQ(lines[4].size(), 80U);
  EXPECT_EQ(lines[5], word);
  EXPECT_EQ(lines[6], longer);
  EXPECT_EQ(lines[7], longest);
}

TEST(RuleText, StressesHeadings) {
  const std::string text = rule_text(rule::dead_task, color_style());
  EXPECT_TRUE(text.starts_with("\x1b[1mdead-task\x1b[0m (warning)\n"));
  EXPECT_NE(text.find("\x1b[1mExample:\x1b[0m\n"), std::string::npos);
}

TEST(RuleText, FitsATerminal) {
  for (const Rule& rule : all_rules()) {
    for (const std::string& line : lines_of(rule_text(rule, plain_style()))) {
      EXPECT_LE(line.size(), 80U) << rule.name << ": " << line;
      EXPECT_FALSE(line.ends_with(' ')) << rule.name << ": " << line;
    }
  }
}

}  // namespace
}  // namespace cbc::rule_text_test
