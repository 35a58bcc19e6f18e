// When a search that learns restarts, and what it looks at first.
#include <vector>

#include <gtest/gtest.h>

#include "runtime/solver/conflict_analysis.h"

namespace cbc::restarts_test {
namespace {

/// Numbers of conflicts up to each restart, in units of the first one.
std::vector<int> gaps_of(Restarts& restarts, int count) {
  std::vector<int> gaps;
  int unit = 0;
  for (int restart = 0; restart < count; ++restart) {
    int conflicts = 0;
    while (!restarts.is_due()) {
      restarts.note_conflict();
      ++conflicts;
    }
    if (restart == 0) unit = conflicts;
    EXPECT_EQ(conflicts % unit, 0);
    gaps.push_back(conflicts / unit);
    restarts.restart();
  }
  return gaps;
}

TEST(Restarts, AreAsFarApartAsLubyProposes) {
  Restarts restarts;
  EXPECT_FALSE(restarts.is_due());
  const std::vector<int> gaps = {1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8, 1};
  EXPECT_EQ(gaps_of(restarts, 16), gaps);
  restarts.clear();
  EXPECT_EQ(gaps_of(restarts, 16), gaps);
}

/// Also where the numbers would become too large: 1.05 to the power of 20,000 is about 10 to that
/// of 424.
TEST(Activities, OfWhatIsNotedTwiceAsOftenAreAboutTwiceAsHigh) {
  Activities activities;
  activities.clear(3);
  for (int conflict = 1; conflict <= 20'000; ++conflict) {
    activities.note(0);
    if (conflict % 2 == 0) activities.note(1);
    activities.age();
    if (conflict % 1'000 != 0) continue;
    const double share = activities[1] / activities[0];
    EXPECT_GT(share, 0.45) << conflict;
    EXPECT_LT(share, 0.55) << conflict;
  }
  EXPECT_EQ(activities[2], 0);
  activities.note(2);
  EXPECT_GT(activities[2], 0);
  EXPECT_LT(activities[2], activities[0]);
  activities.clear(3);
  EXPECT_EQ(activities[0], 0);
  activities.note(0);
  EXPECT_EQ(activities[0], 1);
}

}  // namespace
}  // namespace cbc::restarts_test
