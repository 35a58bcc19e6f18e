#include "sweep/histogram.h"

#include <bit>

namespace cbc {

std::uint64_t Histogram::round_down(std::uint64_t number) {
  constexpr int kept = 10;
  const int width = static_cast<int>(std::bit_width(number));
  if (width <= kept) return number;
  const int dropped = width - kept;
  return (number >> dropped) << dropped;
}

/// The number at a place, from 1, in the ascending order of all.
std::uint64_t Histogram::at_rank(std::uint64_t rank) const {
  std::uint64_t passed = 0;
  for (const auto& [number, count] : counts_) {
    passed += count;
    if (passed >= rank) return number;
  }
  return 0;
}

}  // namespace cbc
