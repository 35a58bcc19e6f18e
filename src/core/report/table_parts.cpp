#include "core/report/table_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/report/wrap.h"
#include "graph/engine/diagram.h"
#include "graph/report/palette.h"
#include "runtime/base/text.h"

namespace cbc {

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    width += utf8::display_width(decoded.character);
    offset += decoded.bytes;
  }
  return width;
}

namespace {

/// Replaces the middle of a text that is wider than `columns` by "...".
std::string shorten_text(const std::string& text, std::size_t columns) {
  std::size_t rest = width_of(text);  // from `offset` on
  if (rest <= columns) return text;
  constexpr std::string_view dots = "...";
  const std::size_t kept = columns - dots.size();
  std::size_t offset = 0;
  const auto width_of_next = [&] {
    return utf8::display_width(utf8::decode(text, offset).character);
  };
  const auto skip = [&] {
    rest -= width_of_next();
    offset += utf8::decode(text, offset).bytes;
  };
  const std::size_t width = rest;
  std::size_t begin = 0;
  while (width - rest <= kept / 2) {
    begin = offset;
    skip();
  }
  while (rest > kept - kept / 2) skip();
  while (width_of_next() == 0) skip();  // would combine with the dots
  return concat(std::string_view(text).substr(0, begin), dots,
                std::string_view(text).substr(offset));
}

}  // namespace

std::vector<std::string> shorten(std::vector<std::string> names) {
  std::size_t widest = 0;
  for (const std::string& name : names) widest = std::max(widest, width_of(name));
  const std::size_t different = std::set<std::string>(names.begin(), names.end()).size();
  for (std::size_t columns = longest_name; columns < widest; columns *= 2) {
    std::vector<std::string> shortened;
    shortened.reserve(names.size());
    for (const std::string& name : names) shortened.push_back(shorten_text(name, columns));
    if (std::set<std::string>(shortened.begin(), shortened.end()).size() == different) {
      return shortened;
    }
  }
  return names;
}

std::string_view without_end_blanks(std::string_view text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::string assumptions_to_text(const CompiledCatalog& catalog, const StatedAssumptions& stated,
                                std::size_t columns) {
  const std::size_t width = columns == 0 ? text_width : std::min(columns, text_width);
  return wrap_line(describe_assumptions(catalog, stated), width, 2) + "\n";
}

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char byte : text) {
    switch (byte) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\\':
        escaped += "\\\\";  // one and a G would stand for the name of the graph
        break;
      default:
        escaped += byte;
    }
  }
  return escaped;
}

DotTable::DotTable(std::string_view graph, const CompiledCatalog& catalog, std::string_view what)
    : text_(fmt::format(
          "graph {} {{\n"
          "  graph [bgcolor=\"{}\", pad=0.2, fontname=\"Helvetica,Arial,sans-serif\"];\n"
          "  node [shape=plain, fontname=\"Helvetica,Arial,sans-serif\", fontsize=11];\n"
          "  table [label=<\n<TABLE BORDER=\"0\" CELLBORDER=\"0\" CELLSPACING=\"0\" "
          "CELLPADDING=\"3\">\n",
          graph, palette::paper)) {
  add_line(fmt::format("<B>{}</B>: {}", escape_html(draw::label_of(catalog.file)), what));
}

void DotTable::add_line(std::string_view text) {
  text_ += fmt::format("<TR><TD ALIGN=\"LEFT\" BALIGN=\"LEFT\">{}</TD></TR>\n", text);
}

void DotTable::add_matrix(int padding, const std::vector<std::string>& rows) {
  text_ += fmt::format(
      "<TR><TD ALIGN=\"LEFT\"><TABLE BORDER=\"0\" CELLBORDER=\"0\" CELLSPACING=\"1\" "
      "CELLPADDING=\"{}\">\n",
      padding);
  for (const std::string& row : rows) text_ += fmt::format("<TR>{}</TR>\n", row);
  text_ += "</TABLE></TD></TR>\n";
}

std::string DotTable::name_cell(std::string_view name) {
  return fmt::format("<TD ALIGN=\"LEFT\">{}</TD>", name);
}

std::string DotTable::color_cell(std::string_view color, char sign) {
  return fmt::format("<TD BGCOLOR=\"{}\">{}</TD>", color, sign);
}

std::string DotTable::finish() && { return std::move(text_) + "</TABLE>>];\n}\n"; }

}  // namespace cbc
