#include "core/report/table.h"

#include <gtest/gtest.h>

namespace cbc::table_test {
namespace {

TEST(Table, AlignsNamesAndNumbers) {
  Table table(plain_style(), {{"task"}, number_column("runs"), {"note"}});
  table.add({"HOVER", 7, "a"});
  table.add({"LAND", 12345, "b"});
  EXPECT_EQ(table.text(),
            "  task    runs  note\n"
            "  HOVER      7  a\n"
            "  LAND   12345  b\n");
}

TEST(Table, LeavesNoBlanksAtTheEndOfLines) {
  Table table(plain_style(), {{{}, {}, 10, 0}, {{}, {}, 10}});
  table.add({"a", ""});
  table.add({"b"});
  EXPECT_EQ(table.text(), "a\nb\n");
}

/// Wide characters take two columns, escape sequences none.
TEST(Table, CountsColumnsOfTheTerminal) {
  Table table(color_style(), {{}, {}});
  table.add({{"\u4E2D", color_style().bad}, "x"});
  table.add({"abc", "y"});
  EXPECT_EQ(table.text(), "  \x1b[31m\u4E2D\x1b[0m   x\n  abc  y\n");
}

TEST(Table, LetsATextRunOverEmptyCells) {
  const Table table(plain_style(), {{{}, {}, 3}, {{}, {}, 3}, {{}, {}, 3}});
  EXPECT_EQ(table.line({"long", "", "z"}), "  long      z\n");
  EXPECT_EQ(table.line({"long", "b", "z"}), "  long  b   z\n");
}

TEST(Table, PutsTheRestOfALongLineBelowItsColumn) {
  Table table(plain_style(), {{"line"}, {"words"}}, {.columns = 30});
  table.add({"12", "one two three four five six"});
  EXPECT_EQ(table.text(), "  line  words\n  12    one two three four\n        five six\n");
  Table lists(plain_style(), {{}, {}}, {.columns = 30, .breaks = Breaks::after_commas});
  lists.add({"tasks", "HOVER at once, LAND at last"});
  EXPECT_EQ(lists.text(), "  tasks  HOVER at once,\n         LAND at last\n");
}

TEST(Table, IsAlsoHtml) {
  Table table(plain_style(), {{}, number_column("n")});
  table.add({"a<b", 1});
  EXPECT_EQ(table.html("counts"),
            "<table class=\"counts\">\n<tr><td></td><th scope=\"col\">n</th></tr>\n"
            "<tr><th scope=\"row\">a&lt;b</th><td>1</td></tr>\n</table>\n");
}

}  // namespace
}  // namespace cbc::table_test
