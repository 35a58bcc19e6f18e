#include <string>

#include <gtest/gtest.h>

#include "diagnostic/rules.h"
#include "report/lint_report.h"

namespace cbc::lint_github_test {
namespace {

std::string lint_github_of(const Diagnostic& finding) {
  return lint_github({{finding.file, "", {finding}, {}}});
}

TEST(LintGithub, NamesFilesAsGitHubDoes) {
  const auto place_of = [](const std::string& file) {
    const std::string text =
        lint_github_of({rule::wrong_type, Severity::error, file, {{1, 1}, {1, 2}}, "x", {}});
    return text.substr(0, text.find(','));
  };
  EXPECT_EQ(place_of("./a.yaml"), "::error file=a.yaml");
  EXPECT_EQ(place_of("./b/c.yaml"), "::error file=b/c.yaml");
  EXPECT_EQ(place_of("missions/../c.yaml"), "::error file=c.yaml");
  EXPECT_EQ(place_of("b//./c.yaml"), "::error file=b/c.yaml");
  EXPECT_EQ(place_of("../c.yaml"), "::error file=../c.yaml");
  EXPECT_EQ(place_of("/r/./c.yaml"), "::error file=/r/c.yaml");
  EXPECT_EQ(place_of("<stdin>"), "::error file=<stdin>");
}

TEST(LintGithub, EscapesWhatEndsAPropertyOrTheLine) {
  // Commas and colons end a property, but not the message.
  EXPECT_EQ(lint_github_of({rule::wrong_type,
                            Severity::error,
                            "a,b:c%d\r\n'é'.yaml",
                            {{1, 1}, {1, 2}},
                            "100 %, not: '\r\n::error::x'",
                            {}}),
            "::error file=a%2Cb%3Ac%25d%0D%0A'é'.yaml,line=1,endLine=1,col=1,endColumn=2,"
            "title=cbc wrong-type::100 %25, not: '%0D%0A::error::x'\n");
}

TEST(LintGithub, MakesOtherControlCharactersHarmless) {
  EXPECT_EQ(lint_github_of({rule::wrong_type,
                            Severity::error,
                            "a\x1b[2J.yaml",
                            {{1, 1}, {1, 2}},
                            "tab\t \xff",
                            {{"b\a.yaml", {{1, 1}, {1, 2}}, "x"}}}),
            "::error file=a\\x1b[2J.yaml,line=1,endLine=1,col=1,endColumn=2,title=cbc wrong-type"
            "::tab\\t \\xff%0Ab\\x07.yaml:1:1: x\n");
}

}  // namespace
}  // namespace cbc::lint_github_test
