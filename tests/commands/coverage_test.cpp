#include <gtest/gtest.h>

#include "coverage/report/coverage_report.h"

namespace cbc::coverage_test {
namespace {

TEST(CoverageCount, RoundsDown) {
  EXPECT_EQ(describe_percent({3, 2}), "66.6 %");
  EXPECT_EQ(describe_percent({100'000, 99'999}), "99.9 %");
  EXPECT_EQ(describe_percent({7, 7}), "100.0 %");
  EXPECT_EQ(describe_percent({}), "\u2013");
}

}  // namespace
}  // namespace cbc::coverage_test
