#include "draw/names.h"

#include <algorithm>
#include <cstddef>

#include "text/decimal.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc::draw {
namespace {

/// Characters with a meaning of their own in ids or in the formats that they are written to.
bool is_special(char32_t character) {
  return character == '%' || character == '#' || character == '\\' || character == '&';
}

void append_encoded(std::string& id, std::string_view bytes) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  for (const char byte : bytes) {
    const unsigned value = static_cast<unsigned char>(byte);
    id += '%';
    id += digits[value / 16];
    id += digits[value % 16];
  }
}

}  // namespace

std::string id_of(std::string_view kind, std::string_view name) {
  std::string id(kind);
  id += ':';
  for (std::size_t offset = 0; offset < name.size();) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    const std::string_view bytes = name.substr(offset, decoded.bytes);
    if (!decoded.valid || is_control(decoded.character) || is_special(decoded.character)) {
      append_encoded(id, bytes);
    } else {
      id += bytes;
    }
    offset += decoded.bytes;
  }
  return id;
}

std::string label_of(std::string_view name) {
  const bool is_blank = std::all_of(name.begin(), name.end(), [](char c) { return c == ' '; });
  return is_blank ? quote(name) : printable(name);
}

std::string at_least(Millionths degree) { return "≥ " + format_percent(degree); }

}  // namespace cbc::draw
