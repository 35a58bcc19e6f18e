#include "explore/sets/state_store.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::state_store_test {
namespace {

/// A state of three words that only `number` has.
std::vector<std::uint32_t> state_of(std::uint32_t number) {
  return {number % 7, number / 7 * 2654435761U, number};
}

TEST(StateStore, KeepsWhatItFoundWhileItGrows) {
  constexpr std::uint32_t count = 150'000;  // more than two segments
  StateStore store(3);
  std::uint32_t expected = 0;
  for (std::uint32_t number = 0; number < count; ++number) {
    const std::vector<std::uint32_t> state = state_of(number);
    ASSERT_EQ(store.insert(state.data(), store.hash(state.data())), number);
    // One of those before is known.
    const std::vector<std::uint32_t> known = state_of(number * 7 / 11);
    ASSERT_EQ(store.insert(known.data(), store.hash(known.data())), number * 7 / 11);
    ASSERT_EQ(store.size(), ++expected);
  }
  for (std::uint32_t number = 0; number < count; ++number) {
    const std::vector<std::uint32_t> state = state_of(number);
    ASSERT_EQ(store.find(state.data(), store.hash(state.data())), number);
    ASSERT_EQ(std::vector<std::uint32_t>(store.state(number), store.state(number) + 3), state);
    const std::vector<std::uint32_t> other = state_of(number + count);
    ASSERT_FALSE(store.find(other.data(), store.hash(other.data()))) << number;
  }
}

TEST(StateStore, FullBucketsOverflowIntoTheNext) {
  StateStore store(3);
  // Of a new store's buckets the last is full after 12 states, so the first ones follow.
  constexpr std::uint64_t same_hash = ~std::uint64_t{0};
  constexpr std::uint32_t count = 100;
  for (std::uint32_t number = 0; number < count; ++number) {
    const std::vector<std::uint32_t> state = state_of(number);
    ASSERT_FALSE(store.find(state.data(), same_hash));
    ASSERT_EQ(store.insert(state.data(), same_hash), number);
    ASSERT_EQ(store.insert(state.data(), same_hash), number);
  }
  EXPECT_EQ(store.size(), count);
  for (std::uint32_t number = 0; number < count; ++number) {
    EXPECT_EQ(store.find(state_of(number).data(), same_hash), number);
  }
  EXPECT_FALSE(store.find(state_of(count).data(), same_hash));
}

TEST(StateStore, CountsStatesAndIndex) {
  constexpr std::uint32_t count = 65'536 * 3;  // whole segments
  StateStore store(3);
  for (std::uint32_t number = 0; number < count; ++number) {
    const std::vector<std::uint32_t> state = state_of(number);
    store.insert(state.data(), store.hash(state.data()));
  }
  // 12 bytes of a state, and 64 of a bucket for 5 to 10 states.
  EXPECT_GE(store.bytes(), count * std::uint64_t{12} + count / 10 * std::uint64_t{64});
  EXPECT_LE(store.bytes(), count * std::uint64_t{12} + count / 5 * std::uint64_t{64});
}

}  // namespace
}  // namespace cbc::state_store_test
