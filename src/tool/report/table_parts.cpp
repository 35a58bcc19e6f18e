#include "report/table_parts.h"

#include "base/text.h"

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

std::string cut_to(std::size_t columns, std::string text) {
  if (width_of(text) <= columns) return text;
  std::size_t width = 0;
  std::size_t offset = 0;
  while (offset < text.size()) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    width += utf8::display_width(decoded.character);
    if (width > columns - 3) break;
    offset += decoded.bytes;
  }
  return text.substr(0, offset) + "...";
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

}  // namespace cbc
