#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "core/diagnostic/diagnostic.h"

// How texts for people look where they are written: their width and their colors.

namespace cbc::cli {

/// Whether a stream is a terminal that understands escape sequences.
[[nodiscard]] bool is_terminal(std::FILE* stream);

/// The width of a terminal in characters; 80 if it is unknown.
[[nodiscard]] std::size_t columns_of(std::FILE* stream);

/// To how many columns texts for people are wrapped: the width of a terminal; 0 (not at all) if it
/// is none.
[[nodiscard]] std::size_t columns_for(std::FILE* stream);

/// Colors, if it is such a terminal and NO_COLOR (https://no-color.org) is not set.
[[nodiscard]] Style style_for(std::FILE* stream);

/// The same two for what write_output() writes there.
[[nodiscard]] std::size_t columns_for(const std::string& output);
[[nodiscard]] Style style_for(const std::string& output);

}  // namespace cbc::cli
