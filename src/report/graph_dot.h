#pragma once

#include <string>

#include "draw/diagram.h"

namespace cbc {

/// A picture for Graphviz's program `dot`.
[[nodiscard]] std::string graph_dot(const draw::Diagram& diagram);

}  // namespace cbc
