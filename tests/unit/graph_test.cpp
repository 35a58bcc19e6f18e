#include "core/support/graph.h"

#include <gtest/gtest.h>

namespace cbc::graph_test {
namespace {

using Vertices = std::vector<std::uint32_t>;

TEST(Graph, NoVerticesHaveNoComponents) { EXPECT_EQ(connected_components(0, {}), Vertices{}); }

TEST(Graph, ComponentsCountFromZeroByTheirFirstVertex) {
  EXPECT_EQ(connected_components(6, {{5, 1}, {4, 2}, {2, 0}}), (Vertices{0, 1, 0, 2, 0, 1}));
}

TEST(Graph, EdgesOfComponentsHaveNoDirection) {
  EXPECT_EQ(connected_components(3, {{0, 2}, {1, 2}}), (Vertices{0, 0, 0}));
}

TEST(Graph, LoopsAndRepeatedEdgesJoinNothingElse) {
  EXPECT_EQ(connected_components(3, {{1, 1}, {0, 2}, {2, 0}, {0, 2}}), (Vertices{0, 1, 0}));
}

TEST(Graph, LongPathsInAnyOrderAreOneComponent) {
  constexpr std::uint32_t vertices = 100'000;
  Edges edges;
  for (std::uint32_t vertex = 0; vertex + 2 < vertices; ++vertex) {
    edges.emplace_back(vertices - 1 - vertex, vertices - 3 - vertex);
  }
  const Vertices component = connected_components(vertices, edges);
  for (std::uint32_t vertex = 0; vertex < vertices; ++vertex) {
    ASSERT_EQ(component[vertex], vertex % 2);
  }
}

TEST(Graph, EdgesWithinCyclesAreNotTransitive) {
  using Answer = std::vector<bool>;
  // 0, 1 and 2 require one another; that 0 leads to 3 follows from the path by 4.
  EXPECT_EQ(transitive_edges(5, {{0, 1}, {1, 2}, {2, 0}, {0, 2}, {0, 3}, {1, 4}, {4, 3}}),
            (Answer{false, false, false, false, true, false, false}));
}

TEST(Graph, TransitiveEdgesAreThoseThatReachabilityHasAnyway) {
  std::uint32_t state = 1;
  const auto draw = [&](std::uint32_t bound) {
    state = state * 1664525U + 1013904223U;
    return (state >> 16U) % bound;
  };
  for (int round = 0; round < 300; ++round) {
    const std::uint32_t vertices = 2 + draw(8);
    Edges edges;
    for (std::uint32_t from = 0; from < vertices; ++from) {
      for (std::uint32_t to = from + 1; to < vertices; ++to) {
        if (draw(100) < 40) edges.emplace_back(from, to);
      }
    }
    const std::vector<bool> answer = transitive_edges(vertices, edges);
    for (std::size_t left_out = 0; left_out < edges.size(); ++left_out) {
      // Without the edge, in order: what its source still reaches.
      std::vector<bool> reached(vertices);
      reached[edges[left_out].first] = true;
      for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i != left_out && reached[edges[i].first]) reached[edges[i].second] = true;
      }
      ASSERT_EQ(answer[left_out], reached[edges[left_out].second]);
    }
  }
}

}  // namespace
}  // namespace cbc::graph_test
