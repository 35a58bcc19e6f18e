#include "core/files/ordered_work.h"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace cbc::cli::ordered_work_test {
namespace {

/// Later items are done earlier, as far as threads are free.
std::size_t make_out_of_order(std::size_t number) {
  std::this_thread::sleep_for(std::chrono::microseconds(number % 7 == 0 ? 300 : 0));
  return number * number;
}

TEST(OrderedWork, HandsOutInOrder) {
  for (const std::size_t threads : {1U, 2U, 5U}) {
    OrderedWork<std::size_t> work(200, threads, make_out_of_order);
    for (std::size_t number = 0; number < 200; ++number) EXPECT_EQ(work.take(), number * number);
  }
}

TEST(OrderedWork, DoesEachItemOnce) {
  std::atomic<std::size_t> made{0};
  OrderedWork<int> work(50, 3, [&](std::size_t) {
    ++made;
    return 0;
  });
  for (int number = 0; number < 50; ++number) static_cast<void>(work.take());
  EXPECT_EQ(made, 50U);
}

TEST(OrderedWork, IsNotFarAhead) {
  constexpr std::size_t threads = 2;
  constexpr std::size_t most_ahead = threads * 4;
  std::atomic<std::size_t> made{0};
  OrderedWork<int> work(100, threads, [&](std::size_t) {
    ++made;
    return 0;
  });
  for (std::size_t taken = 0; taken < 100; ++taken) {
    EXPECT_LE(made, taken + most_ahead);
    static_cast<void>(work.take());
  }
}

TEST(OrderedWork, ThrowsWhatTheMakingOfAnItemThrew) {
  OrderedWork<int> work(20, 2, [](std::size_t number) {
    if (number == 3) throw std::runtime_error("three");
    return 0;
  });
  for (int number = 0; number < 3; ++number) EXPECT_EQ(work.take(), 0);
  EXPECT_THROW(static_cast<void>(work.take()), std::runtime_error);
  EXPECT_EQ(work.take(), 0);
}

TEST(OrderedWork, MayBeLeftBeforeItsEnd) {
  OrderedWork<int> work(1000, 2, [](std::size_t) { return 0; });
  EXPECT_EQ(work.take(), 0);
}

TEST(OrderedWork, SaysWhetherAnItemIsThere) {
  std::atomic<bool> may_go_on{false};
  OrderedWork<int> work(1, 2, [&](std::size_t) {
    while (!may_go_on) std::this_thread::yield();
    return 0;
  });
  EXPECT_FALSE(work.wait_for(std::chrono::milliseconds(0)));
  may_go_on = true;
  while (!work.wait_for(std::chrono::milliseconds(1))) {
  }
  EXPECT_EQ(work.take(), 0);
}

TEST(OrderedWork, StartsNoThreadForOne) {
  const std::thread::id here = std::this_thread::get_id();
  OrderedWork<std::thread::id> work(2, 1, [](std::size_t) { return std::this_thread::get_id(); });
  EXPECT_TRUE(work.wait_for(std::chrono::milliseconds(0)));
  EXPECT_EQ(work.take(), here);
  EXPECT_EQ(work.take(), here);
}

}  // namespace
}  // namespace cbc::cli::ordered_work_test
