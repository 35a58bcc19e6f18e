#include "text/quote.h"

#include <cstddef>

#include "text/utf8.h"

namespace cbc {
namespace {

constexpr std::size_t longest = 80;

std::string escape(char32_t character) {
  constexpr std::string_view digits = "0123456789abcdef";
  switch (character) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      break;
  }
  std::string result = character < 0x100 ? "\\x" : "\\u";
  for (unsigned shift = character < 0x100 ? 8 : 16; shift > 0;) {
    shift -= 4;
    result += digits[(character >> shift) & 0xFU];
  }
  return result;
}

/// At most `limit` characters of the text, with what does not print escaped.
std::string escape_some(std::string_view text, std::size_t limit) {
  std::string result;
  std::size_t characters = 0;
  for (std::size_t offset = 0; offset < text.size(); ++characters) {
    if (characters == limit) return result + "...";
    const utf8::Decoded decoded = utf8::decode(text, offset);
    if (!decoded.valid) {
      result += escape(static_cast<unsigned char>(text[offset]));
    } else if (is_control(decoded.character)) {
      result += escape(decoded.character);
    } else {
      result += text.substr(offset, decoded.bytes);
    }
    offset += decoded.bytes;
  }
  return result;
}

}  // namespace

bool is_control(char32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) ||
         (character >= 0x2028 && character <= 0x202E) ||
         (character >= 0x2066 && character <= 0x2069);
}

std::string quote(std::string_view text) { return "'" + escape_some(text, longest) + "'"; }

std::string printable(std::string_view text) { return escape_some(text, text.size()); }

}  // namespace cbc
