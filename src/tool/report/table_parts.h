#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// What tables are made of, as text and in pictures.
namespace cbc {

/// The number of columns that a text takes in a terminal.
[[nodiscard]] std::size_t width_of(std::string_view text);

/// A text of at most `columns` columns (4 or more): a longer one ends with "...".
[[nodiscard]] std::string cut_to(std::size_t columns, std::string text);

/// A text in a label of Graphviz that is like HTML.
[[nodiscard]] std::string escape_html(std::string_view text);

}  // namespace cbc
