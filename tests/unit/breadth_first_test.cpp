// Breadth-first search over numbers instead of catalogs' states, against a plain one.
#include "verify/breadth_first.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace cbc {
namespace {

using Number = StateStore::Number;

/// The successors of a number below `count`, one of them often itself.
std::array<std::uint32_t, 4> successors_of(std::uint32_t state, std::uint32_t count) {
  return {state % 3 == 0 ? state : state / 2, (state * 3 + 1) % count, (state * 5 + 2) % count,
          (state + 1) % count};
}

class Numbers final : public Expander {
 public:
  explicit Numbers(std::uint32_t count) : count_(count) {}

  void expand(const std::uint32_t* state, Number number, Successors& successors) override {
    EXPECT_TRUE(numbers_.empty() || numbers_.back() < number);
    numbers_.push_back(number);
    for (const std::uint32_t next : successors_of(*state, count_)) {
      if (next == *state) {
        successors.add_loop();
      } else {
        std::uint32_t* const words = successors.add();
        words[0] = next;
        words[1] = ~next;
      }
    }
  }

 private:
  std::uint32_t count_;
  std::vector<Number> numbers_;
};

/// All that a search finds out, by number.
struct Found {
  std::vector<std::uint32_t> states;
  std::vector<Number> parents;
  std::vector<std::uint32_t> depths;
};

Found search_plainly(std::uint32_t count) {
  Found found{{0}, {0}, {0}};
  std::map<std::uint32_t, Number> numbers{{0, 0}};
  for (Number number = 0; number < found.states.size(); ++number) {
    for (const std::uint32_t next : successors_of(found.states[number], count)) {
      if (!numbers.emplace(next, static_cast<Number>(found.states.size())).second) continue;
      found.states.push_back(next);
      found.parents.push_back(number);
      found.depths.push_back(found.depths[number] + 1);
    }
  }
  return found;
}

std::vector<std::unique_ptr<Expander>> expanders_for(const ExplorationOptions& options,
                                                     std::uint32_t count) {
  std::vector<std::unique_ptr<Expander>> expanders;
  for (unsigned job = 0; job < options.jobs; ++job) {
    expanders.push_back(std::make_unique<Numbers>(count));
  }
  return expanders;
}

/// The states that the search knows must be the first of the plain one, with the same paths.
void expect_beginning(const BreadthFirst& search, const Found& expected) {
  const StateStore& store = search.store();
  ASSERT_LE(store.size(), expected.states.size());
  for (Number number = 0; number < store.size(); ++number) {
    ASSERT_EQ(store.state(number)[0], expected.states[number]);
    ASSERT_EQ(store.parent(number), expected.parents[number]);
    ASSERT_EQ(search.depth_of(number), expected.depths[number]);
  }
  const std::vector<Number> path = search.path_to(store.size() - 1);
  EXPECT_EQ(path.size(), expected.depths[store.size() - 1] + 1);
  EXPECT_EQ(path.front(), 0U);
  EXPECT_EQ(search.transitions(), search.expanded() * std::uint64_t{4});
  const std::vector<std::uint64_t> counts = search.states_at_depth();
  for (std::uint32_t depth = 0; depth < counts.size(); ++depth) {
    EXPECT_EQ(counts[depth], static_cast<std::uint64_t>(std::count(expected.depths.begin(),
                                                                   expected.depths.end(), depth)));
  }
  // What comes next is not expanded yet, or another depth.
  const std::uint32_t depth = search.expanded_depth();
  const auto end = std::upper_bound(expected.depths.begin(), expected.depths.end(), depth);
  EXPECT_LE(end - expected.depths.begin(), search.expanded());
}

constexpr std::uint32_t all_numbers = 100'000;

TEST(BreadthFirst, FindsTheSameWithAnyNumberOfJobs) {
  const Found expected = search_plainly(all_numbers);
  ASSERT_EQ(expected.states.size(), all_numbers);
  for (const unsigned jobs : {1U, 2U, 5U}) {
    ExplorationOptions options;
    options.jobs = jobs;
    BreadthFirst search({0, ~0U}, options);
    search.run(expanders_for(options, all_numbers));
    EXPECT_TRUE(search.is_complete());
    EXPECT_EQ(search.store().size(), all_numbers);
    EXPECT_EQ(search.expanded_depth(), expected.depths.back());
    EXPECT_EQ(search.states_at_depth().size(), expected.depths.back() + std::size_t{1});
    expect_beginning(search, expected);
  }
}

TEST(BreadthFirst, EndsAtALimitWithWhatIsKnown) {
  const Found expected = search_plainly(all_numbers);
  const auto run = [&](ExplorationOptions options) {
    for (const unsigned jobs : {1U, 3U}) {
      options.jobs = jobs;
      BreadthFirst search({0, ~0U}, options);
      search.run(expanders_for(options, all_numbers));
      EXPECT_FALSE(search.is_complete());
      EXPECT_LT(search.expanded(), search.store().size());
      expect_beginning(search, expected);
    }
  };
  ExplorationOptions states;
  states.limits.max_states = 30'000;
  run(states);
  ExplorationOptions memory;
  memory.limits.max_memory = 4'000'000;
  run(memory);
  ExplorationOptions asked;
  asked.on_progress = [](const ExplorationProgress& progress) { return progress.depth < 10; };
  run(asked);
}

TEST(BreadthFirst, AStateWithoutSuccessorsIsAll) {
  ExplorationOptions options;
  BreadthFirst search({0, ~0U}, options);
  search.run(expanders_for(options, 1));
  EXPECT_TRUE(search.is_complete());
  EXPECT_EQ(search.transitions(), 4U);
  EXPECT_EQ(search.expanded_depth(), 0U);
  EXPECT_EQ(search.states_at_depth(), std::vector<std::uint64_t>{1});
}

}  // namespace
}  // namespace cbc
