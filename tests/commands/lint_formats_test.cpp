// Names, messages and bytes that a format of lint must not be misled by.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic/rules.h"
#include "lint/report/lint_report.h"

namespace cbc::lint_formats_test {
namespace {

// gcc ------------------------------------------------------------------------------------------

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

// github ---------------------------------------------------------------------------------------

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

// json -----------------------------------------------------------------------------------------

using Json = nlohmann::ordered_json;

CatalogSummary example_summary() {
  CatalogSummary summary;
  summary.total.tasks = 4;
  summary.total.behaviors = 5;
  summary.total.constraints = {3, 2, 1};
  summary.groups.resize(2);
  summary.groups[0].task_names = {"HOVER", "LAND", "LOCALIZE"};
  summary.groups[0].constraints = {3, 2, 1};
  summary.groups[1].task_names = {"BLINK"};
  summary.total.search_space = "123456789012345678901234567890";
  return summary;
}

TEST(LintJson, GivesHostileNamesBack) {
  const std::string name = "\"a\\\n%,:\x1b'é日.yaml";
  CatalogSummary summary = example_summary();
  summary.groups[0].task_names[0] = name;
  const Json json = Json::parse(lint_json(
      {{name,
        "",
        {{rule::dead_task, Severity::warning, name, {}, "message of " + name, {{name, {}, name}}}},
        summary}}));
  const Json& file = json["files"][0];
  EXPECT_EQ(file["file"], name);
  EXPECT_EQ(file["diagnostics"][0]["message"], "message of " + name);
  EXPECT_EQ(file["diagnostics"][0]["related"][0]["file"], name);
  EXPECT_EQ(file["diagnostics"][0]["related"][0]["message"], name);
  EXPECT_EQ(file["summary"]["groups"][0]["tasks"][0], name);
}

TEST(LintJson, ReplacesInvalidBytes) {
  const Json json = Json::parse(
      lint_json({{"a\xff.yaml",
                  "",
                  {{rule::dead_task, Severity::warning, "a\xff.yaml", {}, "cut \xe6\x97", {}}},
                  {}}}));
  EXPECT_EQ(json["files"][0]["file"], "a\xEF\xBF\xBD.yaml");
  EXPECT_EQ(json["files"][0]["diagnostics"][0]["message"], "cut \xEF\xBF\xBD");
}

}  // namespace
}  // namespace cbc::lint_formats_test
