// Breadth-first search over numbers instead of catalogs' states, against a plain one.
#include "verify/engine/breadth_first.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::breadth_first_test {
namespace {

using Number = StateStore::Number;

/// The successors of a number.
using Graph = std::function<std::vector<std::uint32_t>(std::uint32_t)>;

/// Four each, among numbers below `count`, one of them often the number itself.
Graph sparse(std::uint32_t count) {
  return [count](std::uint32_t state) -> std::vector<std::uint32_t> {
    return {state % 3 == 0 ? state : state / 2, (state * 3 + 1) % count, (state * 5 + 2) % count,
            (state + 1) % count};
  };
}

/// Thousands each, most of them several times.
Graph dense(std::uint32_t count) {
  return [count](std::uint32_t state) {
    std::vector<std::uint32_t> successors;
    for (std::uint32_t place = 0; place < 2500; ++place) {
      successors.push_back((state * 7 + place * place) % count);
    }
    return successors;
  };
}

class Numbers final : public Expander {
 public:
  /// `last`: the search is done with this state.
  explicit Numbers(Graph graph, Number last = UINT32_MAX) : graph_(std::move(graph)), last_(last) {}

  void expand(const std::uint32_t* state, Number number, Successors& successors) override {
    EXPECT_TRUE(numbers_.empty() || numbers_.back() < number);
    numbers_.push_back(number);
    for (const std::uint32_t next : graph_(*state)) {
      if (!successors.may_go_on()) return;
      if (next == *state) {
        successors.add_loop();
      } else {
        std::uint32_t* const words = successors.add();
        words[0] = next;
        words[1] = ~next;
      }
    }
  }
  [[nodiscard]] bool is_done() const override {
    return std::binary_search(numbers_.begin(), numbers_.end(), last_);
  }

  [[nodiscard]] const std::vector<Number>& numbers() const { return numbers_; }

 private:
  Graph graph_;
  Number last_;
  std::vector<Number> numbers_;
};

/// All that a search finds out, by number.
struct Found {
  std::vector<std::uint32_t> states;
  std::vector<Number> parents;
  std::vector<std::uint32_t> depths;
};

Found search_plainly(const Graph& graph) {
  Found found{{0}, {0}, {0}};
  std::map<std::uint32_t, Number> numbers{{0, 0}};
  for (Number number = 0; number < found.states.size(); ++number) {
    for (const std::uint32_t next : graph(found.states[number])) {
      if (!numbers.emplace(next, static_cast<Number>(found.states.size())).second) continue;
      found.states.push_back(next);
      found.parents.push_back(number);
      found.depths.push_back(found.depths[number] + 1);
    }
  }
  return found;
}

std::vector<std::unique_ptr<Expander>> expanders_for(const ExplorationOptions& options,
                                                     const Graph& graph) {
  std::vector<std::unique_ptr<Expander>> expanders;
  for (unsigned job = 0; job < options.jobs; ++job) {
    expanders.push_back(std::make_unique<Numbers>(graph));
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
  const auto run = [](const Graph& graph, std::uint32_t count, std::uint64_t moves) {
    const Found expected = search_plainly(graph);
    ASSERT_EQ(expected.states.size(), count);
    for (const unsigned jobs : {1U, 2U, 5U}) {
      ExplorationOptions options;
      options.jobs = jobs;
      BreadthFirst search({0, ~0U}, options);
      search.run(expanders_for(options, graph));
      EXPECT_TRUE(search.is_complete());
      EXPECT_EQ(search.store().size(), count);
      EXPECT_EQ(search.transitions(), count * moves);
      EXPECT_EQ(search.expanded_depth(), expected.depths.back());
      EXPECT_EQ(search.states_at_depth().size(), expected.depths.back() + std::size_t{1});
      expect_beginning(search, expected);
    }
  };
  run(sparse(all_numbers), all_numbers, 4);
  run(dense(1499), 1499, 2500);
}

TEST(BreadthFirst, EndsAtALimitWithWhatIsKnown) {
  const Graph graph = sparse(all_numbers);
  const Found expected = search_plainly(graph);
  const auto run = [&](ExplorationOptions options) {
    for (const unsigned jobs : {1U, 3U}) {
      options.jobs = jobs;
      BreadthFirst search({0, ~0U}, options);
      search.run(expanders_for(options, graph));
      EXPECT_FALSE(search.is_complete());
      EXPECT_LT(search.expanded(), search.store().size());
      EXPECT_EQ(search.transitions(), search.expanded() * std::uint64_t{4});
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

/// How far a search comes in the first state, which has a million moves.
std::uint32_t moves_before_the_end(const ExplorationOptions& options, std::size_t words,
                                   ExplorationEnd end) {
  class Endless final : public Expander {
   public:
    void expand(const std::uint32_t* /*state*/, Number /*number*/,
                Successors& successors) override {
      while (moves_ < 1'000'000 && successors.may_go_on()) *successors.add() = ++moves_;
    }
    [[nodiscard]] std::uint32_t moves() const { return moves_; }

   private:
    std::uint32_t moves_ = 0;
  };
  BreadthFirst search(std::vector<std::uint32_t>(words, 0), options);
  std::vector<std::unique_ptr<Expander>> expanders;
  auto expander = std::make_unique<Endless>();
  const Endless& endless = *expander;
  expanders.push_back(std::move(expander));
  search.run(expanders);
  EXPECT_FALSE(search.is_complete());
  EXPECT_TRUE(search.was_cut_short());
  EXPECT_EQ(search.end(), end);
  EXPECT_EQ(search.expanded(), 0U);
  EXPECT_EQ(search.store().size(), 1U);
  EXPECT_EQ(search.transitions(), 0U);
  return endless.moves();
}

TEST(BreadthFirst, EndsWithinAState) {
  ExplorationOptions asked;
  int looks = 0;
  asked.on_progress = [&looks](const ExplorationProgress& /*progress*/) { return ++looks < 10; };
  EXPECT_LT(moves_before_the_end(asked, 1, ExplorationEnd::stopped), 10'000U);
  EXPECT_EQ(looks, 10);

  // The successors alone take more than what the limit leaves beside the room for the next states.
  constexpr std::size_t words = 1000;
  ExplorationOptions memory;
  memory.limits.max_memory = StateStore(words).bytes_for(150'000) + (std::uint64_t{20} << 20U);
  EXPECT_LT(moves_before_the_end(memory, words, ExplorationEnd::max_memory), 10'000U);
}

TEST(BreadthFirst, ExpandsAllStatesBeforeTheOneThatEndsIt) {
  constexpr Number last = 40'000;
  for (const unsigned jobs : {1U, 3U}) {
    ExplorationOptions options;
    options.jobs = jobs;
    BreadthFirst search({0, ~0U}, options);
    std::vector<std::unique_ptr<Expander>> expanders;
    std::vector<const Numbers*> of_numbers;
    for (unsigned job = 0; job < jobs; ++job) {
      auto expander = std::make_unique<Numbers>(sparse(all_numbers), last);
      of_numbers.push_back(expander.get());
      expanders.push_back(std::move(expander));
    }
    search.run(expanders);
    EXPECT_FALSE(search.is_complete());
    EXPECT_FALSE(search.was_cut_short());
    std::vector<bool> is_expanded(all_numbers, false);
    for (const Numbers* const numbers : of_numbers) {
      for (const Number number : numbers->numbers()) is_expanded[number] = true;
    }
    EXPECT_EQ(std::count(is_expanded.begin(), is_expanded.begin() + last + 1, true), last + 1);
    EXPECT_LT(std::count(is_expanded.begin(), is_expanded.end(), true), all_numbers);
  }
}

TEST(BreadthFirst, AStateWithoutSuccessorsIsAll) {
  ExplorationOptions options;
  BreadthFirst search({0, ~0U}, options);
  search.run(expanders_for(options, sparse(1)));
  EXPECT_TRUE(search.is_complete());
  EXPECT_EQ(search.transitions(), 4U);
  EXPECT_EQ(search.expanded_depth(), 0U);
  EXPECT_EQ(search.states_at_depth(), std::vector<std::uint64_t>{1});
}

}  // namespace
}  // namespace cbc::breadth_first_test
