#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

/// What tables are made of.
namespace cbc {

/// Tables as text are at most this wide, and shorten names to `longest_name`.
inline constexpr std::size_t text_width = 80;
inline constexpr std::size_t longest_name = 28;

/// The number of columns that a text takes in a terminal.
[[nodiscard]] std::size_t width_of(std::string_view text);

/// The names of at most `longest_name` columns: longer ones have "..." for their middle. If names
/// that differ became equal, they are twice as long, and so on.
[[nodiscard]] std::vector<std::string> shorten(std::vector<std::string> names);

/// The text without the blanks at its end.
[[nodiscard]] std::string_view without_end_blanks(std::string_view text);

/// The line of describe_assumptions, broken to the width of tables, or of a terminal that is
/// narrower. `columns`: of the terminal, 0 if there is none.
[[nodiscard]] std::string assumptions_to_text(const CompiledCatalog& catalog,
                                              const StatedAssumptions& stated,
                                              std::size_t columns = 0);

}  // namespace cbc
