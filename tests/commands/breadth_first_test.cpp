// Breadth-first search over numbers instead of catalogs' states, against a plain one.
#include "verify/engine/breadth_first.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
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

/// A system of two words: a number and its complement. A choice is the number that comes next.
class Numbers {
 public:
  explicit Numbers(Graph graph) : graph_(std::move(graph)) {}

  void load(const std::uint32_t* state) { successors_ = graph_(*state); }
  [[nodiscard]] const std::vector<std::uint32_t>& choices() const { return successors_; }
  [[nodiscard]] bool try_move(std::uint32_t next) {
    next_ = next;
    return true;
  }
  void pack(std::uint32_t* words) const {
    words[0] = next_;
    words[1] = ~next_;
  }
  [[nodiscard]] std::uint32_t move_of(std::uint32_t next) const { return next; }

 private:
  Graph graph_;
  std::vector<std::uint32_t> successors_;
  std::uint32_t next_ = 0;
};

class Visitor {
 public:
  /// `last`: the search is done with this state.
  explicit Visitor(Graph graph, Number last = UINT32_MAX)
      : system_(std::move(graph)), last_(last) {}

  [[nodiscard]] Numbers& system() { return system_; }
  [[nodiscard]] bool is_done() const { return is_done_; }
  void visit(Number number, Successors& /*successors*/) {
    EXPECT_TRUE(numbers_.empty() || numbers_.back() < number);
    numbers_.push_back(number);
    is_done_ = number == last_;
  }
  void on_move(Number number, std::uint32_t next, const std::uint32_t* successor) {
    EXPECT_EQ(number, numbers_.back());
    EXPECT_EQ(successor[0], next);
    EXPECT_EQ(successor[1], ~next);
  }
  void on_move(Number number, std::uint32_t next, Number to) {
    EXPECT_EQ(number, numbers_.back());
    EXPECT_EQ(reached_.emplace(next, to).first->second, to);
  }

  [[nodiscard]] const std::vector<Number>& numbers() const { return numbers_; }
  /// By state: the number that it was said to have.
  [[nodiscard]] const std::map<std::uint32_t, Number>& reached() const { return reached_; }

 private:
  Numbers system_;
  Number last_;
  bool is_done_ = false;
  std::vector<Number> numbers_;
  std::map<std::uint32_t, Number> reached_;
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

void run(BreadthFirst& search, const Graph& graph, unsigned jobs) {
  std::deque<Visitor> visitors;
  while (visitors.size() < jobs) visitors.emplace_back(graph);
  search.run(visitors);
}

/// The states that the search knows must be the first of the plain one, with the same paths.
void expect_beginning(const BreadthFirst& search, const Graph& graph, const Found& expected) {
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
  Numbers system(graph);
  const std::vector<std::uint32_t> moves = search.moves_to(system, store.size() - 1);
  ASSERT_EQ(moves.size() + 1, path.size());
  for (std::size_t place = 0; place < moves.size(); ++place) {
    EXPECT_EQ(moves[place], expected.states[path[place + 1]]);
  }
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
  const auto find = [](const Graph& graph, std::uint32_t count, std::uint64_t moves) {
    const Found expected = search_plainly(graph);
    ASSERT_EQ(expected.states.size(), count);
    for (const unsigned jobs : {0U, 1U, 2U, 5U}) {
      BreadthFirst search({0, ~0U}, {}, {});
      if (jobs > 0) {
        run(search, graph, jobs);
      } else {
        Visitor visitor(graph);
        search.run_in_order(visitor);
        for (const auto& [state, number] : visitor.reached()) {
          ASSERT_EQ(expected.states[number], state);
        }
      }
      EXPECT_TRUE(search.is_complete());
      EXPECT_EQ(search.store().size(), count);
      EXPECT_EQ(search.transitions(), count * moves);
      EXPECT_EQ(search.expanded_depth(), expected.depths.back());
      EXPECT_EQ(search.states_at_depth().size(), expected.depths.back() + std::size_t{1});
      expect_beginning(search, graph, expected);
    }
  };
  find(sparse(all_numbers), all_numbers, 4);
  find(dense(1499), 1499, 2500);
}

TEST(BreadthFirst, EndsAtALimitWithWhatIsKnown) {
  const Graph graph = sparse(all_numbers);
  const Found expected = search_plainly(graph);
  const auto find = [&](const ExplorationLimits& limits, const BreadthFirst::OnProgress& asked) {
    for (const unsigned jobs : {1U, 3U}) {
      BreadthFirst search({0, ~0U}, limits, asked);
      run(search, graph, jobs);
      EXPECT_FALSE(search.is_complete());
      EXPECT_LT(search.expanded(), search.store().size());
      EXPECT_EQ(search.transitions(), search.expanded() * std::uint64_t{4});
      expect_beginning(search, graph, expected);
    }
  };
  find({.max_states = 30'000}, {});
  find({.max_memory = 4'000'000}, {});
  find({}, [](const ExplorationProgress& progress) { return progress.depth < 10; });
}

TEST(BreadthFirst, InOrderALimitCountsPartsOfStates) {
  const Graph graph = dense(1499);
  Visitor visitor(graph);
  BreadthFirst search({0, ~0U}, {.max_states = 200}, {});
  search.run_in_order(visitor);
  EXPECT_FALSE(search.is_complete());
  EXPECT_EQ(search.end(), ExplorationEnd::max_states);
  EXPECT_GE(search.store().size(), 200U);
  EXPECT_LT(search.transitions(), 2500U);
  EXPECT_EQ(search.transitions() % 64, 0U);
  EXPECT_EQ(visitor.numbers(), std::vector<Number>{0});
}

/// How far a search comes in the first state, which has a million moves.
std::uint32_t moves_before_the_end(const ExplorationLimits& limits,
                                   const BreadthFirst::OnProgress& on_progress, std::size_t words,
                                   ExplorationEnd end) {
  class Endless {
   public:
    Endless() : choices_(1'000'000) {}
    [[nodiscard]] Endless& system() { return *this; }
    [[nodiscard]] bool is_done() const { return false; }
    void load(const std::uint32_t* /*state*/) {}
    [[nodiscard]] const std::vector<std::uint8_t>& choices() const { return choices_; }
    [[nodiscard]] bool try_move(std::uint8_t /*choice*/) { return ++moves_ != 0; }
    void pack(std::uint32_t* words) const { *words = moves_; }
    [[nodiscard]] std::uint8_t move_of(std::uint8_t choice) const { return choice; }
    void visit(Number /*number*/, Successors& /*successors*/) {}
    void on_move(Number /*number*/, std::uint8_t /*choice*/, const std::uint32_t* /*words*/) {}
    [[nodiscard]] std::uint32_t moves() const { return moves_; }

   private:
    std::vector<std::uint8_t> choices_;
    std::uint32_t moves_ = 0;
  };
  BreadthFirst search(std::vector<std::uint32_t>(words, 0), limits, on_progress);
  std::deque<Endless> endless(1);
  search.run(endless);
  EXPECT_FALSE(search.is_complete());
  EXPECT_TRUE(search.was_cut_short());
  EXPECT_EQ(search.end(), end);
  EXPECT_EQ(search.expanded(), 0U);
  EXPECT_EQ(search.store().size(), 1U);
  EXPECT_EQ(search.transitions(), 0U);
  return endless.front().moves();
}

TEST(BreadthFirst, EndsWithinAState) {
  int looks = 0;
  const auto asked = [&looks](const ExplorationProgress& /*progress*/) { return ++looks < 10; };
  EXPECT_LT(moves_before_the_end({}, asked, 1, ExplorationEnd::stopped), 10'000U);
  EXPECT_EQ(looks, 10);

  // The successors alone take more than what the limit leaves beside the room for the next states.
  constexpr std::size_t words = 1000;
  const std::uint64_t memory = StateStore(words).bytes_for(150'000) + (std::uint64_t{20} << 20U);
  EXPECT_LT(moves_before_the_end({.max_memory = memory}, {}, words, ExplorationEnd::max_memory),
            10'000U);
}

TEST(BreadthFirst, ExpandsAllStatesBeforeTheOneThatEndsIt) {
  constexpr Number last = 40'000;
  for (const unsigned jobs : {1U, 3U}) {
    BreadthFirst search({0, ~0U}, {}, {});
    std::deque<Visitor> visitors;
    while (visitors.size() < jobs) visitors.emplace_back(sparse(all_numbers), last);
    search.run(visitors);
    EXPECT_FALSE(search.is_complete());
    EXPECT_FALSE(search.was_cut_short());
    std::vector<bool> is_expanded(all_numbers, false);
    for (const Visitor& visitor : visitors) {
      for (const Number number : visitor.numbers()) is_expanded[number] = true;
    }
    EXPECT_EQ(std::count(is_expanded.begin(), is_expanded.begin() + last + 1, true), last + 1);
    EXPECT_LT(std::count(is_expanded.begin(), is_expanded.end(), true), all_numbers);
  }
}

TEST(BreadthFirst, AStateWithoutSuccessorsIsAll) {
  BreadthFirst search({0, ~0U}, {}, {});
  run(search, sparse(1), 1);
  EXPECT_TRUE(search.is_complete());
  EXPECT_EQ(search.transitions(), 4U);
  EXPECT_EQ(search.expanded_depth(), 0U);
  EXPECT_EQ(search.states_at_depth(), std::vector<std::uint64_t>{1});
}

}  // namespace
}  // namespace cbc::breadth_first_test
