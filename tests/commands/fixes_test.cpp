#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/diagnostic/rules.h"

namespace cbc::fixes_test {
namespace {

std::vector<Diagnostic> findings_of(std::string_view text) {
  Diagnostics diagnostics;
  if (const auto document = yaml::parse(text, "a.yaml", diagnostics)) {
    (void)lint_catalog(*document, {}, diagnostics);
  }
  diagnostics.sort();
  return diagnostics.release();
}

std::string fix(std::string_view text) { return apply_fixes(text, findings_of(text)).text; }

/// The findings of a rule that were not mended, by line.
std::string left(std::string_view text, std::string_view rule) {
  const std::vector<Diagnostic> findings = findings_of(text);
  const FixedText fixed = apply_fixes(text, findings);
  std::string lines;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const bool is_mended =
        std::find(fixed.mended.begin(), fixed.mended.end(), i) != fixed.mended.end();
    if (findings[i].rule != rule || is_mended) continue;
    lines += std::to_string(findings[i].range.begin.line) + " ";
  }
  return lines;
}

/// Expects that nothing of a text is changed.
void expect_unchanged(std::string_view text) { EXPECT_EQ(fix(text), text); }

/// A catalog whose behaviors perform the tasks that the others name.
std::string with_behaviors(const std::string& text) {
  return text +
         "behaviors: [{behavior: a, task: A}, {behavior: b, task: B}, {behavior: c, task: C}]\n";
}

TEST(FixOlderKeys, WithoutAValue) {
  EXPECT_EQ(fix("behaviors: []\ntasks: [{task: A, category: , default: ~,"
                " automatic_activation: null}]\n"),
            "behaviors: []\ntasks: [{task: A, execution_goal: , reactive_start: ~,"
            " start_on_request: null}]\n");
  // Under the present name it would be given twice.
  expect_unchanged("behaviors: [{behavior: a, task: A, efficacy: ~, suitability: 3}]\n");
  expect_unchanged("behaviors: [{behavior: a, task: A, efficacy: 3, suitability: ~}]\n");
  expect_unchanged("behaviors: [{behavior: a, task: A, efficacy: 3, suitability: 4}]\n");
  expect_unchanged("behaviors: [{behavior: a, task: A, efficacy: 3, efficacy: ~}]\n");
}

TEST(FixOlderKeys, NotWhereTheValueIsNotValid) {
  expect_unchanged("behaviors: []\ntasks: [{task: A, category: goalbased}]\n");
  expect_unchanged("behaviors: []\ntasks: [{task: A, automatic_activation: 1}]\n");
  expect_unchanged("behaviors: []\ntasks: [{task: A, automatic_activation: 'no'}]\n");
  expect_unchanged("behaviors: []\ntasks: [{task: A, automatic_activation: [no]}]\n");
}

TEST(FixOlderKeys, NotWhereItIsNotWrittenAsItIs) {
  expect_unchanged("behaviors: [{behavior: a, task: A, \"effic\\x61cy\": 3}]\n");
  expect_unchanged("behaviors:\n- behavior: a\n  task: A\n  ? !!str efficacy\n  : 3\n");
  expect_unchanged("behaviors:\n- behavior: a\n  task: A\n  ? |-\n    efficacy\n  : 3\n");
  expect_unchanged("behaviors: []\ntasks: [{task: A, category: \"recurren\\x74\"}]\n");
  expect_unchanged("behaviors: []\ntasks: [{task: A, category: !!str recurrent}]\n");
  expect_unchanged("behaviors: []\ntasks:\n- task: A\n  category: >-\n    recurrent\n");
}

TEST(FixOlderKeys, NotWhereAliasesGiveThemOtherMeanings) {
  // The value of another key, too.
  expect_unchanged(
      "behaviors: []\n"
      "tasks: [{task: A, automatic_activation: &x no, reactive_start: *x}]\n");
  expect_unchanged(
      "behaviors: []\n"
      "tasks: [{task: A, reactive_start: &x no, automatic_activation: *x}]\n");
  // A value that does not change may be anywhere.
  EXPECT_EQ(fix("behaviors: [{behavior: a, task: A, timeout: &x 3, efficacy: *x}]\n"),
            "behaviors: [{behavior: a, task: A, timeout: &x 3, suitability: *x}]\n");
  // The key is also a name.
  expect_unchanged(
      "behaviors: [{behavior: a, task: A, &k efficacy: 3},"
      " {behavior: *k, task: A}]\n");
  // The merged key is hidden by the one that would be renamed.
  expect_unchanged(
      "x-base: &b {efficacy: 3}\n"
      "behaviors: [{behavior: a, task: A, efficacy: 4, <<: *b}]\n");
  expect_unchanged(
      "behaviors: [&b {behavior: a, task: A, efficacy: 4},"
      " {<<: *b, behavior: b}]\n");
  // An anchor that no alias names does no harm.
  EXPECT_EQ(fix("behaviors: []\ntasks: [{task: A, automatic_activation: &x no}]\n"),
            "behaviors: []\ntasks: [{task: A, start_on_request: &x yes}]\n");
}

TEST(FixDuplicateTask, TheLaterEntryGoes) {
  EXPECT_EQ(fix(with_behaviors("tasks:\n"
                               "- task: A\n"
                               "  timeout: 15\n"
                               "\n"
                               "# the second\n"
                               "- timeout: 15.0\n"
                               "  task: A\n"
                               "  parameters: []\n"
                               "\n"
                               "# the third\n"
                               "- task: B\n")),
            with_behaviors("tasks:\n"
                           "- task: A\n"
                           "  timeout: 15\n"
                           "\n"
                           "# the second\n"
                           "\n"
                           "# the third\n"
                           "- task: B\n"));
}

TEST(FixDuplicateTask, TheLastOfTheList) {
  EXPECT_EQ(
      fix(with_behaviors("tasks:\n  - task: A\n  - task: B\n  - task: A\n    timeout: ~\n\n")),
      with_behaviors("tasks:\n  - task: A\n  - task: B\n\n"));
  // And of the file, with the line break before it.
  EXPECT_EQ(fix(with_behaviors("") + "tasks:\n- task: A\n- task: A"),
            with_behaviors("") + "tasks:\n- task: A");
  EXPECT_EQ(fix(with_behaviors("") + "tasks:\r\n- task: A\r\n- task: A\r\n- task: B\r\n- task: B"),
            with_behaviors("") + "tasks:\r\n- task: A\r\n- task: B");
}

TEST(FixDuplicateTask, NotInBrackets) {
  expect_unchanged(with_behaviors("tasks: [{task: A}, {task: B}, {task: A}]\n"));
}

TEST(FixDuplicateTask, OfThreeEntriesThoseThatChangeNothing) {
  EXPECT_EQ(fix(with_behaviors("tasks:\n- task: A\n- task: A\n- task: A\n  timeout: 3\n")),
            with_behaviors("tasks:\n- task: A\n- task: A\n  timeout: 3\n"));
  EXPECT_EQ(fix(with_behaviors("tasks:\n- task: A\n- {task: A, timeout: 3}\n"
                               "- task: A\n  timeout: 3\n")),
            with_behaviors("tasks:\n- task: A\n- {task: A, timeout: 3}\n"));
  EXPECT_EQ(fix(with_behaviors("tasks:\n- task: A\n- task: A\n- task: A\n- task: B\n")),
            with_behaviors("tasks:\n- task: A\n- task: B\n"));
  expect_unchanged(with_behaviors("tasks:\n- task: A\n- task: A\n  timeout: 3\n- task: A\n"));
}

TEST(FixDuplicateTask, WhatStandsInTheEntryIsMendedWithIt) {
  const std::string text = with_behaviors(
      "tasks:\n- task: A\n  execution_goal: keep_running\n"
      "- category: recurrent\n  task: A\n- task: B\n");
  EXPECT_EQ(fix(text),
            with_behaviors("tasks:\n- task: A\n  execution_goal: keep_running\n- task: B\n"));
  EXPECT_EQ(left(text, rule::deprecated_key), "");
  EXPECT_EQ(left(text, rule::duplicate_task), "");
}

TEST(FixDuplicateTask, NotWhereSomethingElseWouldGo) {
  for (const std::string tasks : {
           "tasks:\n- task: A\n- task: A  # a comment\n",
           "tasks:\n- task: A\n- # a comment\n  task: A\n",
           "tasks:\n- task: A\n- task: A\n# a comment\n  timeout: ~\n",
           "tasks: [{task: A}, # a comment\n  {task: A}]\n",
           "tasks: [{task: A}, {task: A} # a comment\n]\n",
           "tasks:\n- task: A\n- task: A\n  x-note: mine\n",
           "tasks:\n- task: A\n- task: A\n  timeuot: 3\n",
           // A tag is not worth the trouble.
           "tasks:\n- task: A\n- !!map {task: A}\n",
           "tasks: [{task: A}, !!map {task: A}]\n",
           "tasks:\n- task: A\n-\n  task: A\n",
           // Lines that are not indented.
           "tasks:\n- task: A\n- {\ntask: A}\n",
           "tasks:\n- task: A\n- {task: A\n}\n",
           "tasks:\n- {task: A}\n- {task: 'A',\n\n}\n",
       }) {
    const std::string text = with_behaviors(tasks);
    EXPECT_EQ(fix(text), text);
    EXPECT_NE(left(text, rule::duplicate_task), "") << text;
  }
}

TEST(FixDuplicateTask, NotWhereAControlCommentWouldMoveToTheNextEntry) {
  const auto with_comment = [](const std::string& comment) {
    return with_behaviors("tasks:\n- task: A\n" + comment + "- task: A\n- task: B\n");
  };
  expect_unchanged(with_comment("# cbc: allow required-goal\n"));
  expect_unchanged(with_comment("# cbc: allow required-goal\n\n  # because\n"));
  EXPECT_EQ(fix(with_comment("# because\n")),
            with_behaviors("tasks:\n- task: A\n# because\n- task: B\n"));
}

TEST(FixDuplicateTask, NotWhereAliasesNameIt) {
  for (const std::string tasks : {
           "tasks:\n- &a {task: A}\n- *a\n",
           "tasks: [&a {task: A}, *a]\n",
           "tasks:\n- task: A\n- task: A\n  timeout: &t ~\n- task: B\n  timeout: *t\n",
           "x-tasks: &t\n- task: A\n- task: A\ntasks: *t\n",
       }) {
    const std::string text = with_behaviors(tasks);
    EXPECT_EQ(fix(text), text);
    EXPECT_NE(left(text, rule::duplicate_task), "") << text;
  }
  // An alias may go.
  EXPECT_EQ(fix(with_behaviors("tasks:\n- task: &a A\n- task: *a\n- task: B\n")),
            with_behaviors("tasks:\n- task: &a A\n- task: B\n"));
}

TEST(FixDuplicateTask, NotWhereTheEntryHasAnError) {
  expect_unchanged(with_behaviors("tasks:\n- task: A\n- task: A\n  timeout: -1\n"));
}

TEST(FixDuplicateParameter, WithTheSameValuesOnly) {
  EXPECT_EQ(fix(with_behaviors("tasks:\n- task: A\n  parameters:\n"
                               "  - parameter: p\n    allowed_values: [1, 2]\n"
                               "  - parameter: p\n    allowed_values:\n    - 1\n    - 2\n"
                               "  - parameter: q\n- task: B\n")),
            with_behaviors("tasks:\n- task: A\n  parameters:\n"
                           "  - parameter: p\n    allowed_values: [1, 2]\n"
                           "  - parameter: q\n- task: B\n"));
  expect_unchanged(
      with_behaviors("tasks:\n- task: A\n  parameters:\n"
                     "  - {parameter: p, allowed_values: [1, 2]}\n"
                     "  - {parameter: p, allowed_values: [1, 3]}\n"
                     "  - {parameter: p, allowed_values: [1, 2]}\n"));
  expect_unchanged(
      with_behaviors("tasks:\n- task: A\n  parameters:\n"
                     "  - {parameter: p, allowed_values: string}\n"
                     "  - {parameter: p, allowed_values: [string]}\n"));
}

TEST(FixExclusions, AListThatAnotherOneContains) {
  EXPECT_EQ(fix(with_behaviors("exclusivity_constraints:\n"
                               "- mutually_exclusive: [A, B]\n"
                               "# all\n"
                               "- mutually_exclusive: [A, B, C]\n"
                               "- mutually_exclusive:\n  - C\n  - A\n"
                               "- mutually_exclusive: [C, B, A]\n")),
            with_behaviors("exclusivity_constraints:\n"
                           "# all\n"
                           "- mutually_exclusive: [A, B, C]\n"));
  // The list of an alias may go, the one with the anchor may not.
  EXPECT_EQ(fix(with_behaviors("exclusivity_constraints:\n- mutually_exclusive: &l [A, B]\n"
                               "- mutually_exclusive: *l\n")),
            with_behaviors("exclusivity_constraints:\n- mutually_exclusive: &l [A, B]\n"));
  expect_unchanged(
      with_behaviors("exclusivity_constraints:\n- mutually_exclusive: &l [A, B]\n"
                     "- mutually_exclusive: [A, B, C]\nx-list: *l\n"));
  // An error would go with it.
  expect_unchanged(
      with_behaviors("exclusivity_constraints:\n- mutually_exclusive: [A, B, C]\n"
                     "- mutually_exclusive: [A, B, CC]\n"));
}

TEST(FixExclusions, ATaskTwiceInAList) {
  const auto list = [](const std::string& tasks) {
    return with_behaviors("exclusivity_constraints:\n- mutually_exclusive: " + tasks + "\n");
  };
  EXPECT_EQ(fix(list("[A, B, A]")), list("[A, B]"));
  EXPECT_EQ(fix(list("[A, A, B,A , A, C]")), list("[A, B, C]"));
  EXPECT_EQ(fix(list("[A, \"B\", 'A',]")), list("[A, \"B\",]"));
  EXPECT_EQ(fix(list("[\n    A,\n    B,\n    A\n  ]")), list("[\n    A,\n    B\n  ]"));
  EXPECT_EQ(fix(list("\n  - A\n  - B\n  - A\n  - C")), list("\n  - A\n  - B\n  - C"));
  EXPECT_EQ(fix(list("[A, *a, B]")), list("[A, *a, B]"));  // no YAML
  expect_unchanged(list("[&a A, B, *a]"));
  expect_unchanged(list("[&a A, *a, B]"));
  expect_unchanged(list("[B, A, !!str A]"));
  expect_unchanged(list("[A, B, # first\n  A]"));
  expect_unchanged(list("&l [A, B, A]\nx-list: *l"));
  // Only a person knows which other task was meant.
  expect_unchanged(list("[A, A]"));
}

TEST(FixExclusions, InAListThatGoes) {
  const std::string text = with_behaviors(
      "exclusivity_constraints:\n- mutually_exclusive: [A, B, A]\n"
      "- mutually_exclusive: [A, B]\n- mutually_exclusive: [B, A, B]\n");
  EXPECT_EQ(fix(text), with_behaviors("exclusivity_constraints:\n- mutually_exclusive: [A, B]\n"));
  EXPECT_EQ(left(text, rule::self_exclusion), "");
  EXPECT_EQ(left(text, rule::duplicate_exclusion), "");
}

Diagnostic finding(std::vector<Edit> edits) {
  Diagnostic result;
  result.edits = std::move(edits);
  return result;
}

Edit replace(std::uint32_t begin, std::uint32_t end, std::string text) {
  return {Edit::Kind::replace, {{1, begin}, {1, end}}, std::move(text)};
}

TEST(ApplyFixes, AllEditsOfAFindingOrNone) {
  const std::vector<Diagnostic> findings{
      finding({replace(3, 5, "CD"), replace(7, 8, "G")}),
      finding({}),
      finding({replace(1, 2, "A"), replace(4, 6, "??")}),
      finding({replace(1, 2, "a longer text")}),
  };
  const FixedText fixed = apply_fixes("abcdefgh", findings);
  EXPECT_EQ(fixed.text, "a longer textbCDefGh");
  EXPECT_EQ(fixed.mended, (std::vector<std::size_t>{0, 3}));
}

TEST(ApplyFixes, NothingToDo) {
  for (const std::string text : {"", "a", "a\n", "\xEF\xBB\xBF", "\r\n\r\n"}) {
    const FixedText fixed = apply_fixes(text, {});
    EXPECT_EQ(fixed.text, text);
    EXPECT_TRUE(fixed.mended.empty());
  }
}

TEST(ApplyFixes, AListKeepsAnEntry) {
  const auto remove = [](std::uint32_t line) {
    return finding({{Edit::Kind::remove_entry, {{line, 3}, {line, 4}}, {}}});
  };
  const std::vector<Diagnostic> findings{remove(1), remove(2), remove(3)};
  EXPECT_EQ(apply_fixes("- a\n- b\n- c\n", findings).text, "- c\n");
  EXPECT_EQ(apply_fixes("- a\n", std::vector{remove(1)}).text, "- a\n");
  EXPECT_EQ(apply_fixes("[ a ]", std::vector{remove(1)}).text, "[ a ]");
  // No entry begins there; no YAML.
  EXPECT_EQ(apply_fixes("-  a\n- b\n", std::vector{remove(1)}).text, "-  a\n- b\n");
  EXPECT_EQ(apply_fixes("- a\n- ]\n", std::vector{remove(1)}).text, "- a\n- ]\n");
}

TEST(ApplyFixes, NestedLists) {
  const auto remove = [](std::uint32_t line, std::uint32_t column) {
    return std::vector{
        finding({{Edit::Kind::remove_entry, {{line, column}, {line, column + 1}}, {}}})};
  };
  EXPECT_EQ(apply_fixes("- - a\n  - b\n- c\n", remove(2, 5)).text, "- - a\n- c\n");
  EXPECT_EQ(apply_fixes("- - a\n  - b\n- c\n", remove(1, 3)).text, "- c\n");
  EXPECT_EQ(apply_fixes("- - a\n  - b\n- c\n", remove(1, 5)).text, "- - a\n  - b\n- c\n");
  EXPECT_EQ(apply_fixes("[[a, [b]], c]", remove(1, 2)).text, "[[a, [b]], c]");
  EXPECT_EQ(apply_fixes("a:\n- b\n- |\n c\n\nd: e\n", remove(3, 3)).text,
            "a:\n- b\n- |\n c\n\nd: e\n");
}

}  // namespace
}  // namespace cbc::fixes_test
