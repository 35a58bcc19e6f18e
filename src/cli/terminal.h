#pragma once

#include <cstdio>

namespace cbc::cli {

/// Whether to write colors to a stream: it is a terminal that can show them, and NO_COLOR
/// (https://no-color.org) is not set.
[[nodiscard]] bool wants_color(std::FILE* stream);

}  // namespace cbc::cli
