#include "core/report/xml_text.h"

#include <cstddef>

#include "runtime/base/text.h"

namespace cbc {
namespace {

/// As a character reference: parsers turn a plain line end in an attribute into a blank.
constexpr std::string_view line_end = "&#10;";

std::string escape(std::string_view character, char32_t code) {
  switch (code) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\n':
      return std::string(line_end);
    case 0xFFFE:
      return "\\ufffe";
    case 0xFFFF:
      return "\\uffff";
    default:
      return printable(character);
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    escaped += escape(text.substr(offset, decoded.bytes), decoded.character);
    offset += decoded.bytes;
  }
  return escaped;
}

}  // namespace cbc
