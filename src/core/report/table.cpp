#include "core/report/table.h"

#include <algorithm>
#include <span>

#include "core/support/wording.h"

namespace cbc {
namespace {

constexpr std::string_view note_indent = "        ";

/// A line of a title, counted from its last one. Empty: it has fewer.
std::string_view line_of_title(std::string_view title, std::size_t number) {
  for (; number > 0; --number) {
    const std::size_t end = title.rfind('\n');
    if (end == std::string_view::npos) return {};
    title = title.substr(0, end);
  }
  return title.substr(title.rfind('\n') + 1);
}

}  // namespace

Table::Table(const Style& style, std::vector<Column> columns, const Wrapping& wrapping)
    : style_(style), columns_(std::move(columns)), wrapping_(wrapping) {
  wrapping_.column = std::min(wrapping_.column, columns_.size() - 1);
  for (Column& column : columns_) {
    column.width = std::max(column.width, width_of(line_of_title(column.title, 0)));
  }
}

void Table::add(Row row, std::string_view color) {
  for (std::size_t place = 0; place < row.size(); ++place) {
    columns_[place].width = std::max(columns_[place].width, width_of(row[place].text));
  }
  rows_.push_back({std::move(row), color});
}

void Table::add_note(std::string note) { rows_.back().notes.push_back(std::move(note)); }

std::string Table::titles() const {
  std::size_t lines = 1;
  for (const Column& column : columns_) {
    const auto breaks = std::count(column.title.begin(), column.title.end(), '\n');
    lines = std::max(lines, static_cast<std::size_t>(breaks) + 1);
  }
  std::string text;
  while (lines-- > 0) {
    Row row;
    for (const Column& column : columns_) row.emplace_back(line_of_title(column.title, lines));
    text += line(row, style_.faint);
  }
  return text;
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

std::string Table::text_in_parts(std::size_t kept, std::optional<std::string_view> nothing) const {
  std::size_t left = 0;
  for (std::size_t place = 0; place < kept; ++place) {
    left += columns_[place].gap + columns_[place].width;
  }
  std::string text;
  for (std::size_t first = kept, end = kept; first < columns_.size(); first = end) {
    std::size_t width = left;
    std::size_t whole = first;  // where the last ones that belong together begin
    for (end = first; end < columns_.size(); ++end) {
      if (!columns_[end].belongs_to_last) whole = end;
      width += columns_[end].gap + columns_[end].width;
      if (width > text_width && end > first) break;
    }
    if (end < columns_.size() && whole > first) end = whole;
    const auto take = [&](const auto& all) {
      auto taken = all;
      taken.clear();
      for (std::size_t place = 0; place < std::min(end, all.size()); ++place) {
        if (place < kept || place >= first) taken.push_back(all[place]);
      }
      return taken;
    };
    std::vector<Column> columns = take(columns_);
    std::string& title = columns[kept].title;
    if (line_of_title(title, 1).empty()) {  // what stands above all that belong together
      std::size_t begin = first;
      while (columns_[begin].belongs_to_last) --begin;
      const std::string& above = columns_[begin].title;
      title =
          concat(std::string_view(above).substr(0, above.rfind('\n') + 1), line_of_title(title, 0));
    }
    Table part(style_, std::move(columns));
    for (const Line& of : rows_) {
      const Row row = take(of.row);
      const auto cells = std::span(row).subspan(std::min(kept, row.size()));
      const bool is_told = std::any_of(cells.begin(), cells.end(),
                                       [&](const Cell& cell) { return cell.text != nothing; });
      if (is_told) part.add(row, of.color);
    }
    text += "\n" + part.text();
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

std::string pair_matrix(std::vector<std::string> names, const Style& style,
                        const std::function<Table::Cell(std::size_t, std::size_t)>& cell) {
  constexpr std::size_t columns_in_a_block = 5;
  names = shorten(std::move(names));
  const std::size_t digits = std::to_string(names.size()).size();
  std::vector<Table::Column> columns = {number_column({}, digits), {.gap = 1}};
  for (std::size_t column = 0; column + 1 < names.size(); ++column) {
    const std::string number = std::to_string(column + 1);
    std::string upright(digits - number.size(), '\n');
    upright += join(number, "\n", [](char digit) { return std::string(1, digit); });
    const bool is_in_block = column % columns_in_a_block > 0;
    columns.push_back({upright, {}, 1, is_in_block ? 0U : 1U, false, is_in_block});
  }
  Table table(style, std::move(columns));
  for (std::size_t row = 0; row < names.size(); ++row) {
    Table::Row cells = {row + 1, names[row]};
    for (std::size_t column = 0; column < row; ++column) cells.push_back(cell(row, column));
    if (row + 1 < names.size()) cells.emplace_back("");  // so that its name is seen
    table.add(std::move(cells));
  }
  return table.text_in_parts(2);
}

}  // namespace cbc
