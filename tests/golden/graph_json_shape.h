#pragma once

#include <string>
#include <vector>

namespace cbc::golden {

/// Where a text does not have the form of the schema "cbc.graph/1", one line each.
[[nodiscard]] std::vector<std::string> find_graph_shape_faults(const std::string& text);

}  // namespace cbc::golden
