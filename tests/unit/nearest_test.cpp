#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/support/wording.h"

namespace cbc::nearest_test {
namespace {

std::string find(std::string_view name, const std::vector<std::string_view>& names) {
  return std::string(nearest(name, names).value_or("-"));
}

TEST(Nearest, FindsTypingErrors) {
  const std::vector<std::string_view> names{"TAKE_OFF", "LAND", "HOVER", "FOLLOW_PATH"};
  EXPECT_EQ(find("TAKE_OF", names), "TAKE_OFF");         // left out
  EXPECT_EQ(find("TAKE_OFFF", names), "TAKE_OFF");       // twice
  EXPECT_EQ(find("TAKE_IFF", names), "TAKE_OFF");        // another letter
  EXPECT_EQ(find("HOVRE", names), "HOVER");              // transposed
  EXPECT_EQ(find("FOLLOE_PAHT", names), "-");            // two words
  EXPECT_EQ(find("FLLOWW_PATH", names), "FOLLOW_PATH");  // two errors in one word
  EXPECT_EQ(find("TAKEOFF", names), "TAKE_OFF");         // no separator
  EXPECT_EQ(find("TAKEO_FF", names), "TAKE_OFF");        // the separator elsewhere
  EXPECT_EQ(find("TAKEQOFF", names), "TAKE_OFF");        // a letter in its place
  EXPECT_EQ(find("TAK_EEOFF", names), "TAKE_OFF");       // one letter too many, wherever
}

TEST(Nearest, FindsTheSameWordsInAnotherOrder) {
  const std::vector<std::string_view> names{"PID_MOTION_CONTROL", "MPC_MOTION_CONTROL"};
  EXPECT_EQ(find("MOTION_PID_CONTROL", names), "PID_MOTION_CONTROL");
  EXPECT_EQ(find("CONTROL_MOTION_MPC", names), "MPC_MOTION_CONTROL");
  EXPECT_EQ(find("MOTION_PDI_CONTROL", names), "PID_MOTION_CONTROL");
  EXPECT_EQ(find("motionPIDControl", names), "PID_MOTION_CONTROL");
  // A word that is there twice counts twice.
  EXPECT_EQ(find("A_A_B", {"A_B_B"}), "-");
  // The order of the name itself is nearer.
  EXPECT_EQ(find("UP_LOOK", {"LOOK_UP", "up-look"}), "up-look");
}

TEST(Nearest, AnotherWordIsAnotherName) {
  EXPECT_EQ(find("CLEAR_OCCUPANCY_GRID", {"SAVE_OCCUPANCY_GRID"}), "-");
  EXPECT_EQ(find("ClearOccupancyGrid", {"SaveOccupancyGrid"}), "-");
  EXPECT_EQ(find("HOVER_WITH_MPC", {"HOVER_WITH_PID"}), "-");
  EXPECT_EQ(find("LOOK_UP", {"LOOK_DOWN"}), "-");
  EXPECT_EQ(find("A_CAMERA", {"B_CAMERA"}), "-");
  // Different numbers, however long the word, are different words.
  EXPECT_EQ(find("CAMERA1", {"CAMERA2"}), "-");
  EXPECT_EQ(find("CAMERA_1", {"CAMERA_2"}), "-");
  EXPECT_EQ(find("task12", {"task1", "task123", "task21"}), "-");
  EXPECT_EQ(find("H0VER", {"HOVER"}), "HOVER");
  EXPECT_EQ(find("tusk12", {"task21", "task12"}), "task12");
}

TEST(Nearest, DifferencesInCaseAndSeparatorsCountLittle) {
  EXPECT_EQ(find("land", {"LAND"}), "LAND");
  EXPECT_EQ(find("take-off", {"TAKE_OFF"}), "TAKE_OFF");
  EXPECT_EQ(find("takeOff", {"TAKE_OFF"}), "TAKE_OFF");
  EXPECT_EQ(find("x", {"X"}), "X");
  // One letter in the other case is nearer than one that is wrong.
  EXPECT_EQ(find("lAND", {"BAND", "LAND"}), "LAND");
}

TEST(Nearest, NothingResemblesIt) {
  EXPECT_EQ(find("WAIT", {"LAND", "HOVER"}), "-");
  EXPECT_EQ(find("", {"LAND"}), "-");
  EXPECT_EQ(find("_", {"LAND", "__"}), "-");
  EXPECT_EQ(find("LAND", {}), "-");
  EXPECT_EQ(find("LAND", {""}), "-");
  // A wrong letter of two is too much, of three it is not.
  EXPECT_EQ(find("AB", {"AC"}), "-");
  EXPECT_EQ(find("LOOK_AB", {"LOOK_AC"}), "-");
  EXPECT_EQ(find("LOOK_A", {"LOOK_B"}), "-");
  EXPECT_EQ(find("start_o_request", {"start_on_request"}), "start_on_request");
  EXPECT_EQ(find("start_no_request", {"start_on_request"}), "start_on_request");
  EXPECT_EQ(find("AAB", {"AAC"}), "AAC");
  // Two of five are too much, three of any number.
  EXPECT_EQ(find("ABCDE", {"ABCXY"}), "-");
  EXPECT_EQ(find("LOCALIZATION", {"LOXAXIZAXION"}), "-");
}

TEST(Nearest, TheNameItselfIsNoSuggestion) { EXPECT_EQ(find("LAND", {"LAND"}), "-"); }

TEST(Nearest, ATakenNameIsNoSuggestion) {
  const std::vector<std::string_view> names{"HOVER", "HOVERS", "HOVER_LOW"};
  const auto find_beside = [&names](std::string_view name, std::string_view taken) {
    return nearest(name, names, [taken](std::string_view known) { return known == taken; });
  };
  EXPECT_EQ(find_beside("HOVRE", "LAND"), "HOVER");
  EXPECT_EQ(find_beside("HOVRES", "HOVERS"), "HOVER");  // the next one
  EXPECT_EQ(find_beside("LOWE_HOVER", "HOVER_LOW"), "HOVER");
  EXPECT_EQ(find_beside("LOW_HOVER", "HOVER"), "HOVER_LOW");
  EXPECT_EQ(
      nearest("LAMD", std::vector<std::string_view>{"LAND"}, [](std::string_view) { return true; }),
      std::nullopt);
}

TEST(Nearest, TheNearestWinsAndOfEqualOnesTheFirst) {
  EXPECT_EQ(find("taskab", {"taskcd", "taskac", "taskad"}), "taskac");
  EXPECT_EQ(find("taska", {"taskb", "taskc"}), "taskb");
}

TEST(Nearest, FindsNamesThatWereExtendedOrShortened) {
  EXPECT_EQ(find("SELF_LOCALIZE_NON_EXISTENT", {"LOCALIZE", "SELF_LOCALIZE", "SELF"}),
            "SELF_LOCALIZE");
  EXPECT_EQ(find("CONTROL", {"MOVE", "PID_MOTION_CONTROL"}), "PID_MOTION_CONTROL");
  EXPECT_EQ(find("hover", {"HOVER_WITH_PID_CONTROL"}), "HOVER_WITH_PID_CONTROL");
  // Only at a word boundary.
  EXPECT_EQ(find("HOVERCRAFT_LANDING", {"HOVER"}), "-");
  // A typing error is the better explanation.
  EXPECT_EQ(find("HOVER_AFT", {"HOVER", "HOVER_OFT"}), "HOVER_OFT");
}

TEST(Nearest, WorkIsBounded) {
  std::vector<std::string> texts;
  texts.reserve(20'000);
  for (int i = 0; i < 20'000; ++i) texts.push_back("some_task_" + std::to_string(i));
  const std::vector<std::string_view> names(texts.begin(), texts.end());
  Suggestions suggestions(names);
  EXPECT_EQ(suggestions.nearest("task_some_7"), "some_task_7");
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    if (suggestions.nearest("same_task_" + std::to_string(i))) ++found;
  }
  EXPECT_LT(found, 1'000);
  EXPECT_GT(found, 10);
}

}  // namespace
}  // namespace cbc::nearest_test
