#include "core/support/look_alikes.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::look_alikes_test {
namespace {

std::string look_alike(std::string_view name, std::string_view other) {
  LookAlikes names;
  EXPECT_FALSE(names.add(name));
  const auto found = names.add(other);
  if (!found) return "-";
  EXPECT_EQ(*found, 0U);
  return difference_of(name, other);
}

TEST(LookAlikes, DifferInCase) {
  EXPECT_EQ(look_alike("TAKE_OFF", "Take_Off"), "they differ only in upper and lower case");
  EXPECT_EQ(look_alike("LÖSCHEN", "löschen"), "they differ only in upper and lower case");
  EXPECT_EQ(look_alike("ВЕТЕР", "ветер"), "they differ only in upper and lower case");
}

TEST(LookAlikes, DifferInSeparators) {
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKE-OFF"), "they differ only in what separates the words");
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKE__OFF"), "they differ only in what separates the words");
  EXPECT_EQ(look_alike("TAKE OFF", "take_off"),
            "they differ only in case and in what separates the words");
  EXPECT_EQ(look_alike("TAKE_OFF", "TAKEOFF"), "-");
  EXPECT_EQ(look_alike("ARM_1_1", "ARM_11"), "-");
  EXPECT_EQ(look_alike("-1", "1"), "-");
}

TEST(LookAlikes, DifferInCharacters) {
  EXPECT_EQ(look_alike("MODE_0", "MODE_O"),
            "character 6 is U+0030 in the one and U+004F in the other");
  EXPECT_EQ(look_alike("AXIS_I", "AXIS_1"),
            "character 6 is U+0049 in the one and U+0031 in the other");
  EXPECT_EQ(look_alike("\u041DOVER", "HOVER"),
            "character 1 is U+041D in the one and U+0048 in the other");
  EXPECT_EQ(look_alike("\u03A4EST", "TEST"),
            "character 1 is U+03A4 in the one and U+0054 in the other");
  EXPECT_EQ(look_alike("RUN \u21667", "RUN Vll7"),
            "character 5 is U+2166 in the one and U+0056 in the other");
  EXPECT_EQ(look_alike("\U0001D407OVER", "HOVER"),
            "character 1 is U+1D407 in the one and U+0048 in the other");
  EXPECT_EQ(look_alike("\uFF28OVER", "HOVER"),
            "character 1 is U+FF28 in the one and U+0048 in the other");
  EXPECT_EQ(look_alike("\u212AEEP", "KEEP"),
            "character 1 is U+212A in the one and U+004B in the other");
  EXPECT_EQ(look_alike("ARM_L", "ARM_1"), "-");
  EXPECT_EQ(look_alike("ARM_L", "ARM_R"), "-");
  EXPECT_EQ(look_alike("drucken", "drücken"), "-");
}

/// Of these, each letter looks like a Latin one in the confusable characters of Unicode.
TEST(LookAlikes, AreLettersOfOtherScripts) {
  const std::vector<std::pair<std::string_view, std::string_view>> letters{
      {"\u0430", "a"}, {"\u04BB", "h"}, {"\u0501", "d"}, {"\u051B", "q"},      {"\u051D", "w"},
      {"\u03B1", "a"}, {"\u03C1", "p"}, {"\u03B9", "i"}, {"\u0261", "g"},      {"\u0585", "o"},
      {"\u0570", "h"}, {"\u057D", "u"}, {"\u13A0", "D"}, {"\uA4D0", "B"},      {"\u2160", "I"},
      {"\u04C0", "I"}, {"\u04CF", "i"}, {"\u2044", "/"}, {"\u212B", "A\u030A"}};
  for (const auto& [letter, latin] : letters) {
    EXPECT_NE(look_alike("X" + std::string(letter), "X" + std::string(latin)), "-") << letter;
  }
  EXPECT_EQ(look_alike("\u0416", "K"), "-");
  EXPECT_EQ(look_alike("\u03A9", "O"), "-");
}

TEST(LookAlikes, DifferInCaseAndShape) {
  constexpr std::string_view both = "they differ only in case and in characters that look alike";
  EXPECT_EQ(look_alike("Hold", "H\u041ELD"), both);
  EXPECT_EQ(look_alike("H0VER", "hover"), both);
  EXPECT_EQ(look_alike("ARM_L", "arm_1"), "-");
}

TEST(LookAlikes, DifferInAccents) {
  EXPECT_NE(look_alike("\u017E", "z\u030C"), "-");
  EXPECT_EQ(look_alike("\u1EA4", "\u1EA5"), "they differ only in upper and lower case");
  EXPECT_EQ(look_alike("\u017E", "z"), "-");
}

TEST(LookAlikes, DifferInWhatCannotBeSeen) {
  EXPECT_EQ(look_alike("HOVER", "HO\u200BVER"),
            "character 3 is U+0056 in the one and U+200B in the other");
  EXPECT_EQ(look_alike("HOVER", "HOVER "),
            "character 6 is missing in the one and U+0020 in the other");
  EXPECT_EQ(look_alike("HOVER", "HOVER\u2800"),
            "character 6 is missing in the one and U+2800 in the other");
  EXPECT_EQ(look_alike("caf\u00E9", "cafe\u0301"),
            "character 4 is U+00E9 in the one and U+0065 in the other");
}

TEST(LookAlikes, AreFoundAmongAllNames) {
  LookAlikes names;
  for (const std::string_view name : {"LAND", "HOVER", "LAND", "TAKE_OFF"}) {
    EXPECT_FALSE(names.add(name)) << name;
  }
  EXPECT_EQ(names.add("Hover"), 1U);
  EXPECT_EQ(names.add("TAKE_0FF"), 3U);
}

}  // namespace
}  // namespace cbc::look_alikes_test
