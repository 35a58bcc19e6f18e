#include "core/report/table_parts.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::table_parts_test {
namespace {

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
}  // namespace cbc::table_parts_test
