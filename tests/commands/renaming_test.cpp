// How names stand in texts, and what becomes of them. That all places are found, and no others, is
// tested by rename_property_test.cpp.
#include "core/catalog/renaming.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

namespace cbc::renaming_test {
namespace {

RenamedText rename(std::string_view text, const Renaming& renaming) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "robot.yaml", diagnostics);
  const CatalogReading reading = understand_catalog(*document, diagnostics);
  EXPECT_EQ(diagnostics.count(Severity::error), 0U);
  return rename_in(text, *document, reading.names, renaming);
}

std::string rename_task(std::string_view text, std::string old_name, std::string new_name) {
  const RenamedText renamed =
      rename(text, {NameKind::task, std::move(old_name), std::move(new_name)});
  return renamed.obstacle ? renamed.obstacle->message : renamed.text;
}

/// A catalog with a task in this spelling.
std::string spelled(const std::string& task) {
  return "behaviors:\n- {behavior: B, task: " + task + "}\n";
}

TEST(Renaming, KeepsQuotes) {
  EXPECT_EQ(rename_task(spelled("A"), "A", "C"), spelled("C"));
  EXPECT_EQ(rename_task(spelled("'A'"), "A", "C"), spelled("'C'"));
  EXPECT_EQ(rename_task(spelled("\"A\""), "A", "C"), spelled("\"C\""));
  EXPECT_EQ(rename_task(spelled("!!str A"), "A", "C"), spelled("!!str C"));
  EXPECT_EQ(rename_task(spelled("&a A"), "A", "C"), spelled("&a C"));
}

TEST(Renaming, AddsQuotesWhereANameNeedsThem) {
  for (const char* name : {"true", "no", "12", "1.5e3", "~", "null", "a: b", "a #b", "[x]", "a,b",
                           "- a", "*a", "&a", "@a", "<<", "it's: so"}) {
    EXPECT_EQ(rename_task(spelled("A"), "A", name), spelled("\"" + std::string(name) + "\""))
        << name;
  }
  EXPECT_EQ(rename_task(spelled("A"), "A", "a b/c-d.e"), spelled("a b/c-d.e"));
  EXPECT_EQ(rename_task(spelled("'A'"), "A", "it's"), spelled("it's"));
  EXPECT_EQ(rename_task(spelled("\"A\""), "A", "a\\b"), spelled("a\\b"));
}

TEST(Renaming, UnderstandsEscapes) {
  EXPECT_EQ(rename_task(spelled("\"\\x41\""), "A", "C"), spelled("C"));
  EXPECT_EQ(rename_task(spelled("'it''s'"), "it's", "C"), spelled("C"));
}

TEST(Renaming, KeepsLineBreaksAndByteOrderMark) {
  EXPECT_EQ(
      rename_task("\xEF\xBB\xBF# A\r\nbehaviors:\r\n- {behavior: A, task: A}  # A\r\n", "A", "C"),
      "\xEF\xBB\xBF# A\r\nbehaviors:\r\n- {behavior: A, task: C}  # A\r\n");
}

TEST(Renaming, OfAnAliasChangesItsAnchor) {
  EXPECT_EQ(rename_task("behaviors:\n- {behavior: B, task: &a A}\ntasks:\n- task: *a\n", "A", "C"),
            "behaviors:\n- {behavior: B, task: &a C}\ntasks:\n- task: *a\n");
  EXPECT_EQ(
      rename_task("x-base: &base {task: A}\nbehaviors:\n- {behavior: B, <<: *base}\n", "A", "C"),
      "x-base: &base {task: C}\nbehaviors:\n- {behavior: B, <<: *base}\n");
}

TEST(Renaming, RefusesAnAliasOfTwoMeanings) {
  constexpr const char* why =
      "'A' cannot be changed here: aliases give it another meaning, too; write the name out there";
  EXPECT_EQ(rename_task("behaviors:\n- {behavior: &a A, task: *a}\n", "A", "C"), why);
  EXPECT_EQ(rename_task("behaviors:\n- {behavior: B, package: &a A, task: *a}\n", "A", "C"), why);
}

TEST(Renaming, RefusesNamesOverSeveralLines) {
  constexpr const char* why =
      "'A' cannot be changed here: it goes over several lines; write it on one";
  EXPECT_EQ(rename_task("behaviors:\n- behavior: B\n  task: |-\n    A\n", "A", "C"), why);
  EXPECT_EQ(rename_task("behaviors:\n- behavior: B\n  task: A\n    D\n", "A D", "C"),
            "'A D' cannot be changed here: it goes over several lines; write it on one");
}

TEST(Renaming, NeedsAName) {
  const auto fault = [](std::string name, NameKind kind = NameKind::task) {
    return fault_of_new_name({kind, "A", std::move(name)});
  };
  EXPECT_EQ(fault("C"), "");
  EXPECT_EQ(fault("any"), "");
  EXPECT_EQ(fault(""), "a name must not be empty");
  EXPECT_EQ(fault("A"), "'A' is the old name");
  EXPECT_EQ(fault("any", NameKind::behavior),
            "'any' is no name of a behavior: where one is expected to run, it stands for any of "
            "them");
  EXPECT_EQ(fault("a\nb"), "'a\\nb' is no name: character 2 is no printable one");
  EXPECT_EQ(fault("a\xFF"), "'a\\xff' is no name: character 2 is not valid UTF-8");
  EXPECT_EQ(fault("a "), "'a ' is no name: a blank at its begin or end is not seen");
}

TEST(Renaming, IsCheckedByComparingTheTrees) {
  const std::string text = "behaviors:\n- {behavior: A, task: A}\n";
  const auto is_right = [&](std::string_view after) {
    Diagnostics diagnostics;
    const auto before_document = yaml::parse(text, "a.yaml", diagnostics);
    const auto after_document = yaml::parse(after, "a.yaml", diagnostics);
    const auto before = understand_catalog(*before_document, diagnostics).names;
    const auto names = understand_catalog(*after_document, diagnostics).names;
    return differ_only_in_name({*before_document, before}, {*after_document, names},
                               {NameKind::task, "A", "C"});
  };
  EXPECT_TRUE(is_right("behaviors:\n- {behavior: A, task: C}\n"));
  EXPECT_TRUE(is_right("behaviors:  # C\n- {behavior: A, task: 'C'}\n"));
  EXPECT_FALSE(is_right(text));
  EXPECT_FALSE(is_right("behaviors:\n- {behavior: C, task: A}\n"));
  EXPECT_FALSE(is_right("behaviors:\n- {behavior: C, task: C}\n"));
  EXPECT_FALSE(is_right("behaviors:\n- {behavior: A, task: C}\n- {behavior: A, task: C}\n"));
}

}  // namespace
}  // namespace cbc::renaming_test
