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
  const LocalTask first(0);
  const LocalTask second(1);
  const LocalTask third(2);
  Activities activities;
  activities.clear(3);
  for (int conflict = 1; conflict <= 20'000; ++conflict) {
    activities.note(first);
    if (conflict % 2 == 0) activities.note(second);
    activities.age();
    if (conflict % 1'000 != 0) continue;
    const double share = activities[second] / activities[first];
    EXPECT_GT(share, 0.45) << conflict;
    EXPECT_LT(share, 0.55) << conflict;
  }
  EXPECT_EQ(activities[third], 0);
  activities.note(third);
  EXPECT_GT(activities[third], 0);
  EXPECT_LT(activities[third], activities[first]);
  activities.clear(3);
  EXPECT_EQ(activities[first], 0);
  activities.note(first);
  EXPECT_EQ(activities[first], 1);
}

}  // namespace
}  // namespace cbc::restarts_test
