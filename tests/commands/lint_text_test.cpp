#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/rules.h"
#include "lint/report/lint_report.h"

namespace cbc::lint_text_test {
namespace {

Diagnostic finding_at(std::uint32_t line, std::string message = "old",
                      std::string_view rule = rule::deprecated_key,
                      Severity severity = Severity::warning) {
  return {rule, severity, "a.yaml", {{line, 1}, {line, 2}}, std::move(message), {}};
}

std::string plain(const std::vector<LintedFile>& files) { return lint_text(files, plain_style()); }

/// Of findings in a file whose lines are not known.
std::string plain_of(std::vector<Diagnostic> findings) {
  return plain({{"a.yaml", "", std::move(findings), {}}});
}

TEST(LintText, SaysThatThereIsNothing) {
  EXPECT_EQ(plain({}), "no findings in 0 files\n");
  EXPECT_EQ(plain({{"a.yaml", "", {}, {}}}), "no findings in 1 catalog\n");
  EXPECT_EQ(plain({{"a.yaml", "", {}, {}}, {"b.yaml", "", {}, {}}}), "no findings in 2 catalogs\n");
  using Kind = LintedFile::Kind;
  std::vector<LintedFile> files;
  for (const Kind kind : {Kind::unknown, Kind::settings, Kind::script, Kind::properties,
                          Kind::catalog, Kind::script}) {
    files.push_back({"a.yaml", "", {}, {}, kind});
  }
  EXPECT_EQ(plain(files),
            "no findings in 1 catalog, 2 scripts, 1 property file, 1 settings file; 1 file was not "
            "understood: a.yaml\n");
  EXPECT_EQ(plain({{"a.yaml", "", {}, {}, Kind::unknown}}), "no findings in 1 file\n");
}

TEST(LintText, NamesWhatWasNotUnderstood) {
  const auto list = [](const std::vector<std::string>& names) {
    return lint_text({{"a.yaml", "", {}, {}}}, plain_style(), names);
  };
  EXPECT_EQ(list({"c.yaml", "b.yaml"}),
            "no findings in 1 catalog; 2 files were not understood: b.yaml, c.yaml\n");
  EXPECT_EQ(list({"1", "2", "3", "4", "5", "6", "7", "8", "9", "a", "b"}),
            "no findings in 1 catalog; 11 files were not understood: 1, 2, 3, 4, 5, 6, 7, 8, 9 and "
            "2 more\n");
  EXPECT_EQ(lint_text({}, plain_style(), {"b.yaml"}),
            "no findings; 1 file was not understood: b.yaml\n");
}

TEST(LintText, GroupsWithinOneRuleSeverityAndFileOnly) {
  Diagnostic elsewhere = finding_at(3);
  elsewhere.file = "b.yaml";
  EXPECT_EQ(plain({{"a.yaml",
                    "",
                    {finding_at(1), finding_at(2, "old", rule::unknown_key),
                     finding_at(3, "old", rule::deprecated_key, Severity::note)},
                    {}},
                   {"b.yaml", "", {elsewhere}, {}}}),
            "a.yaml:1:1: warning: old [deprecated-key]\n"
            "a.yaml:2:1: warning: old [unknown-key]\n"
            "a.yaml:3:1: note: old [deprecated-key]\n"
            "b.yaml:3:1: warning: old [deprecated-key]\n"
            "3 warnings, 1 note in 2 catalogs\n");
}

TEST(LintText, NamesEachLineOnceAndTenAtMost) {
  std::vector<Diagnostic> findings = {finding_at(2), finding_at(2)};
  EXPECT_EQ(plain_of(findings),
            "a.yaml:2:1: warning: old [deprecated-key]\n"
            "  and 1 more like this, on line 2\n"
            "2 warnings in 1 catalog\n");
  for (std::uint32_t line = 3; line <= 11; ++line) {
    findings.push_back(finding_at(line));
    findings.push_back(finding_at(line));
  }
  EXPECT_EQ(plain_of(findings),
            "a.yaml:2:1: warning: old [deprecated-key]\n"
            "  and 19 more like this, on lines 2, 3, 4, 5, 6, 7, 8, 9, 10, 11\n"
            "20 warnings in 1 catalog\n");
  findings.push_back(finding_at(12));
  EXPECT_EQ(plain_of(findings),
            "a.yaml:2:1: warning: old [deprecated-key]\n"
            "  and 20 more like this, on lines 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, ...\n"
            "21 warnings in 1 catalog\n");
}

TEST(LintText, MakesHostileNamesHarmless) {
  EXPECT_EQ(plain({{"a\x1b]0;x\a.yaml",
                    "\x1b[2J",
                    {{rule::wrong_type,
                      Severity::error,
                      "a\x1b]0;x\a.yaml",
                      {{1, 1}, {1, 2}},
                      "new\nline \xff",
                      {{"b\n.yaml", {{1, 1}, {1, 2}}, "\x1b[31m"}}}},
                    {}}}),
            "a\\x1b]0;x\\x07.yaml:1:1: error: new\\nline \\xff [wrong-type]\n"
            "  \xEF\xBF\xBD[2J\n"
            "  ^\n"
            "b\\n.yaml:1:1: note: \\x1b[31m\n"
            "1 error in 1 catalog\n");
}

TEST(LintText, ColorsOnRequest) {
  EXPECT_EQ(lint_text({{"a.yaml", "", {finding_at(1), finding_at(2)}, {}}}, color_style()),
            "\x1b[1ma.yaml:1:1:\x1b[0m \x1b[1;35mwarning:\x1b[0m old [deprecated-key]\n"
            "\x1b[2m  and 1 more like this, on line 2\x1b[0m\n"
            "\x1b[1;35m2 warnings\x1b[0m in 1 catalog\n");
  EXPECT_EQ(lint_text({{"a.yaml", "", {}, {}}}, color_style()),
            "\x1b[32mno findings\x1b[0m in 1 catalog\n");
}

}  // namespace
}  // namespace cbc::lint_text_test
