#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "draw/catalog_graph.h"

namespace cbc::draw {

/// The tasks and behaviors of a catalog that are drawn.
struct Part {
  std::vector<std::uint32_t> tasks;      ///< ascending
  std::vector<std::uint32_t> behaviors;  ///< ascending
  std::vector<bool> has_task;            ///< by task of the catalog
  std::vector<bool> has_behavior;
  std::vector<bool> is_beside;  ///< by task: it is only drawn because of one beside it
  std::vector<bool> is_named;   ///< by task: it was asked for
};

[[nodiscard]] Part whole(const CatalogGraph& graph);

[[nodiscard]] Part part_of_group(const CatalogGraph& graph, std::uint32_t group);

/// How far to go from the tasks that were asked for.
struct Reach {
  bool up = true;                      ///< to what requires them
  bool down = true;                    ///< to what they require
  std::optional<std::uint32_t> depth;  ///< in steps from task to task; empty: to the end
};

/// Some tasks, their behaviors, and what requires them or is required by them. A few tasks stand
/// beside those, without what belongs to them: those that the tasks asked for exclude, unless these
/// are many, and those that a behavior also performs.
[[nodiscard]] Part part_around(const CatalogGraph& graph, const std::vector<std::uint32_t>& tasks,
                               const Reach& reach);

}  // namespace cbc::draw
