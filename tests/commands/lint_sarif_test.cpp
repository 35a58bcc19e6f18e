#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cbc/version.h"
#include "core/diagnostic/rules.h"
#include "lint/report/lint_report.h"

namespace cbc::lint_sarif_test {
namespace {

using Json = nlohmann::ordered_json;

Diagnostic finding_at(std::uint32_t line, std::string message = "message",
                      std::string_view rule = rule::dead_task, std::string file = "a.yaml") {
  return {rule, Severity::warning, std::move(file), {{line, 3}, {line, 8}}, std::move(message), {}};
}

LintedFile linted(std::vector<Diagnostic> findings, std::string file = "a.yaml") {
  return {std::move(file), "", std::move(findings), {}};
}

Json run_of(const std::vector<LintedFile>& files, std::string_view directory = "/home/robot") {
  return Json::parse(lint_sarif(files, directory, true))["runs"][0];
}

std::vector<std::string> fingerprints(const std::vector<LintedFile>& files) {
  std::vector<std::string> result;
  const Json run = run_of(files);
  for (const Json& entry : run["results"]) {
    result.push_back(entry["partialFingerprints"]["cbcFinding/v1"]);
  }
  return result;
}

/// The artifactLocation of a file.
Json location_of(const std::string& file, std::string_view directory = "/home/robot") {
  const Json run = run_of({linted({finding_at(1, "m", rule::dead_task, file)}, file)}, directory);
  Json location = run["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"];
  EXPECT_EQ(run["artifacts"][0]["location"], location);
  return location;
}

Json below_root(std::string_view uri) { return {{"uri", uri}, {"uriBaseId", "%SRCROOT%"}}; }
Json absolute(std::string_view uri) { return Json::object({{"uri", uri}}); }

TEST(LintSarif, DescribesTheLogAndTheTool) {
  const Json log = Json::parse(lint_sarif({}, "/home/robot", true));
  EXPECT_EQ(log["$schema"],
            "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/"
            "sarif-schema-2.1.0.json");
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_EQ(log["runs"].size(), 1U);
  const Json& run = log["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["name"], "cbc");
  EXPECT_EQ(run["tool"]["driver"]["version"], version);
  EXPECT_EQ(run["tool"]["driver"]["semanticVersion"], version);
  EXPECT_EQ(run["columnKind"], "unicodeCodePoints");
  EXPECT_EQ(run["invocations"], Json::parse(R"([{"executionSuccessful": true}])"));
  // Empty, but there: no results would mean that there was no run.
  EXPECT_EQ(run["results"], Json::array());
  EXPECT_EQ(run["artifacts"], Json::array());
}

TEST(LintSarif, DescribesEveryRule) {
  const Json run = run_of({});
  const Json& rules = run["tool"]["driver"]["rules"];
  ASSERT_EQ(rules.size(), all_rules().size());
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const Rule& rule = all_rules()[i];
    const Json& entry = rules[i];
    EXPECT_EQ(entry["id"], rule.name);
    EXPECT_EQ(entry["shortDescription"]["text"], rule.summary);
    EXPECT_EQ(entry["fullDescription"]["text"], rule.explanation);
    EXPECT_EQ(entry["defaultConfiguration"]["level"], name_of(rule.severity));
    EXPECT_EQ(entry["help"]["text"], rule_text(rule, plain_style()));
    EXPECT_EQ(entry["help"]["markdown"], rule_markdown(rule));
  }
  const auto place = find_rule(rule::no_timeout_effect) - all_rules().data();
  EXPECT_EQ(rules[static_cast<std::size_t>(place)]["name"], "NoTimeoutEffect");
}

TEST(LintSarif, WritesAResult) {
  const Diagnostic finding = {
      rule::requirement_cycle,
      Severity::error,
      "sub/a.yaml",
      {{12, 5}, {13, 20}},
      "cycle",
      {{"sub/a.yaml", {{30, 6}, {30, 9}}, "one"}, {"/b.yaml", {{1, 2}, {3, 4}}, "two"}}};
  const Json run = run_of({linted({finding}, "sub/a.yaml")});
  ASSERT_EQ(run["results"].size(), 1U);
  Json result = run["results"][0];
  EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()]["id"],
            "requirement-cycle");
  result.erase("ruleIndex");
  result.erase("partialFingerprints");
  EXPECT_EQ(result, Json::parse(R"({
    "ruleId": "requirement-cycle",
    "level": "error",
    "message": {"text": "cycle"},
    "locations": [{"physicalLocation": {
      "artifactLocation": {"uri": "sub/a.yaml", "uriBaseId": "%SRCROOT%"},
      "region": {"startLine": 12, "startColumn": 5, "endLine": 13, "endColumn": 20}}}],
    "relatedLocations": [
      {"id": 1,
       "physicalLocation": {
         "artifactLocation": {"uri": "sub/a.yaml", "uriBaseId": "%SRCROOT%"},
         "region": {"startLine": 30, "startColumn": 6, "endLine": 30, "endColumn": 9}},
       "message": {"text": "one"}},
      {"id": 2,
       "physicalLocation": {
         "artifactLocation": {"uri": "file:///b.yaml"},
         "region": {"startLine": 1, "startColumn": 2, "endLine": 3, "endColumn": 4}},
       "message": {"text": "two"}}]})"));
}

TEST(LintSarif, NamesFilesBelowTheWorkingDirectoryRelativeToIt) {
  EXPECT_EQ(location_of("a.yaml"), below_root("a.yaml"));
  EXPECT_EQ(location_of("./b/../sub/a.yaml"), below_root("sub/a.yaml"));
  EXPECT_EQ(location_of("../robot/a.yaml"), below_root("a.yaml"));
  EXPECT_EQ(location_of("/home/robot/sub/a.yaml"), below_root("sub/a.yaml"));
  EXPECT_EQ(location_of("/home/robot/a.yaml", "/home/robot/"), below_root("a.yaml"));
  EXPECT_EQ(location_of("..a.yaml"), below_root("..a.yaml"));
  EXPECT_EQ(location_of("/a.yaml", "/"), below_root("a.yaml"));
}

TEST(LintSarif, NamesOtherFilesAbsolutely) {
  EXPECT_EQ(location_of("../a.yaml"), absolute("file:///home/a.yaml"));
  EXPECT_EQ(location_of("/tmp/a.yaml"), absolute("file:///tmp/a.yaml"));
  EXPECT_EQ(location_of("/home/robots/a.yaml"), absolute("file:///home/robots/a.yaml"));
}

TEST(LintSarif, NamesStandardInput) {
  EXPECT_EQ(location_of("<stdin>"), Json::parse(R"({"uri": "%3Cstdin%3E",
                                                    "description": {"text": "standard input"}})"));
}

TEST(LintSarif, EncodesPaths) {
  EXPECT_EQ(location_of("a b%20\"c\"\n.yaml"), below_root("a%20b%2520%22c%22%0A.yaml"));
  // A colon in the first part of a path would end a scheme.
  EXPECT_EQ(location_of("http://a,b?c#d.yaml"), below_root("http%3A/a%2Cb%3Fc%23d.yaml"));
  EXPECT_EQ(location_of("é\xff.yaml"), below_root("%C3%A9%FF.yaml"));
  EXPECT_EQ(location_of("../ü.yaml"), absolute("file:///home/%C3%BC.yaml"));
}

TEST(LintSarif, ListsEachFileOnce) {
  const Json run = run_of({linted({}), linted({}, "./a.yaml"), linted({}, "b.yaml")});
  ASSERT_EQ(run["artifacts"].size(), 2U);
  EXPECT_EQ(run["artifacts"][0]["location"]["uri"], "a.yaml");
  EXPECT_EQ(run["artifacts"][1]["location"]["uri"], "b.yaml");
}

TEST(LintSarif, KeepsHostileMessages) {
  const std::string message = "\"x\"\n\\ % \x1b é日";
  const Json run = run_of({linted({finding_at(1, message), finding_at(2, "bad \xff")})});
  EXPECT_EQ(run["results"][0]["message"]["text"], message);
  EXPECT_EQ(run["results"][1]["message"]["text"], "bad \xEF\xBF\xBD");
}

TEST(LintSarif, FingerprintsStayWhenFindingsMove) {
  const auto before = fingerprints({linted({finding_at(1, "a"), finding_at(2, "b")})});
  const auto after =
      fingerprints({linted({finding_at(5, "new"), finding_at(6, "a"), finding_at(9, "b")})});
  ASSERT_EQ(after.size(), 3U);
  EXPECT_EQ(before[0], after[1]);
  EXPECT_EQ(before[1], after[2]);
  // And from one spelling of a path to another.
  EXPECT_EQ(fingerprints({linted({finding_at(1, "a", rule::dead_task, "/home/robot/a.yaml")})})[0],
            before[0]);
}

TEST(LintSarif, FingerprintsTellFindingsApart) {
  const auto all =
      fingerprints({linted({finding_at(1, "a"), finding_at(1, "a", rule::unknown_key),
                            finding_at(1, "b"), finding_at(2, "a"), finding_at(3, "a")}),
                    linted({finding_at(1, "a", rule::dead_task, "b.yaml")}, "b.yaml")});
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 6U);
  for (const std::string& fingerprint : all) {
    EXPECT_EQ(fingerprint.size(), 16U);
    EXPECT_EQ(fingerprint.find_first_not_of("0123456789abcdef"), fingerprint.npos);
  }
}

}  // namespace
}  // namespace cbc::lint_sarif_test
