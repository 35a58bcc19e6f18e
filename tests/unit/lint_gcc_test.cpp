#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/rules.h"
#include "lint/report/lint_report.h"

namespace cbc::lint_gcc_test {
namespace {

std::string lint_gcc_of(const Diagnostic& finding) {
  return lint_gcc({{finding.file, "", {finding}, {}}});
}

TEST(LintGcc, WritesFindingsAndTheirNotesOnLinesOfTheirOwn) {
  const std::vector<LintedFile> files = {
      {"a.yaml",
       "",
       {{rule::duplicate_task,
         Severity::warning,
         "a.yaml",
         {{7, 9}, {7, 14}},
         "task 'HOVER' is defined twice",
         {{"a.yaml", {{3, 9}, {3, 14}}, "first here"}, {"b.yaml", {{1, 1}, {1, 2}}, "see"}}}},
       {}},
      {"empty.yaml", "", {}, {}},
      {"c.yaml",
       "",
       {{rule::yaml_syntax, Severity::error, "c.yaml", {{1, 2}, {1, 3}}, "no YAML", {}},
        {rule::implicit_task, Severity::note, "c.yaml", {{4, 5}, {4, 6}}, "hm", {}}},
       {}}};
  EXPECT_EQ(lint_gcc(files),
            "a.yaml:7:9: warning: task 'HOVER' is defined twice [duplicate-task]\n"
            "a.yaml:3:9: note: first here\n"
            "b.yaml:1:1: note: see\n"
            "c.yaml:1:2: error: no YAML [yaml-syntax]\n"
            "c.yaml:4:5: note: hm [implicit-task]\n");
}

TEST(LintGcc, WritesNothingForNothing) {
  EXPECT_EQ(lint_gcc({}), "");
  EXPECT_EQ(lint_gcc({{"a.yaml", "tasks: []", {}, {}}}), "");
}

TEST(LintGcc, KeepsHostileNamesOnOneLine) {
  EXPECT_EQ(lint_gcc_of({rule::invalid_value,
                         Severity::error,
                         "a\n\x1b[2J%é.yaml",
                         {{1, 2}, {1, 3}},
                         "bad\r\nvalue",
                         {{"b\xff.yaml", {{3, 4}, {3, 5}}, "see\tthere"}}}),
            "a\\n\\x1b[2J%é.yaml:1:2: error: bad\\r\\nvalue [invalid-value]\n"
            "b\\xff.yaml:3:4: note: see\\tthere\n");
}

}  // namespace
}  // namespace cbc::lint_gcc_test
