#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "cbc/units.h"

namespace cbc {

/// An exact product of degrees, to decide what sums of logarithms leave open.
class ExactProduct {
 public:
  /// Makes products of up to `factors` factors without further allocation.
  void reserve(std::size_t factors);
  void clear();
  void multiply(Millionths degree);

  /// Compares the products. Both may grow by factors of 1 in doing so.
  static std::strong_ordering compare(ExactProduct& a, ExactProduct& b);

 private:
  void scale(std::uint32_t factor);

  std::vector<std::uint32_t> limbs_{1};  ///< product of the numerators, lowest limb first
  std::uint32_t factors_ = 0;            ///< the denominator is 10^6 to this power
};

}  // namespace cbc
