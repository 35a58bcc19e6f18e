#pragma once

#include <cstdint>
#include <vector>

#include "cbc/units.h"
#include "draw/catalog_graph.h"
#include "draw/part.h"

namespace cbc::draw {

/// That behaviors of one task require another one.
struct TaskRequirement {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t behaviors = 0;  ///< of `from` in the part; of two catalogs, of the newer one
  std::uint32_t requiring = 0;  ///< how many of these require `to`
  Millionths lowest = 0;        ///< of the minimum performances that they ask for; 0: none
  Millionths highest = 0;
  Mark mark = Mark::plain;
};

/// All of them between tasks of a part, by `from`, then by `to`.
[[nodiscard]] std::vector<TaskRequirement> task_requirements(const CatalogGraph& graph,
                                                             const Part& part);

}  // namespace cbc::draw
