#include "core/support/look_alikes.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
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

std::string character(int place, std::string_view one, std::string_view other) {
  return fmt::format("character {} is {} in the one and {} in the other", place, one, other);
}

TEST(LookAlikes, SayHowTheyDiffer) {
  const std::string none = "-";
  const std::string in_case = "they differ only in upper and lower case";
  const std::string separators = "they differ only in what separates the words";
  const std::string both = "they differ only in case and in what separates the words";
  const std::string shape = "they differ only in case and in characters that look alike";
  struct Case {
    std::string_view name;
    std::string_view other;
    std::string difference;
  };
  const std::vector<Case> cases{{"TAKE_OFF", "Take_Off", in_case},
                                {"LÖSCHEN", "löschen", in_case},
                                {"ВЕТЕР", "ветер", in_case},
                                {"TAKE_OFF", "TAKE-OFF", separators},
                                {"TAKE_OFF", "TAKE__OFF", separators},
                                {"TAKE OFF", "take_off", both},
                                {"TAKE_OFF", "TAKEOFF", none},
                                {"ARM_1_1", "ARM_11", none},
                                {"-1", "1", none},
                                // Characters.
                                {"MODE_0", "MODE_O", character(6, "U+0030", "U+004F")},
                                {"AXIS_I", "AXIS_1", character(6, "U+0049", "U+0031")},
                                {"\u041DOVER", "HOVER", character(1, "U+041D", "U+0048")},
                                {"\u03A4EST", "TEST", character(1, "U+03A4", "U+0054")},
                                {"RUN \u21667", "RUN Vll7", character(5, "U+2166", "U+0056")},
                                {"\U0001D407OVER", "HOVER", character(1, "U+1D407", "U+0048")},
                                {"\uFF28OVER", "HOVER", character(1, "U+FF28", "U+0048")},
                                {"\u212AEEP", "KEEP", character(1, "U+212A", "U+004B")},
                                {"ARM_L", "ARM_1", none},
                                {"ARM_L", "ARM_R", none},
                                {"drucken", "drücken", none},
                                // Case and shape.
                                {"Hold", "H\u041ELD", shape},
                                {"H0VER", "hover", shape},
                                {"ARM_L", "arm_1", none},
                                // Accents.
                                {"\u1EA4", "\u1EA5", in_case},
                                {"\u017E", "z", none},
                                // What cannot be seen.
                                {"HOVER", "HO\u200BVER", character(3, "U+0056", "U+200B")},
                                {"HOVER", "HOVER ", character(6, "missing", "U+0020")},
                                {"HOVER", "HOVER\u2800", character(6, "missing", "U+2800")},
                                {"caf\u00E9", "cafe\u0301", character(4, "U+00E9", "U+0065")}};
  for (const Case& one : cases) {
    EXPECT_EQ(look_alike(one.name, one.other), one.difference) << one.name << " " << one.other;
  }
  EXPECT_NE(look_alike("\u017E", "z\u030C"), none);
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
