#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/wording.h"

namespace cbc {
namespace {

std::string find(std::string_view name, const std::vector<std::string_view>& names) {
  return std::string(nearest(name, names).value_or("-"));
}

TEST(Nearest, FindsTypingErrors) {
  const std::vector<std::string_view> names{"TAKE_OFF", "LAND", "HOVER", "FOLLOW_PATH"};
  EXPECT_EQ(find("TAKE_OF", names), "TAKE_OFF");        // left out
  EXPECT_EQ(find("TAKE_OFFF", names), "TAKE_OFF");      // twice
  EXPECT_EQ(find("TAKE_IFF", names), "TAKE_OFF");       // another letter
  EXPECT_EQ(find("HOVRE", names), "HOVER");             // transposed
  EXPECT_EQ(find("FOLOW_PAHT", names), "FOLLOW_PATH");  // two errors
}

TEST(Nearest, DifferencesInCaseAndSeparatorsCountLittle) {
  EXPECT_EQ(find("land", {"LAND"}), "LAND");
  EXPECT_EQ(find("take-off", {"TAKE_OFF"}), "TAKE_OFF");
  EXPECT_EQ(find("x", {"X"}), "X");
  // One letter in the other case is nearer than one that is wrong.
  EXPECT_EQ(find("lAND", {"BAND", "LAND"}), "LAND");
}

TEST(Nearest, NothingResemblesIt) {
  EXPECT_EQ(find("WAIT", {"LAND", "HOVER"}), "-");
  EXPECT_EQ(find("", {"LAND"}), "-");
  EXPECT_EQ(find("LAND", {}), "-");
  EXPECT_EQ(find("LAND", {""}), "-");
  // A wrong letter of two is too much, of three it is not.
  EXPECT_EQ(find("A1", {"A2"}), "-");
  EXPECT_EQ(find("AA1", {"AA2"}), "AA2");
  // Two of five are too much.
  EXPECT_EQ(find("ABCDE", {"ABCXY"}), "-");
}

TEST(Nearest, TheNameItselfIsNoSuggestion) { EXPECT_EQ(find("LAND", {"LAND"}), "-"); }

TEST(Nearest, TheNearestWinsAndOfEqualOnesTheFirst) {
  EXPECT_EQ(find("task12", {"task35", "task13", "task14"}), "task13");
  EXPECT_EQ(find("task1", {"task2", "task3"}), "task2");
}

TEST(Nearest, FindsNamesThatWereExtendedOrShortened) {
  EXPECT_EQ(find("SELF_LOCALIZE_NON_EXISTENT", {"LOCALIZE", "SELF_LOCALIZE", "SELF"}),
            "SELF_LOCALIZE");
  EXPECT_EQ(find("CONTROL", {"MOVE", "PID_MOTION_CONTROL"}), "PID_MOTION_CONTROL");
  EXPECT_EQ(find("hover", {"HOVER_WITH_PID_CONTROL"}), "HOVER_WITH_PID_CONTROL");
  // Only at a word boundary.
  EXPECT_EQ(find("HOVERCRAFT_LANDING", {"HOVER"}), "-");
  // A typing error is the better explanation.
  EXPECT_EQ(find("HOVER_A", {"HOVER", "HOVER_AB"}), "HOVER_AB");
}

TEST(Nearest, WorkIsBounded) {
  std::vector<std::string> texts;
  texts.reserve(20'000);
  for (int i = 0; i < 20'000; ++i) texts.push_back("some_task_" + std::to_string(i));
  const std::vector<std::string_view> names(texts.begin(), texts.end());
  Suggestions suggestions(names);
  EXPECT_EQ(suggestions.nearest("some_task_x"), "some_task_0");
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (suggestions.nearest("same_tusk_" + std::to_string(i))) ++found;
  }
  EXPECT_LT(found, 1'000);
  EXPECT_GT(found, 10);
}

}  // namespace
}  // namespace cbc
