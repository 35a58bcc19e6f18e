#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/words/layout.h"
#include "runtime/base/text.h"

namespace cbc {

/// How lines are broken.
struct Wrapping {
  std::size_t columns = 0;               ///< of the terminal; 0: no limit
  std::size_t column = std::size_t(-1);  ///< below which the rest of a line stands, or the last
  Breaks breaks = Breaks::between_words;
};

/// A table for people, as text and as HTML. In a text its columns are as wide as what they hold,
/// names are at the left and numbers at the right, and lines have no blanks at their end.
class Table {
 public:
  enum class Align : std::uint8_t { left, right };

  struct Column {
    std::string title = {};  ///< its last line stands directly above the column
    Align align = Align::left;
    std::size_t width = 0;         ///< at least
    std::size_t gap = 2;           ///< blanks before it
    bool is_picture = false;       ///< of SVG, which texts leave out
    bool belongs_to_last = false;  ///< it stays with the column before, where a table is parted
  };

  /// A text or a number, and its color.
  struct Cell {
    template <typename Content>
    Cell(const Content& content, std::string_view its_color = {})  // NOLINT: stands for its text
        : text(concat(content)), color(its_color) {}

    std::string text;
    std::string_view color;
  };
  using Row = std::vector<Cell>;

  Table(const Style& style, std::vector<Column> columns, const Wrapping& wrapping = {});

  /// Adds a row; cells at its end may be missing. `color`: of the whole line.
  void add(Row row, std::string_view color = {});
  /// Adds a line below the last row; in HTML it stands in a column at the end.
  void add_note(std::string note);
  /// How to read the pictures.
  void set_caption(std::string caption) { caption_ = std::move(caption); }

  /// All of it: the titles, if there are any, and the rows.
  [[nodiscard]] std::string text() const;
  /// The same in as many parts, each after an empty line, as it takes for the columns to fit. The
  /// first `kept` ones stand in each part. Rows that have only `nothing` in a part are left out.
  [[nodiscard]] std::string text_in_parts(std::size_t kept,
                                          std::optional<std::string_view> nothing = {}) const;
  /// The same as an element of HTML, whose first column has titles of rows.
  [[nodiscard]] std::string html(std::string_view element_class) const;

  // For a table that is written row by row, whose columns do not get wider.

  [[nodiscard]] std::string titles() const;
  [[nodiscard]] std::string line(const Row& row, std::string_view color = {}) const;

 private:
  const Style style_;
  std::vector<Column> columns_;
  Wrapping wrapping_;
  struct Line {
    Row row;
    std::string_view color;
    std::vector<std::string> notes = {};
  };
  std::vector<Line> rows_;
  std::string caption_;
};

/// A column of numbers.
[[nodiscard]] Table::Column number_column(std::string title, std::size_t width = 0,
                                          std::size_t gap = 2);

/// A triangular matrix as text, after an empty line: numbered rows with these names, shortened
/// where they are long, and in each a sign for each pair with a name before it, under the number
/// of that name. `cell`: the sign of a pair, by the places of both names; the row is greater than
/// the column.
[[nodiscard]] std::string pair_matrix(
    std::vector<std::string> names, const Style& style,
    const std::function<Table::Cell(std::size_t row, std::size_t column)>& cell);

}  // namespace cbc
