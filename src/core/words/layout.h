#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// How texts for people fit into a terminal.
namespace cbc {

/// Tables are at most this wide.
inline constexpr std::size_t text_width = 80;

/// The number of columns that a text takes in a terminal. Escape sequences of colors take none.
[[nodiscard]] std::size_t width_of(std::string_view text);

/// The names of at most 28 columns: longer ones have "..." for their middle. If names that differ
/// became equal, they are twice as long, and so on.
[[nodiscard]] std::vector<std::string> shorten(std::vector<std::string> names);
/// The same for one name, of at most so many columns.
[[nodiscard]] std::string shorten(const std::string& name, std::size_t columns);

/// Where a line may be broken.
enum class Breaks : std::uint8_t {
  between_words,  ///< a number and its unit ("60 %", "10 s") count as one word
  after_commas
};

/// Breaks a line so that it fits into a terminal. What follows the first break is indented by
/// `indent` columns. A word that is wider than what is left for it keeps its width. `columns`: of
/// the terminal; 0: no limit.
[[nodiscard]] std::string wrap_line(std::string_view line, std::size_t columns, std::size_t indent,
                                    Breaks breaks = Breaks::between_words);

/// The lines, four columns further to the right; each ends with a line break.
[[nodiscard]] std::string indent(std::string_view lines);

/// The line without the blanks at its beginning.
[[nodiscard]] std::string_view without_indentation(std::string_view line);

}  // namespace cbc
