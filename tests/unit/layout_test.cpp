#include "core/words/layout.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::layout_test {
namespace {

TEST(WrapLine, KeepsWhatFits) {
  EXPECT_EQ(wrap_line("one  two", 40, 2), "one  two");
  EXPECT_EQ(wrap_line(std::string(40, 'x'), 40, 2), std::string(40, 'x'));
}

TEST(WrapLine, BreaksBetweenWordsAndIndentsTheRest) {
  EXPECT_EQ(wrap_line("  start FOLLOW_PATH, priority 2: accepted", 30, 4),
            "  start FOLLOW_PATH, priority\n    2: accepted");
}

TEST(WrapLine, KeepsColumns) {
  EXPECT_EQ(wrap_line("1 + Y  HOVER_WITH_MPC  HOVER  requested", 30, 7),
            "1 + Y  HOVER_WITH_MPC  HOVER\n       requested");
}

TEST(WrapLine, DoesNotBreakWords) {
  const std::string word(50, 'x');
  EXPECT_EQ(wrap_line(word + " and " + word, 30, 2), word + "\n  and\n  " + word);
  EXPECT_EQ(wrap_line("    " + word, 30, 2), "    " + word) << "no line for blanks alone";
}

TEST(WrapLine, KeepsNumbersAndUnitsTogether) {
  EXPECT_EQ(wrap_line("requires MOVE with at least 60 %, but", 30, 2),
            "requires MOVE with at least\n  60 %, but");
  EXPECT_EQ(wrap_line("(DRIVE_PLANNED 95 %, SONAR 60 %)", 30, 2),
            "(DRIVE_PLANNED 95 %, SONAR\n  60 %)");
  EXPECT_EQ(wrap_line("it is due to start by itself at 10.5 s", 36, 2),
            "it is due to start by itself at\n  10.5 s");
  EXPECT_EQ(wrap_line("TARGET is seen at place 10 south of it", 28, 2),
            "TARGET is seen at place 10\n  south of it");
}

TEST(WrapLine, DoesNotCountColors) {
  const std::string painted = "\x1b[31mone\x1b[0m two three four five six";
  EXPECT_EQ(wrap_line(painted, 27, 2), painted);
  EXPECT_EQ(wrap_line(painted, 26, 2), "\x1b[31mone\x1b[0m two three four five\n  six");
}

TEST(WrapLine, CountsWideCharactersAsTwo) {
  EXPECT_EQ(wrap_line("\u6f22\u5b57\u6f22\u5b57\u6f22 \u6f22\u5b57\u6f22\u5b57\u6f22\u5b57", 22, 2),
            "\u6f22\u5b57\u6f22\u5b57\u6f22\n  \u6f22\u5b57\u6f22\u5b57\u6f22\u5b57");
}

TEST(WrapLine, LeavesANarrowTerminalAlone) {
  EXPECT_EQ(wrap_line("one two three four five", 20, 11), "one two three four five");
  EXPECT_EQ(wrap_line("one two three four five", 0, 0), "one two three four five") << "no limit";
}

using Names = std::vector<std::string>;

const std::string twenty_eight = "ABCDEFGHIJKLMNOPQRSTUVWXYZ12";

TEST(Shorten, LeavesNamesThatFit) {
  EXPECT_EQ(shorten({}), Names{});
  EXPECT_EQ(shorten({"", twenty_eight}), (Names{"", twenty_eight}));
}

TEST(Shorten, LeavesOutTheMiddle) {
  EXPECT_EQ(shorten({twenty_eight + "3"}), Names{"ABCDEFGHIJKL...QRSTUVWXYZ123"});
  EXPECT_EQ(shorten({"A", twenty_eight + twenty_eight}),
            (Names{"A", "ABCDEFGHIJKL...PQRSTUVWXYZ12"}));
}

TEST(Shorten, KeepsNamesDifferent) {
  const std::string head = "TRACK_TARGET_WITH_";
  const std::string tail = "_CAMERA_IN_DAYLIGHT";
  EXPECT_EQ(shorten({head + "FRONT" + tail, head + "REAR" + tail}),
            (Names{head + "FRONT" + tail, head + "REAR" + tail}))
      << "with 56 columns, both fit";
  const std::string many(40, 'x');
  EXPECT_EQ(shorten({many + "a" + many, many + "b" + many, many}),
            (Names{many + "a" + many, many + "b" + many, many}))
      << "that takes all columns";
  const std::string long_name = many + "_" + many;
  EXPECT_EQ(shorten({long_name, long_name}).front(), "xxxxxxxxxxxx...xxxxxxxxxxxxx")
      << "equal names stay equal";
}

TEST(Shorten, CountsColumnsNotCharacters) {
  std::string wide;
  for (int i = 0; i < 20; ++i) wide += "\u4E2D";  // two columns each
  std::string shortened = "\u4E2D\u4E2D\u4E2D\u4E2D\u4E2D\u4E2D...";
  for (int i = 0; i < 6; ++i) shortened += "\u4E2D";
  EXPECT_EQ(shorten({wide}), Names{shortened});
}

/// It would combine with the dots.
TEST(Shorten, PutsNoCombiningCharacterBehindTheDots) {
  const std::string begin(16, 'i');
  EXPECT_EQ(shorten({begin + "\u0301" + std::string(13, 'j')}),
            Names{"iiiiiiiiiiii...jjjjjjjjjjjjj"});
}

}  // namespace
}  // namespace cbc::layout_test
