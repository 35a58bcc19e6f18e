// Breadth-first search over numbers instead of catalogs' states, against a plain one.
#include "coverage/engine/breadth_first.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
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

 private:
  Graph graph_;
  std::vector<std::uint32_t> successors_;
  std::uint32_t next_ = 0;
};

class Visitor {
 public:
  explicit Visitor(Graph graph) : system_(std::move(graph)) {}

  [[nodiscard]] Numbers& system() { return system_; }
  void visit(Number number) {
    EXPECT_EQ(number, numbers_.size());
    numbers_.push_back(number);
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
  std::vector<Number> numbers_;
  std::map<std::uint32_t, Number> reached_;
};

/// The states in the order in which they are found.
std::vector<std::uint32_t> search_plainly(const Graph& graph) {
  std::vector<std::uint32_t> states{0};
  std::set<std::uint32_t> known{0};
  for (std::size_t place = 0; place < states.size(); ++place) {
    for (const std::uint32_t next : graph(states[place])) {
      if (known.insert(next).second) states.push_back(next);
    }
  }
  return states;
}

/// The states that the search knows must be the first of the plain one.
void expect_beginning(const BreadthFirst& search, const std::vector<std::uint32_t>& expected) {
  const StateStore& store = search.store();
  ASSERT_LE(store.size(), expected.size());
  for (Number number = 0; number < store.size(); ++number) {
    ASSERT_EQ(store.state(number)[0], expected[number]);
    ASSERT_EQ(store.state(number)[1], ~expected[number]);
  }
}

constexpr std::uint32_t all_numbers = 100'000;

TEST(BreadthFirst, FindsStatesInTheOrderOfMoves) {
  const auto find = [](const Graph& graph, std::uint32_t count, std::uint64_t moves) {
    const std::vector<std::uint32_t> expected = search_plainly(graph);
    ASSERT_EQ(expected.size(), count);
    Visitor visitor(graph);
    BreadthFirst search({0, ~0U}, {}, {});
    search.run(visitor);
    EXPECT_TRUE(search.is_complete());
    EXPECT_FALSE(search.end());
    EXPECT_EQ(search.store().size(), count);
    EXPECT_EQ(search.transitions(), count * moves);
    EXPECT_EQ(visitor.numbers().size(), count);
    expect_beginning(search, expected);
    for (const auto& [state, number] : visitor.reached()) ASSERT_EQ(expected[number], state);
  };
  find(sparse(all_numbers), all_numbers, 4);
  find(dense(1499), 1499, 2500);
}

TEST(BreadthFirst, EndsAtALimitWithWhatIsKnown) {
  const Graph graph = sparse(all_numbers);
  const std::vector<std::uint32_t> expected = search_plainly(graph);
  const auto find = [&](const BreadthFirst::Limits& limits, const BreadthFirst::OnProgress& asked,
                        Budget::End end) {
    Visitor visitor(graph);
    BreadthFirst search({0, ~0U}, limits, asked);
    search.run(visitor);
    EXPECT_FALSE(search.is_complete());
    EXPECT_EQ(search.end(), end);
    // The last state was visited, but the limit came before its moves.
    EXPECT_EQ(search.transitions(), (visitor.numbers().size() - 1) * 4);
    expect_beginning(search, expected);
  };
  find({.max_states = 30'000}, {}, Budget::End::max_states);
  find({.max_memory = 1'500'000}, {}, Budget::End::max_memory);
  find(
      {}, [](std::uint64_t states) { return states < 10'000; }, Budget::End::stopped);
}

TEST(BreadthFirst, ALimitCountsPartsOfStates) {
  Visitor visitor(dense(1499));
  BreadthFirst search({0, ~0U}, {.max_states = 200}, {});
  search.run(visitor);
  EXPECT_FALSE(search.is_complete());
  EXPECT_EQ(search.end(), Budget::End::max_states);
  EXPECT_GE(search.store().size(), 200U);
  EXPECT_LT(search.transitions(), 2500U);
  EXPECT_EQ(search.transitions() % 64, 0U);
  EXPECT_EQ(visitor.numbers(), std::vector<Number>{0});
}

TEST(BreadthFirst, AsksWithinAState) {
  int looks = 0;
  Visitor visitor(dense(1499));
  BreadthFirst search({0, ~0U}, {}, [&looks](std::uint64_t /*states*/) { return ++looks < 10; });
  search.run(visitor);
  EXPECT_EQ(search.end(), Budget::End::stopped);
  EXPECT_EQ(looks, 10);
  EXPECT_EQ(search.transitions(), 9U * 64);
}

TEST(BreadthFirst, AStateWithoutSuccessorsIsAll) {
  Visitor visitor(sparse(1));
  BreadthFirst search({0, ~0U}, {}, {});
  search.run(visitor);
  EXPECT_TRUE(search.is_complete());
  EXPECT_EQ(search.transitions(), 4U);
  EXPECT_EQ(search.store().size(), 1U);
}

}  // namespace
}  // namespace cbc::breadth_first_test
