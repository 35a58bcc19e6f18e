#include "core/report/pair_matrix.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/words/layout.h"

namespace cbc {
namespace {

constexpr std::size_t columns_in_a_block = 5;

class PairMatrix {
 public:
  using CellOf = std::function<Table::Cell(std::size_t row, std::size_t column)>;

  PairMatrix(std::vector<std::string> names, const Style& style, const CellOf& cell)
      : names_(shorten(std::move(names))),
        style_(style),
        cell_(cell),
        digits_(std::to_string(names_.size()).size()) {
    for (const std::string& name : names_) name_width_ = std::max(name_width_, width_of(name));
  }

  std::string write() && {
    const std::size_t left = 2 + digits_ + 1 + name_width_ + 1;
    const std::size_t width = std::max(text_width, left + columns_in_a_block) - left;
    const std::size_t columns = names_.size() - 1;
    // A blank stands between each two blocks.
    std::size_t most = (width + 1) / (columns_in_a_block + 1) * columns_in_a_block;
    if (columns + (columns - 1) / columns_in_a_block <= width) most = columns;
    for (std::size_t first = 0; first + 1 < names_.size(); first += most) {
      add_part(first, std::min(first + most, names_.size() - 1));
    }
    return std::move(text_);
  }

 private:
  void add_part(std::size_t first, std::size_t end) {
    std::vector<Table::Column> columns = {number_column({}, digits_), {{}, {}, name_width_, 1}};
    for (std::size_t column = first; column < end; ++column) {
      const bool begins_block = (column - first) % columns_in_a_block == 0;
      columns.push_back({{}, {}, 1, begins_block ? std::size_t{1} : 0});
    }
    const Table table(style_, std::move(columns));
    text_ += '\n';
    for (std::size_t digit = 0; digit < digits_; ++digit) {
      Table::Row row = {"", ""};
      for (std::size_t column = first; column < end; ++column) {
        const std::string number = fmt::format("{:>{}}", column + 1, digits_);
        row.emplace_back(number[digit] == ' ' ? "" : number.substr(digit, 1));
      }
      text_ += table.line(row, style_.faint);
    }
    for (std::size_t row = first; row < names_.size(); ++row) {
      Table::Row cells = {row + 1, names_[row]};
      for (std::size_t column = first; column < std::min(row, end); ++column) {
        cells.push_back(cell_(row, column));
      }
      text_ += table.line(cells);
    }
  }

  std::vector<std::string> names_;
  const Style& style_;
  const CellOf& cell_;
  std::size_t name_width_ = 0;
  std::size_t digits_;
  std::string text_;
};

}  // namespace

std::string pair_matrix(std::vector<std::string> names, const Style& style,
                        const std::function<Table::Cell(std::size_t, std::size_t)>& cell) {
  return PairMatrix(std::move(names), style, cell).write();
}

}  // namespace cbc
