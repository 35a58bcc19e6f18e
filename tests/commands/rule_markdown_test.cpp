#include <string>

#include <gtest/gtest.h>

#include "lint/report/lint_report.h"

namespace cbc::rule_markdown_test {
namespace {

Rule example_rule() {
  Rule rule{rule::dead_task, Severity::warning};
  rule.summary = "A summary.";
  rule.explanation = "Why it matters.\n\nAnd more.";
  rule.example = "tasks:\n\n- task: A\n";
  rule.mending = "Do this.";
  rule.mended = "tasks: []\n";
  return rule;
}

TEST(RuleMarkdown, FencesTheExamples) {
  EXPECT_EQ(rule_markdown(example_rule()),
            "Why it matters.\n"
            "\n"
            "And more.\n"
            "\n"
            "## Example\n"
            "\n"
            "```yaml\n"
            "tasks:\n"
            "\n"
            "- task: A\n"
            "```\n"
            "\n"
            "## How to fix it\n"
            "\n"
            "Do this.\n"
            "\n"
            "```yaml\n"
            "tasks: []\n"
            "```\n");
}

TEST(RuleMarkdown, ShowsTheCatalogOfScripts) {
  Rule rule = example_rule();
  rule.is_of_scripts = true;
  const std::string catalog(example_catalog());
  EXPECT_EQ(rule_markdown(rule), rule_markdown(example_rule()) +
                                     "\n## The catalog of these scripts\n\n```yaml\n" + catalog +
                                     "```\n");
}

}  // namespace
}  // namespace cbc::rule_markdown_test
