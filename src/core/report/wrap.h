#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cbc {

/// Breaks a line between words so that it fits into a terminal; a number and its unit ("60 %",
/// "10 s") count as one word. What follows the first break is
/// indented by `indent` columns. A word that is wider than what is left for it keeps its width.
/// Escape sequences of colors take no columns. `columns`: of the terminal; 0: no limit.
[[nodiscard]] std::string wrap_line(std::string_view line, std::size_t columns, std::size_t indent);

/// The lines, four columns further to the right; each ends with a line break.
[[nodiscard]] std::string indent(std::string_view lines);

}  // namespace cbc
