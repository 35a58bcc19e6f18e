#pragma once

#include <cstdint>
#include <string_view>

namespace cbc {

/// A number for a text: FNV-1a of 64 bits, the same on every machine and for ever.
[[nodiscard]] constexpr std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : text) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3;
  }
  return hash;
}

}  // namespace cbc
