#include "text/uri.h"

namespace cbc {
namespace {

bool stands_for_itself(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9') || byte == '-' || byte == '.' || byte == '_' || byte == '~' ||
         byte == '/';
}

}  // namespace

std::string percent_encode(std::string_view path) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string encoded;
  for (const char byte : path) {
    if (stands_for_itself(byte)) {
      encoded += byte;
      continue;
    }
    const unsigned value = static_cast<unsigned char>(byte);
    encoded += '%';
    encoded += digits[value / 16];
    encoded += digits[value % 16];
  }
  return encoded;
}

}  // namespace cbc
