// The cases lint_rule_*: one for each rule, with a file that breaks it, and no other rule, and a
// file that nearly does.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/diagnostic/rules.h"
#include "golden/process.h"
#include "support/read_file.h"

namespace cbc::golden::rule_cases_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* near_miss = "nearly.yaml";

fs::path case_of(const Rule& rule) {
  std::string name = "lint_rule_" + std::string(rule.name);
  std::replace(name.begin(), name.end(), '-', '_');
  return fs::path(CBC_SOURCE_DIR) / "tests" / "golden" / "cases" / name;
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
  for (const Rule& rule : all_rules()) {
    const fs::path folder = case_of(rule);
    ASSERT_TRUE(fs::exists(folder / "command")) << "no case of rule " << rule.name;
    Call call{{}, folder};
    std::istringstream command(test::read_file(folder / "command"));
    for (std::string word; command >> word;) call.arguments.push_back(word);
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
