#include "graph/graph.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <boost/graph/topological_sort.hpp>

namespace cbc {
namespace {

using Directed =
    boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                       boost::no_property, std::uint32_t>;

Directed to_directed(std::size_t vertices, const Edges& edges) {
  return {boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(),
          static_cast<std::uint32_t>(vertices)};
}

}  // namespace

std::vector<std::uint32_t> connected_components(std::size_t vertices, const Edges& edges) {
  // Trees of which the root is the first vertex. Boost's graph would need a list for each vertex.
  std::vector<std::uint32_t> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0U);
  const auto find_root = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  for (const auto& [from, to] : edges) {
    const std::uint32_t a = find_root(from);
    const std::uint32_t b = find_root(to);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> component(vertices);
  std::uint32_t count = 0;
  for (std::uint32_t vertex = 0; vertex < vertices; ++vertex) {
    component[vertex] = parent[vertex] == vertex ? count++ : component[parent[vertex]];
  }
  return component;
}

std::vector<std::uint32_t> strong_components(std::size_t vertices, const Edges& edges) {
  const Directed graph = to_directed(vertices, edges);
  std::vector<std::uint32_t> component(vertices);
  boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, graph)));
  return component;
}

std::vector<std::uint32_t> reverse_topological_order(std::size_t vertices, const Edges& edges) {
  std::vector<std::uint32_t> order;
  order.reserve(vertices);
  const Directed graph = to_directed(vertices, edges);
  boost::topological_sort(graph, std::back_inserter(order));
  return order;
}

}  // namespace cbc
