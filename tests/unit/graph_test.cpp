#include "graph/graph.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace cbc {
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

TEST(Graph, TargetsComeBeforeSourcesInReverseTopologicalOrder) {
  const Edges edges{{3, 0}, {0, 4}, {3, 4}, {1, 3}, {4, 2}, {1, 2}, {3, 0}};
  const Vertices order = reverse_topological_order(5, edges);
  EXPECT_EQ(order, (Vertices{2, 4, 0, 3, 1})) << "the only order of this graph";
}

TEST(Graph, OrderHasEveryVertexOnce) {
  Vertices order = reverse_topological_order(5, {{1, 0}});
  const auto place = [&](std::uint32_t vertex) {
    return std::find(order.begin(), order.end(), vertex);
  };
  EXPECT_LT(place(0), place(1));
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (Vertices{0, 1, 2, 3, 4}));
  EXPECT_EQ(reverse_topological_order(0, {}), Vertices{});
}

}  // namespace
}  // namespace cbc
