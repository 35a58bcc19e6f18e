#pragma once

#include <cstdint>

namespace cbc {

/// 1, 1, 2, 1, 1, 2, 4, ...: how long a search runs until a restart (M. Luby, A. Sinclair and
/// D. Zuckerman, "Optimal speedup of Las Vegas algorithms", Information Processing Letters 47
/// (1993)). `place` counts from 0.
[[nodiscard]] constexpr std::uint64_t luby(std::uint64_t place) {
  std::uint64_t size = 1;
  std::uint64_t value = 1;
  while (size < place + 1) {
    size = 2 * size + 1;
    value *= 2;
  }
  while (size - 1 != place) {
    size = (size - 1) / 2;
    value /= 2;
    place %= size;
  }
  return value;
}

}  // namespace cbc
