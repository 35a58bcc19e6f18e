#include <string>

#include <gtest/gtest.h>

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"

namespace cbc::diagnostics_test {
namespace {

Diagnostic finding(std::string file, Position place, std::string_view rule, Severity severity,
                   std::string message) {
  return {rule, severity, std::move(file), {place, place}, std::move(message), {}};
}

TEST(Diagnostics, CountsBySeverity) {
  Diagnostics diagnostics;
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.add(finding("a", {1, 1}, rule::unknown_key, Severity::warning, ""));
  diagnostics.add(finding("a", {1, 1}, rule::unknown_key, Severity::note, ""));
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.add(finding("a", {1, 1}, rule::wrong_type, Severity::error, ""));
  diagnostics.add(finding("a", {1, 1}, rule::wrong_type, Severity::error, ""));
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.count(Severity::error), 2U);
  EXPECT_EQ(diagnostics.count(Severity::warning), 1U);
  EXPECT_EQ(diagnostics.count(Severity::note), 1U);
}

TEST(Diagnostics, SortsByFileLineColumnRule) {
  Diagnostics diagnostics;
  diagnostics.add(finding("b", {1, 1}, rule::wrong_type, Severity::error, "7"));
  diagnostics.add(finding("a", {10, 1}, rule::wrong_type, Severity::error, "6"));
  diagnostics.add(finding("a", {2, 10}, rule::wrong_type, Severity::error, "5"));
  diagnostics.add(finding("a", {2, 9}, rule::wrong_type, Severity::error, "3"));
  diagnostics.add(finding("a", {2, 9}, rule::wrong_type, Severity::error, "4"));
  diagnostics.add(finding("a", {2, 9}, rule::unknown_key, Severity::warning, "2"));
  diagnostics.add(finding("a", {1, 20}, rule::wrong_type, Severity::error, "1"));
  diagnostics.sort();
  std::string order;
  for (const Diagnostic& diagnostic : diagnostics.all()) order += diagnostic.message;
  EXPECT_EQ(order, "1234567");
}

TEST(Reporter, ReportsTheSameFindingOnce) {
  Diagnostics diagnostics;
  Reporter reporter("a.yaml", diagnostics);
  const Range here{{1, 2}, {1, 3}};
  reporter.report(rule::wrong_type, here, "bad");
  reporter.report(rule::wrong_type, here, "bad");
  EXPECT_EQ(diagnostics.all().size(), 1U);
  reporter.report(rule::wrong_type, {{1, 3}, {1, 4}}, "bad");
  reporter.report(rule::wrong_type, here, "worse");
  reporter.report(rule::invalid_value, here, "bad");
  EXPECT_EQ(diagnostics.all().size(), 4U);
  EXPECT_EQ(reporter.errors(), 4U);
}

TEST(Reporter, CountsOnlyItsOwnErrors) {
  Diagnostics diagnostics;
  diagnostics.add(finding("b", {1, 1}, rule::wrong_type, Severity::error, ""));
  Reporter reporter("a.yaml", diagnostics);
  reporter.report(rule::unknown_key, {}, "strange", {reporter.note({{2, 1}, {2, 2}}, "there")});
  EXPECT_EQ(reporter.errors(), 0U);
  const Diagnostic& last = diagnostics.all().back();
  EXPECT_EQ(last.file, "a.yaml");
  EXPECT_EQ(last.severity, Severity::warning);
  ASSERT_EQ(last.notes.size(), 1U);
  EXPECT_EQ(last.notes[0].file, "a.yaml");
  EXPECT_EQ(last.notes[0].range.begin.line, 2U);
}

}  // namespace
}  // namespace cbc::diagnostics_test
