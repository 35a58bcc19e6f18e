#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"

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

/// A text as it grows, line by line.
class Text {
 public:
  /// `columns`: of the terminal; 0: no limit.
  explicit Text(const Style& style, std::size_t columns = 0) : style_(style), columns_(columns) {}

  /// Adds a line. Where it has to be broken, the rest stands two columns further to the right than
  /// its beginning.
  void line(std::string_view line);
  template <typename... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    line(std::string_view(fmt::format(form, std::forward<Args>(args)...)));
  }
  /// The same in a color.
  void painted(std::string_view color, std::string_view line);
  template <typename... Args>
  void painted(std::string_view color, fmt::format_string<Args...> form, Args&&... args) {
    painted(color, std::string_view(fmt::format(form, std::forward<Args>(args)...)));
  }
  /// An empty line, and a title.
  void title(std::string_view title);
  /// Adds whole lines, as they are.
  void add(std::string_view lines) { text_ += lines; }

  [[nodiscard]] const Style& style() const { return style_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] bool is_empty() const { return text_.empty(); }
  /// The text so far, which then begins anew.
  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

 private:
  Style style_;
  std::size_t columns_;
  std::string text_;
};

}  // namespace cbc
