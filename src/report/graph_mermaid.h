#pragma once

#include <string>

#include "draw/diagram.h"

namespace cbc {

/// A picture for Mermaid, which draws it where the text stands: in a README file, a pull request.
[[nodiscard]] std::string graph_mermaid(const draw::Diagram& diagram);

}  // namespace cbc
