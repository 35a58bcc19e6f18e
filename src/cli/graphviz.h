#pragma once

#include <optional>
#include <string>

namespace cbc::cli {

/// Has Graphviz's program `dot` draw a graph: format is svg, png or pdf. Empty if that fails, which
/// is complained of.
[[nodiscard]] std::optional<std::string> run_graphviz(const std::string& dot,
                                                      const std::string& format);

}  // namespace cbc::cli
