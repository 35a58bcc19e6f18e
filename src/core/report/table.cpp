#include "core/report/table.h"

#include <algorithm>

#include "core/support/wording.h"

namespace cbc {

Table::Table(const Style& style, std::vector<Column> columns, const Wrapping& wrapping)
    : style_(style), columns_(std::move(columns)), wrapping_(wrapping) {
  wrapping_.column = std::min(wrapping_.column, columns_.size() - 1);
  for (Column& column : columns_) column.width = std::max(column.width, width_of(column.title));
}

void Table::add(Row row, std::string_view color) {
  for (std::size_t place = 0; place < row.size(); ++place) {
    columns_[place].width = std::max(columns_[place].width, width_of(row[place].text));
  }
  rows_.emplace_back(std::move(row), color);
}

std::string Table::titles() const {
  Row row;
  for (const Column& column : columns_) row.emplace_back(column.title);
  return line(row, style_.faint);
}

std::string Table::line(const Row& row, std::string_view color) const {
  std::string line;
  std::size_t used = 0;   // columns of the terminal
  std::size_t begin = 0;  // of the column
  std::size_t indent = 0;
  for (std::size_t place = 0; place < columns_.size(); ++place) {
    const Column& column = columns_[place];
    begin += column.gap;
    if (place == wrapping_.column) indent = begin;
    if (place < row.size() && !row[place].text.empty()) {
      const Cell& cell = row[place];
      const std::size_t width = width_of(cell.text);
      const std::size_t shift =
          column.align == Align::left || width > column.width ? 0 : column.width - width;
      const std::size_t start = std::max(begin + shift, used + column.gap);
      line.append(start - used, ' ');
      line += cell.color.empty() ? cell.text : style_.paint(cell.color, cell.text);
      used = start + width;
    }
    begin += column.width;
  }
  if (!color.empty()) line = style_.paint(color, line);
  return wrap_line(line, wrapping_.columns, indent, wrapping_.breaks) + "\n";
}

std::string Table::text() const {
  std::string text;
  if (std::any_of(columns_.begin(), columns_.end(),
                  [](const Column& column) { return !column.title.empty(); })) {
    text = titles();
  }
  for (const auto& [row, color] : rows_) text += line(row, color);
  return text;
}

std::string Table::html(std::string_view element_class) const {
  std::string html = concat("<table class=\"", element_class, "\">\n<tr>");
  for (const Column& column : columns_) {
    html += column.title.empty() ? "<td></td>"
                                 : concat("<th scope=\"col\">", xml_text(column.title), "</th>");
  }
  html += "</tr>\n";
  for (const auto& [row, color] : rows_) {
    html += concat("<tr><th scope=\"row\">", xml_text(row.front().text), "</th>");
    for (std::size_t place = 1; place < row.size(); ++place) {
      html += concat("<td>", xml_text(row[place].text), "</td>");
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

Table::Column number_column(std::string title, std::size_t width, std::size_t gap) {
  return {std::move(title), Table::Align::right, width, gap};
}

}  // namespace cbc
