#include <map>
#include <set>

#include <gtest/gtest.h>

#include "property/random.h"
#include "runtime/coordinator/state.h"

namespace cbc::timers_test {
namespace {

TEST(Timers, AgreeWithAnOrderedSet) {
  oracle::Random random(1);
  constexpr std::uint32_t items = 40;
  Timers timers(items);
  std::map<std::uint32_t, Microseconds> due_of;
  std::set<std::pair<Microseconds, std::uint32_t>> expected;
  for (int round = 0; round < 50'000; ++round) {
    const auto item = static_cast<std::uint32_t>(random.below(items));
    const bool removes = random.percent(40);
    if (const auto known = due_of.find(item); known != due_of.end()) {
      expected.erase({known->second, item});
      due_of.erase(known);
    }
    if (removes) {
      timers.remove(item);
    } else {
      const Microseconds due = random.between(0, 30);
      timers.set(item, due);
      due_of[item] = due;
      expected.insert({due, item});
    }
    ASSERT_EQ(timers.empty(), expected.empty());
    ASSERT_EQ(timers.entries().size(), expected.size());
    ASSERT_EQ(timers.has(item), !removes);
    if (!removes) {
      ASSERT_EQ(timers.due(item), due_of[item]);
    }
    if (!expected.empty()) {
      ASSERT_EQ(timers.first_due(), expected.begin()->first);
      ASSERT_EQ(timers.first(), expected.begin()->second);
    }
  }
}

}  // namespace
}  // namespace cbc::timers_test
