// cbc-rules(7) has the rules that 'cbc lint --explain' has. After a change of the rules this writes
// it anew:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_manual_tests
#include "core/diagnostic/rules.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "manual/page.h"
#include "support/read_file.h"

namespace cbc::manual::rules_test {
namespace {

constexpr std::string_view first_line =
    R"(.\" From here on written by a test from the table of rules, see tests/manual/rules_test.cpp.)";
constexpr std::string_view last_line = R"(.\" The end of what the test writes.)";

std::string literal(std::string_view lines) {
  std::string text = ".Bd -literal -offset indent\n";
  while (!lines.empty()) text += escape(take_until("\n", lines)) + '\n';
  return text + ".Ed\n";
}

std::string describe_severity(const Rule& rule) {
  const std::string name(name_of(rule.severity));
  const std::string article = rule.severity == Severity::error ? "An " : "A ";
  return article + name + (rule.is_fixed ? ", which settings cannot change" : "") +
         (rule.is_of_scripts ? "; in event scripts.\n" : ".\n");
}

std::string section_of(const Rule& rule) {
  std::string text = ".Ss " + escape(rule.name) + '\n';
  text += describe_severity(rule) + prose(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += ".Pp\n" + prose(take_until("\n\n", rest));
  }
  if (!rule.settings.empty()) text += ".Pp\n.Sy The settings .\n" + literal(rule.settings);
  text += ".Pp\n.Sy Example .\n" + literal(rule.example);
  text += ".Pp\n.Sy How to fix it .\n" + prose(rule.mending) + literal(rule.mended);
  return text;
}

std::string all_sections() {
  std::string text;
  for (const Rule& rule : all_rules()) text += section_of(rule);
  return text + ".Ss The catalog of the examples that are event scripts\n" +
         literal(example_catalog());
}

TEST(ManualTest, HasTheRules) { expect_part("cbc-rules.7", first_line, last_line, all_sections()); }

}  // namespace
}  // namespace cbc::manual::rules_test
