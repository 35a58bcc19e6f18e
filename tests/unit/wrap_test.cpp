#include <gtest/gtest.h>

#include "support/wording.h"

namespace cbc {
namespace {

using Lines = std::vector<std::string_view>;

TEST(Wrap, ShortNamesStayOnOneLine) {
  EXPECT_EQ(wrap_name("", 9), (Lines{""}));
  EXPECT_EQ(wrap_name("HOVER", 9), (Lines{"HOVER"}));
  EXPECT_EQ(wrap_name("HOVER_WITH_1", 9), (Lines{"HOVER_WITH_1"}));  // a third longer
}

TEST(Wrap, LongNamesAreBrokenBehindSeparatorsAndBeforeCapitals) {
  EXPECT_EQ(wrap_name("HOVER_WITH_MPC", 9), (Lines{"HOVER_", "WITH_MPC"}));
  EXPECT_EQ(wrap_name("MotionPlannerCloseTarget", 12), (Lines{"MotionPlanner", "CloseTarget"}));
  EXPECT_EQ(wrap_name("one/two three.four-five", 7), (Lines{"one/two ", "three.", "four-five"}));
}

TEST(Wrap, NamesWithoutAPlaceToBreakStayWhole) {
  EXPECT_EQ(wrap_name("abcdefghijklmnopqrstuvwxyz", 5), (Lines{"abcdefghijklmnopqrstuvwxyz"}));
  EXPECT_EQ(wrap_name("________________", 5), (Lines{"________________"}));
  EXPECT_EQ(wrap_name("ÄÖÜÄÖÜÄÖÜÄÖÜ", 9), (Lines{"ÄÖÜÄÖÜÄÖÜÄÖÜ"}));
}

TEST(Wrap, LinesTogetherAreTheName) {
  const std::string_view name = "a__b_C_dE_fGh.iJ-k/lM nOpQ_日本_語";
  for (std::size_t width = 1; width < 40; ++width) {
    std::string joined;
    for (const std::string_view line : wrap_name(name, width)) joined += line;
    EXPECT_EQ(joined, name) << width;
  }
}

}  // namespace
}  // namespace cbc
