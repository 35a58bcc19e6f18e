#include "core/report/blocks.h"

#include <algorithm>
#include <span>

namespace cbc {

void Blocks::list(const std::vector<std::string>& lines, std::size_t most, std::string_view indent,
                  std::string_view color) {
  const std::size_t shown = std::min(lines.size(), most);
  for (const std::string& each : std::span(lines).first(shown)) {
    painted(color, "{}{}", indent, each);
  }
  if (shown < lines.size()) line("{}and {} more", indent, lines.size() - shown);
}

void Text::add_line(std::string_view color, std::string_view line) {
  const std::size_t indent = line.size() - without_indentation(line).size() + 2;
  const std::string wrapped = wrap_line(line, columns(), indent);
  text_ += (color.empty() ? wrapped : style().paint(color, wrapped)) + "\n";
}

void Text::heading(std::string_view heading) {
  if (!is_empty()) text_ += "\n";
  painted(style().strong, heading);
}

void Text::title(std::string_view title) {
  text_ += "\n" + style().paint(style().strong, title) + "\n";
}

void Text::paragraph(std::string_view sentences) {
  const std::size_t width = columns() == 0 ? text_width : std::min(columns(), text_width);
  text_ += wrap_line(sentences, width, 2) + "\n";
}

void Text::table(const Table& table, std::string_view /*kind*/) { text_ += table.text(); }

}  // namespace cbc
