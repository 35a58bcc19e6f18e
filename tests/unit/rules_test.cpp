#include "core/diagnostic/rules.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/allow_comments.h"
#include "core/check/check.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "support/lines.h"
#include "support/read_file.h"
#include "unit/compiled_fixture.h"

namespace cbc::rules_test {
namespace {

using Names = std::set<std::string_view>;

const CompiledCatalog& script_catalog() {
  static const CompiledCatalog catalog = test::compile_text(example_catalog());
  return catalog;
}

void lint_script(const yaml::Document& document, Diagnostics& diagnostics) {
  static_cast<void>(read_script(document, script_catalog(), Severity::error, diagnostics));
}

/// The findings of a text, which is an example of `rule`.
std::vector<Diagnostic> findings_of(const Rule& rule, std::string_view text,
                                    const LintOptions& options = {}) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "example.yaml", diagnostics);
  bool is_complete = false;
  if (document != nullptr) {
    if (rule.is_of_scripts) {
      lint_script(*document, diagnostics);
    } else {
      const SeveritySettings settings =
          read_settings(rule.settings, ".cbc.yaml", diagnostics).value_or(SeveritySettings());
      LintOptions with_settings = options;
      with_settings.never_together = settings.never_together();
      is_complete = lint_catalog(*document, with_settings, diagnostics).compiled != nullptr;
    }
  }
  const CommentedFile file{"example.yaml", text, document.get(), is_complete};
  SeveritySettings settings;
  // It is off otherwise.
  if (rule.name == rule::returning_behavior.name) settings.set(rule, RuleSetting::note);
  return control_findings(diagnostics.release(), file, settings);
}

/// The rules that it breaks.
Names rules_found(const Rule& rule, std::string_view text, const LintOptions& options = {}) {
  Names found;
  for (const Diagnostic& finding : findings_of(rule, text, options)) found.insert(finding.rule);
  return found;
}

/// What the example of a rule is told.
std::string messages_of(const Rule& rule) {
  LintOptions options;
  if (rule.name == rule::undecided) options.max_nodes = 1;
  std::string text = "## " + std::string(rule.name) + "\n";
  for (const Diagnostic& finding : findings_of(rule, rule.example, options)) {
    text += format_place(finding.file, finding.range.begin) + ": " +
            std::string(name_of(finding.severity)) + ": " + finding.message + "\n";
    for (const Note& note : finding.notes) {
      text += "  " + format_place(note.file, note.range.begin) + ": " + note.message + "\n";
    }
  }
  return text;
}

std::vector<std::string_view> names_of_rules() {
  std::vector<std::string_view> names;
  for (const Rule& rule : all_rules()) names.push_back(rule.name);
  return names;
}

TEST(RuleTable, HasDistinctNamesInOrder) {
  const std::vector<std::string_view> names = names_of_rules();
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(RuleTable, NamesRulesAsTheCodeDoes) {
  std::vector<std::string> names;
#define CBC_ADD_NAME(name) names.emplace_back(#name);
  CBC_RULES(CBC_ADD_NAME)
#undef CBC_ADD_NAME
  for (std::string& name : names) std::replace(name.begin(), name.end(), '_', '-');
  const std::vector<std::string_view> expected = names_of_rules();
  EXPECT_EQ(names, std::vector<std::string>(expected.begin(), expected.end()));
}

TEST(RuleTable, FindsRulesByName) {
  for (const Rule& rule : all_rules()) EXPECT_EQ(find_rule(rule.name), &rule) << rule.name;
  for (const std::string_view name : {"", "a", "dead", "dead-tas", "dead-tasks", "zzz"}) {
    EXPECT_EQ(find_rule(name), nullptr) << name;
  }
}

TEST(RuleTable, FixesErrorsOnly) {
  for (const Rule& rule : all_rules()) {
    EXPECT_TRUE(!rule.is_fixed || rule.severity == Severity::error) << rule.name;
  }
}

class EveryRule : public testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] static const Rule& rule() { return *find_rule(GetParam()); }
};

bool is_kebab_case(std::string_view name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), fits) && name.front() != '-' &&
         name.back() != '-' && name.find("--") == std::string_view::npos;
}

/// What is wrong with a text of any kind; empty if nothing is.
std::string find_fault(std::string_view text) {
  if (text.empty()) return "empty";
  if (text.front() == ' ' || text.front() == '\n') return "begins with a blank";
  if (text.back() == ' ') return "ends with a blank";
  if (text.find(" \n") != std::string_view::npos) return "a line ends with a blank";
  for (const char c : text) {
    if (c != '\n' && (c < ' ' || c > '~')) return "a character that is not printable ASCII";
  }
  return {};
}

/// The same of sentences, in paragraphs that are separated by empty lines.
std::string find_fault_of_prose(std::string_view text) {
  constexpr std::string_view separator = "\n\n";
  std::string fault = find_fault(text);
  if (!fault.empty()) return fault;
  if (text.find("  ") != std::string_view::npos) return "two blanks";
  while (!text.empty()) {
    const std::string_view paragraph = text.substr(0, text.find(separator));
    if (paragraph.find('\n') != std::string_view::npos) return "a line break in a paragraph";
    const char first = paragraph.empty() ? ' ' : paragraph.front();
    if (first == ' ' || paragraph.back() != '.') return "a paragraph that is no sentence";
    text.remove_prefix(std::min(paragraph.size() + separator.size(), text.size()));
  }
  return {};
}

/// The same of examples.
std::string find_fault_of_example(std::string_view text) {
  std::string fault = find_fault(text);
  if (!fault.empty()) return fault;
  if (text.back() != '\n') return "no line break at the end";
  if (text.find("\n\n") != std::string_view::npos) return "an empty line";
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end > 76) return "a line of more than 76 characters";
    text.remove_prefix(end + 1);
  }
  return {};
}

TEST_P(EveryRule, HasTexts) {
  EXPECT_TRUE(is_kebab_case(rule().name));
  EXPECT_EQ(find_fault_of_prose(rule().summary), "");
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(rule().summary.front())));
  EXPECT_EQ(std::count(rule().summary.begin(), rule().summary.end(), '.'), 1);
  EXPECT_EQ(find_fault_of_prose(rule().explanation), "");
  EXPECT_EQ(find_fault_of_prose(rule().mending), "");
  EXPECT_EQ(find_fault_of_example(rule().example), "");
  if (!rule().settings.empty()) {
    EXPECT_EQ(find_fault_of_example(rule().settings), "");
  }
  EXPECT_EQ(find_fault_of_example(rule().mended), "");
}

TEST_P(EveryRule, SpeaksOfBehaviors) {
  for (const std::string_view text :
       {rule().summary, rule().explanation, rule().example, rule().mending, rule().mended}) {
    EXPECT_EQ(text.find("behaviour"), std::string_view::npos);
    EXPECT_EQ(text.find("Behaviour"), std::string_view::npos);
  }
}

TEST_P(EveryRule, HasAnExampleThatBreaksItAlone) {
  LintOptions options;
  if (rule().name == rule::undecided) options.max_nodes = 1;
  EXPECT_EQ(rules_found(rule(), rule().example, options), Names{rule().name});
}

TEST_P(EveryRule, HasAnExampleThatIsMended) {
  EXPECT_EQ(rules_found(rule(), rule().mended, {}), Names{});
}

TEST_P(EveryRule, IsCheckedWithoutSearchIfItNeedsNone) {
  if (rule().is_of_scripts || rule().name == rule::undecided) return;
  const bool is_found = !rules_found(rule(), rule().example, {.depth = CheckDepth::rules}).empty();
  // Of unused-allow the search decides whether a comment is used.
  EXPECT_EQ(is_found, !rule().needs_search);
}

std::string test_name(const testing::TestParamInfo<std::string_view>& info) {
  std::string name(info.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rules, EveryRule, testing::ValuesIn(names_of_rules()), test_name);

/// CBC_UPDATE_GOLDEN=1 writes the file anew; its difference is then to be read.
TEST(RuleExamples, AreToldWhatIsWrong) {
  std::string messages;
  for (const Rule& rule : all_rules()) messages += messages_of(rule) + "\n";
  const std::string path = CBC_SOURCE_DIR "/tests/golden/rules.txt";
  if (std::getenv("CBC_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << messages;
  const std::vector<std::string> found = test::lines_of(messages);
  const std::vector<std::string> expected = test::lines_of(test::read_file(path));
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    ASSERT_EQ(found[i], expected[i]) << path << ":" << i + 1;
  }
  EXPECT_EQ(found.size(), expected.size());
}

TEST(RuleExamples, AreDecidedWithTheUsualLimit) {
  const Rule& undecided = *find_rule(rule::undecided);
  EXPECT_EQ(rules_found(undecided, undecided.example), Names{});
  EXPECT_EQ(rules_found(undecided, undecided.mended, {.max_nodes = 1}), Names{});
}

TEST(RuleExamples, OfScriptsHaveAFaultlessCatalog) {
  EXPECT_EQ(find_fault_of_example(example_catalog()), "");
  EXPECT_EQ(rules_found(*find_rule(rule::dead_task), example_catalog()), Names{});
}

}  // namespace
}  // namespace cbc::rules_test
