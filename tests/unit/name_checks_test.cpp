#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"

namespace cbc::name_checks_test {
namespace {

/// What is said of tasks with these names, a finding on a line.
std::string findings(const std::vector<std::string>& names) {
  Catalog catalog;
  for (const std::string& name : names) catalog.tasks.emplace_back().name = name;
  Diagnostics diagnostics;
  Reporter reporter("robot.yaml", diagnostics);
  check_names(catalog, reporter);
  std::string text;
  for (const Diagnostic& finding : diagnostics.all()) text += finding.message + "\n";
  return text;
}

/// How two names that look alike differ.
std::string look_alike(const std::string& name, const std::string& other) {
  const std::string text = findings({other, name});
  const std::size_t colon = text.find("': ");
  return colon == std::string::npos ? "-" : text.substr(colon + 3, text.size() - colon - 4);
}

TEST(NameChecks, DifferInCase) {
  EXPECT_EQ(look_alike("TAKE_OFF", "Take_Off"), "they differ only in upper and lower case");
  EXPECT_EQ(look_alike("LÖSCHEN", "löschen"), "they differ only in upper and lower case");
  EXPECT_EQ(look_alike("ВЕТЕР", "ветер"), "they differ only in upper and lower case");
}

TEST(NameChecks, DifferInSeparators) {
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKE-OFF"), "they differ only in what separates the words");
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKE__OFF"), "they differ only in what separates the words");
  EXPECT_EQ(look_alike("TAKE OFF", "take_off"),
            "they differ only in case and in what separates the words");
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKEOFF"), "-");
  EXPECT_EQ(look_alike("ARM_1_1", "ARM_11"), "-");
  EXPECT_EQ(look_alike("-1", "1"), "-");
}

TEST(NameChecks, DifferInCharacters) {
  EXPECT_EQ(look_alike("MODE_0", "MODE_O"),
            "character 6 is U+0030 in the one and U+004F in the other");
  EXPECT_EQ(look_alike("AXIS_I", "AXIS_1"),
            "character 6 is U+0049 in the one and U+0031 in the other");
  EXPECT_EQ(look_alike("ARM_L", "ARM_1"), "-");
  EXPECT_EQ(look_alike("ARM_L", "ARM_R"), "-");
  EXPECT_EQ(look_alike("drucken", "drücken"), "-");
}

TEST(NameChecks, MixScriptsInAWord) {
  EXPECT_EQ(
      findings({"\u041DOVER"}),
      "task '\u041DOVER' mixes Cyrillic and Latin letters in a word: character 2 is U+004F\n");
  EXPECT_EQ(findings({"HO_T\u03A4T"}),
            "task 'HO_T\u03A4T' mixes Latin and Greek letters in a word: character 5 is U+03A4\n");
  EXPECT_EQ(
      findings({"\u0432\u0435\u0442\u0435\u0440_ON", "\u03B1/beta", "L\u00D6SCHEN_1", "1\u03B1"}),
      "");
}

TEST(NameChecks, DifferInCaseAndShape) {
  constexpr std::string_view both = "they differ only in case and in characters that look alike";
  EXPECT_EQ(look_alike("H0VER", "hover"), both);
  EXPECT_EQ(look_alike("ARM_L", "arm_1"), "-");
}

TEST(NameChecks, DifferInWhatCannotBeSeen) {
  EXPECT_EQ(look_alike("HOVER", "HO\u200BVER"),
            "character 3 is U+0056 in the one and U+200B in the other");
  EXPECT_EQ(look_alike("HOVER", "HOVER "),
            "character 6 is missing in the one and U+0020 in the other");
  EXPECT_EQ(look_alike("HOVER", "HOVER\u2800"),
            "character 6 is missing in the one and U+2800 in the other");
}

TEST(NameChecks, AreFoundAmongAllNames) {
  EXPECT_EQ(findings({"LAND", "HOVER", "LAND", "TAKE_OFF"}), "");
  EXPECT_EQ(findings({"LAND", "HOVER", "TAKE_OFF", "Hover", "TAKE_0FF"}),
            "task 'Hover' is easily taken for task 'HOVER': they differ only in upper and lower "
            "case\n"
            "task 'TAKE_0FF' is easily taken for task 'TAKE_OFF': character 6 is U+0030 in the one "
            "and U+004F in the other\n");
}

}  // namespace
}  // namespace cbc::name_checks_test
