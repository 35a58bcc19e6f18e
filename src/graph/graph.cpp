#include "graph/graph.h"

#include <iterator>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/connected_components.hpp>
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
  const boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(
      edges.begin(), edges.end(), vertices);
  std::vector<std::uint32_t> component(vertices);
  boost::connected_components(graph, component.data());
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
