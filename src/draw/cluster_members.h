#pragma once

#include <vector>

#include "draw/diagram.h"

namespace cbc::draw {

/// The nodes of each cluster, in their order.
[[nodiscard]] std::vector<std::vector<const Node*>> cluster_members(const Diagram& diagram);

}  // namespace cbc::draw
