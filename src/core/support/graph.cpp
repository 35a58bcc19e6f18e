#include "core/support/graph.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>
#include <boost/graph/topological_sort.hpp>

#include "runtime/base/disjoint_sets.h"

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
  DisjointSets sets(vertices);
  for (const auto& [from, to] : edges) sets.join(from, to);
  return sets.numbers();
}

std::vector<std::uint32_t> strong_components(std::size_t vertices, const Edges& edges) {
  const Directed graph = to_directed(vertices, edges);
  std::vector<std::uint32_t> component(vertices);
  boost::strong_components(
      graph, boost::make_iterator_property_map(component.begin(), get(boost::vertex_index, graph)));
  return component;
}

namespace {

using Vertex = std::uint32_t;

/// An acyclic graph, with the length of the longest path that begins at each vertex. A path only
/// leads to vertices of which the longest paths are shorter, so most searches end soon.
class Search {
 public:
  Search(std::size_t vertices, Edges edges)
      : edges_(std::move(edges)), height_(vertices), visit_(vertices) {
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    std::vector<Vertex> order;  // sources after their targets
    const Directed graph = to_directed(vertices, edges_);
    boost::topological_sort(graph, std::back_inserter(order));
    for (const Vertex vertex : order) {
      for (auto edge = first_edge(vertex); is_of(edge, vertex); ++edge) {
        height_[vertex] = std::max(height_[vertex], height_[edge->second] + 1);
      }
    }
  }

  /// Whether a path of two edges or more leads from one vertex to another.
  bool has_detour(Vertex from, Vertex to) {
    ++visits_;
    std::vector<Vertex> stack;
    const auto visit = [&](Vertex vertex) {
      if (height_[vertex] <= height_[to] || visit_[vertex] == visits_) return;
      visit_[vertex] = visits_;
      stack.push_back(vertex);
    };
    for (auto edge = first_edge(from); is_of(edge, from); ++edge) visit(edge->second);
    while (!stack.empty()) {
      const Vertex vertex = stack.back();
      stack.pop_back();
      for (auto edge = first_edge(vertex); is_of(edge, vertex); ++edge) {
        if (edge->second == to) return true;
        visit(edge->second);
      }
    }
    return false;
  }

 private:
  [[nodiscard]] Edges::const_iterator first_edge(Vertex vertex) const {
    return std::lower_bound(edges_.begin(), edges_.end(), std::pair(vertex, Vertex{0}));
  }
  [[nodiscard]] bool is_of(Edges::const_iterator edge, Vertex vertex) const {
    return edge != edges_.end() && edge->first == vertex;
  }

  Edges edges_;
  std::vector<std::size_t> height_;
  std::vector<std::size_t> visit_;  ///< the last search that visited it
  std::size_t visits_ = 0;
};

}  // namespace

std::vector<bool> transitive_edges(std::size_t vertices, const Edges& edges) {
  const std::vector<Vertex> component = strong_components(vertices, edges);
  Edges between;
  for (const auto& [from, to] : edges) {
    if (component[from] != component[to]) between.emplace_back(component[from], component[to]);
  }
  Search search(vertices, between);
  std::vector<bool> is_transitive;
  for (const auto& [from, to] : edges) {
    is_transitive.push_back(component[from] != component[to] &&
                            search.has_detour(component[from], component[to]));
  }
  return is_transitive;
}

}  // namespace cbc
