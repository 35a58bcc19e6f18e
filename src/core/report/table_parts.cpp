#include "core/report/table_parts.h"

#include <utility>

#include <fmt/format.h>

#include "graph/engine/diagram.h"
#include "graph/report/palette.h"

namespace cbc {

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
