#include <array>
#include <optional>

#include <gtest/gtest.h>

#include "graph/engine/catalog_graph.h"

namespace cbc::draw::mark_test {
namespace {

constexpr std::array bits = {false, true};

// A link is a set of instants, before and after the event: several of them are as a union, one
// through another as an intersection.
TEST(Mark, UseIsCombinedInstantByInstant) {
  for (const bool a_was : bits) {
    for (const bool a_is : bits) {
      for (const bool b_was : bits) {
        for (const bool b_is : bits) {
          const Mark a = mark_of_use(a_was, a_is);
          const Mark b = mark_of_use(b_was, b_is);
          EXPECT_EQ(combine(a, b), mark_of_use(a_was || b_was, a_is || b_is));
          EXPECT_EQ(join(a, b), std::optional(mark_of_use(a_was && b_was, a_is && b_is)));
          EXPECT_EQ(use_of(a), a);
        }
      }
    }
  }
}

TEST(Mark, OfUseHasAName) {
  EXPECT_EQ(name_of(mark_of_use(true, true)), "active");
  EXPECT_EQ(name_of(mark_of_use(false, true)), "started");
  EXPECT_EQ(name_of(mark_of_use(true, false)), "stopped");
  EXPECT_EQ(name_of(mark_of_use(false, false)), "");
}

// What exclusive tasks are to one another goes on, whether they run or not.
TEST(Mark, PlainLinesStayPlainBesideIdleOnes) {
  EXPECT_EQ(combine(Mark::plain, Mark::faint), Mark::plain);
  EXPECT_EQ(join(Mark::plain, Mark::faint), Mark::plain);
  EXPECT_EQ(join(Mark::faint, Mark::faint), Mark::faint);
}

// Faults of a link do not carry over, nor do changes of its numbers.
TEST(Mark, OnlyPresenceAndUseCarryOver) {
  EXPECT_EQ(use_of(Mark::faulty), Mark::plain);
  EXPECT_EQ(use_of(Mark::changed), Mark::plain);
  EXPECT_EQ(use_of(Mark::added), Mark::added);
  EXPECT_EQ(use_of(Mark::removed), Mark::removed);
}

}  // namespace
}  // namespace cbc::draw::mark_test
