#include "graph/graph.h"

#include <iterator>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/topological_sort.hpp>

namespace cbc {

std::vector<std::uint32_t> connected_components(std::size_t vertices, const Edges& edges) {
  const boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(
      edges.begin(), edges.end(), vertices);
  std::vector<std::uint32_t> component(vertices);
  boost::connected_components(graph, component.data());
  return component;
}

std::vector<std::uint32_t> reverse_topological_order(std::size_t vertices, const Edges& edges) {
  const boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                           boost::no_property, std::uint32_t>
      graph(boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(),
            static_cast<std::uint32_t>(vertices));
  std::vector<std::uint32_t> order;
  order.reserve(vertices);
  boost::topological_sort(graph, std::back_inserter(order));
  return order;
}

}  // namespace cbc
