#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// Algorithms on graphs whose vertices are numbers from 0.
namespace cbc {

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Component of each vertex in the undirected graph. Components count from 0 by their first vertex.
[[nodiscard]] std::vector<std::uint32_t> connected_components(std::size_t vertices,
                                                              const Edges& edges);

/// Strongly connected component of each vertex in the directed graph, counted from 0.
[[nodiscard]] std::vector<std::uint32_t> strong_components(std::size_t vertices,
                                                           const Edges& edges);

/// Whether each edge is implied by the others: another path leads from its source to its target.
/// Each cycle counts as one vertex, so edges within cycles are not implied. Edges are distinct.
[[nodiscard]] std::vector<bool> transitive_edges(std::size_t vertices, const Edges& edges);

}  // namespace cbc
