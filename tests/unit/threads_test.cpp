#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/support/system.h"

namespace cbc::threads_test {
namespace {

TEST(Threads, EachDoesItsShareOnce) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{9}}) {
    std::vector<std::atomic<int>> calls(count);
    std::vector<std::thread::id> threads(count);
    run_in_threads(count, [&](std::size_t number) {
      ++calls.at(number);
      threads.at(number) = std::this_thread::get_id();
    });
    for (std::size_t number = 0; number < count; ++number) {
      EXPECT_EQ(calls[number], 1);
      EXPECT_EQ(threads[number] == std::this_thread::get_id(), number == 0) << number;
    }
  }
}

TEST(Threads, AnErrorWaitsForTheOthers) {
  std::atomic<int> calls{0};
  try {
    run_in_threads(6, [&](std::size_t number) {
      if (number == 3 || number == 5) throw std::runtime_error(std::to_string(number));
      std::this_thread::yield();
      ++calls;
    });
    ADD_FAILURE() << "nothing is thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "3");
  }
  EXPECT_EQ(calls, 4);
}

TEST(Threads, AnErrorOfThisThreadWaitsForTheOthers) {
  std::atomic<int> calls{0};
  EXPECT_THROW(run_in_threads(4,
                              [&](std::size_t number) {
                                if (number == 0) throw std::runtime_error("first");
                                ++calls;
                              }),
               std::runtime_error);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace cbc::threads_test
