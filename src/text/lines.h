#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace cbc {

/// Where the line of `offset` ends: at its line feed, or at the end of the text.
[[nodiscard]] inline std::size_t end_of_line(std::string_view text, std::size_t offset) {
  return std::min(text.find('\n', offset), text.size());
}

}  // namespace cbc
