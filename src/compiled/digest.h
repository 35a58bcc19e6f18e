#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace cbc {

/// XXH3 of 128 bits, in its canonical (big-endian) form. Tells that a content is damaged or has
/// changed; it is no protection against somebody who means harm.
struct Digest {
  std::array<std::uint8_t, 16> bytes{};

  bool operator==(const Digest&) const = default;
};

[[nodiscard]] Digest digest_of(std::string_view content);

/// 32 hexadecimal digits, as `xxh128sum` prints them.
[[nodiscard]] std::string to_hex(const Digest& digest);

}  // namespace cbc
