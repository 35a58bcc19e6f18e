#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lint/report/lint_report.h"

namespace cbc::lint_summary_test {
namespace {

std::string show(const CatalogSummary& summary, const std::string& name = "a.yaml") {
  return lint_summary({name, "", {}, summary}, plain_style());
}

CatalogNumbers group_of(std::vector<std::string> tasks, std::uint64_t constraints) {
  CatalogNumbers numbers;
  numbers.tasks = tasks.size();
  numbers.constraints.exclusive_pairs = constraints;
  numbers.task_names = std::move(tasks);
  return numbers;
}

/// What the table says about a search space.
std::string search_space(const std::string& digits) {
  CatalogSummary summary;
  summary.total.search_space = digits;
  const std::string text = show(summary);
  const std::string line = text.substr(text.find("search space") + 12);
  return line.substr(line.find_first_not_of(' '));
}

/// The line about a group of these tasks.
std::string group_line(std::vector<std::string> tasks) {
  CatalogSummary summary;
  summary.groups = {group_of(std::move(tasks), 7)};
  summary.total.search_space = "1";
  const std::string text = show(summary);
  const std::string_view head = "7 constraints: ";
  const std::size_t names = text.find(head) + head.size();
  return text.substr(names, text.find('\n', names) - names);
}

TEST(LintSummary, SaysThatACatalogWasNotUnderstood) {
  EXPECT_EQ(lint_summary({"a\n.yaml", "", {}, {}}, plain_style()),
            "a\\n.yaml: no summary, as the file could not be understood\n");
}

TEST(LintSummary, ShortensLargeSearchSpaces) {
  EXPECT_EQ(search_space("999999"), "999999\n");
  EXPECT_EQ(search_space("1000000"), "1000000 (~1.0e6)\n");
  EXPECT_EQ(search_space("1249999"), "1249999 (~1.2e6)\n");
  EXPECT_EQ(search_space("1250000"), "1250000 (~1.3e6)\n");
  EXPECT_EQ(search_space("9949999"), "9949999 (~9.9e6)\n");
  EXPECT_EQ(search_space("9950000"), "9950000 (~1.0e7)\n");
  EXPECT_EQ(search_space("123456789012345678901234567890"),
            "123456789012345678901234567890 (~1.2e29)\n");
  EXPECT_EQ(search_space("1234567890123456789012345678901"), "~1.2e30\n");
  EXPECT_EQ(search_space("2" + std::string(400, '0')), "~2.0e400\n");
}

TEST(LintSummary, ListsAsManyTasksAsFit) {
  const std::string ten = "0123456789";
  EXPECT_EQ(group_line({ten, ten, ten, ten, ten}),
            "0123456789, 0123456789, 0123456789, 0123456789, 0123456789");
  EXPECT_EQ(group_line({ten, ten, ten, ten, ten, ten}),
            "0123456789, 0123456789, 0123456789, 0123456789, 0123456789, ...");
  // Two columns for each character.
  const std::string wide = "日日日日日";
  EXPECT_EQ(group_line({wide, wide, wide, wide, wide, wide}),
            "日日日日日, 日日日日日, 日日日日日, 日日日日日, 日日日日日, ...");
}

TEST(LintSummary, CutsLongNames) {
  EXPECT_EQ(group_line({std::string(40, 'a')}), std::string(40, 'a'));
  const std::string shortened = std::string(18, 'a') + "..." + std::string(19, 'b');
  EXPECT_EQ(group_line({std::string(20, 'a') + std::string(21, 'b')}), shortened);
  EXPECT_EQ(group_line({std::string(50'000, 'a') + std::string(50'000, 'b'), "B", "C"}),
            shortened + ", B, C");
}

TEST(LintSummary, MakesHostileNamesHarmless) {
  EXPECT_EQ(group_line({"a\nb", "\x1b[2J", "\xff"}), "a\\nb, \\x1b[2J, \\xff");
}

TEST(LintSummary, ColorsOnRequest) {
  CatalogSummary summary;
  summary.total.search_space = "1";
  const std::string text = lint_summary({"a.yaml", "", {}, summary}, color_style());
  EXPECT_EQ(text.substr(0, text.find('\n')), "\x1b[1ma.yaml\x1b[0m");
}

}  // namespace
}  // namespace cbc::lint_summary_test
