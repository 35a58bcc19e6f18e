#include "core/report/table.h"

#include <algorithm>

#include "core/support/wording.h"

namespace cbc {
namespace {

constexpr std::string_view note_indent = "        ";

}  // namespace

Table::Table(const Style& style, std::vector<Column> columns, const Wrapping& wrapping)
    : style_(style), columns_(std::move(columns)), wrapping_(wrapping) {
  wrapping_.column = std::min(wrapping_.column, columns_.size() - 1);
  for (Column& column : columns_) column.width = std::max(column.width, width_of(column.title));
}

void Table::add(Row row, std::string_view color) {
  for (std::size_t place = 0; place < row.size(); ++place) {
    columns_[place].width = std::max(columns_[place].width, width_of(row[place].text));
  }
  rows_.push_back({std::move(row), color});
}

void Table::add_note(std::string note) { rows_.back().notes.push_back(std::move(note)); }

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
    if (column.is_picture) continue;
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
  for (const Line& of : rows_) {
    text += line(of.row, of.color);
    for (const std::string& note : of.notes) {
      text +=
          wrap_line(concat(note_indent, note), wrapping_.columns, note_indent.size() + 2) + "\n";
    }
  }
  return text;
}

std::string Table::html(std::string_view element_class) const {
  std::string html = concat("<table class=\"", element_class, "\">\n");
  if (!caption_.empty()) html += concat("<caption>", xml_text(caption_), "</caption>\n");
  html += "<tr>";
  for (const Column& column : columns_) {
    html += column.title.empty() ? "<td></td>"
                                 : concat("<th scope=\"col\">", xml_text(column.title), "</th>");
  }
  html += "</tr>\n";
  for (const Line& of : rows_) {
    html += concat("<tr><th scope=\"row\">", xml_text(of.row.front().text), "</th>");
    for (std::size_t place = 1; place < of.row.size(); ++place) {
      const std::string& text = of.row[place].text;
      html += concat("<td>", columns_[place].is_picture ? text : xml_text(text), "</td>");
    }
    for (const std::string& note : of.notes) {
      html += concat(&note == of.notes.data() ? "<td>" : "", "<p>", xml_text(note), "</p>");
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

Table::Column number_column(std::string title, std::size_t width, std::size_t gap) {
  return {std::move(title), Table::Align::right, width, gap};
}

}  // namespace cbc
