#include <string>

#include <gtest/gtest.h>

#include "support/json.h"

namespace cbc {
namespace {

TEST(JsonNesting, CountsOpenBrackets) {
  EXPECT_EQ(nesting_of(""), 0U);
  EXPECT_EQ(nesting_of("7"), 0U);
  EXPECT_EQ(nesting_of("[]"), 1U);
  EXPECT_EQ(nesting_of(R"([{"a":[]},{"b":1}])"), 3U);
  EXPECT_EQ(nesting_of("[][][]"), 1U);
  EXPECT_EQ(nesting_of(std::string(1'000'000, '[')), 1'000'000U);
}

TEST(JsonNesting, PassesOverTexts) {
  EXPECT_EQ(nesting_of(R"(["[[[", "\"[[", "\\"])"), 1U);
  EXPECT_EQ(nesting_of(R"(["\\", [2]])"), 2U);
}

TEST(JsonNesting, TakesWhatIsNoJson) {
  EXPECT_EQ(nesting_of("]]]["), 1U);
  EXPECT_EQ(nesting_of("\"[[["), 0U);
  EXPECT_EQ(nesting_of("[\"\\"), 1U);
}

}  // namespace
}  // namespace cbc
