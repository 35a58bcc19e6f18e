// The cases lint_rule_*: one for each rule, with a file that breaks it, and no other rule, and a
// file that nearly does.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic/rules.h"
#include "golden/process.h"
#include "support/scratch_folder.h"
#include "support/sessions.h"

namespace cbc::golden::rule_cases_test {
namespace {

constexpr const char* near_miss = "nearly.yaml";

std::string case_of(const Rule& rule) {
  std::string name = "lint_rule_" + std::string(rule.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// "FILE RULE" of all findings of a report.
std::vector<std::string> findings_of(const nlohmann::json& report) {
  std::vector<std::string> findings;
  for (const nlohmann::json& file : report["files"]) {
    for (const nlohmann::json& finding : file["diagnostics"]) {
      findings.push_back(file["file"].get<std::string>() + " " +
                         finding["rule"].get<std::string>());
    }
  }
  return findings;
}

TEST(RuleCases, BreakTheirRuleOnly) {
  std::map<std::string, test::Case> cases;
  for (const test::Case& one : test::read_cases()) cases.emplace(one.name, one);
  for (const Rule& rule : all_rules()) {
    const auto found = cases.find(case_of(rule));
    ASSERT_NE(found, cases.end()) << "no case of rule " << rule.name;
    const test::ScratchFolder folder;
    test::unpack(found->second, folder.path());
    Call call{found->second.commands.front().arguments, folder.path()};
    ASSERT_EQ(std::count(call.arguments.begin(), call.arguments.end(), near_miss), 1) << rule.name;
    call.arguments.insert(call.arguments.end(), {"--format", "json"});

    const Result result = run(call);
    EXPECT_EQ(result.err, "") << rule.name;
    const nlohmann::json report = nlohmann::json::parse(result.out, nullptr, false);
    ASSERT_TRUE(report.is_object()) << rule.name << ": " << result.out;
    const std::vector<std::string> findings = findings_of(report);
    EXPECT_FALSE(findings.empty()) << rule.name;
    const std::string broken = rule.is_of_scripts ? "script.yaml" : "catalog.yaml";
    for (const std::string& finding : findings) {
      EXPECT_EQ(finding, broken + " " + std::string(rule.name));
    }
  }
}

}  // namespace
}  // namespace cbc::golden::rule_cases_test
