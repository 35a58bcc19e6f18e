#pragma once

#include <cstddef>
#include <cstdio>

#include "text/style.h"

namespace cbc::cli {

/// Whether a stream is a terminal that can do more than print.
[[nodiscard]] bool is_terminal(std::FILE* stream);

/// How many characters a line of a terminal has; 80 where it does not say.
[[nodiscard]] std::size_t columns_of(std::FILE* stream);

/// Whether to write colors to a stream: it is such a terminal, and NO_COLOR (https://no-color.org)
/// is not set.
[[nodiscard]] bool wants_color(std::FILE* stream);

[[nodiscard]] Style style_for(std::FILE* stream);

}  // namespace cbc::cli
