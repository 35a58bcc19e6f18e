#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"

/// What tables are made of in pictures.
namespace cbc {

/// Escapes a text for the HTML-like labels of Graphviz.
[[nodiscard]] std::string escape_html(std::string_view text);

/// A graph for Graphviz's program `dot` that is nothing but lines of text and matrices, one below
/// the other. Texts are in the syntax of HTML-like labels.
class DotTable {
 public:
  /// `graph` names the graph. The first line has the file of the catalog, and says what this is.
  DotTable(std::string_view graph, const CompiledCatalog& catalog, std::string_view what);

  void add_line(std::string_view text);
  /// The rows are sequences of cells; `padding` is the space in a cell.
  void add_matrix(int padding, const std::vector<std::string>& rows);

  /// Cells of a row.
  [[nodiscard]] static std::string name_cell(std::string_view name);
  [[nodiscard]] static std::string color_cell(std::string_view color, char sign);

  [[nodiscard]] std::string finish() &&;

 private:
  std::string text_;
};

}  // namespace cbc
