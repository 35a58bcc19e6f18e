#include <string>

#include <gtest/gtest.h>

#include "diagnostic/rules.h"
#include "report/lint_report.h"

namespace cbc::lint_gcc_test {
namespace {

std::string lint_gcc_of(const Diagnostic& finding) {
  return lint_gcc({{finding.file, "", {finding}, {}}});
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
