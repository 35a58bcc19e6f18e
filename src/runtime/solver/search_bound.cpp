#include "solver/search_bound.h"

#include <algorithm>
#include <cmath>

#include "base/fixed_point.h"
#include "compiled/compiled_catalog.h"

namespace cbc {
namespace {

/// e^-x for x below ln(2), rounded up. The terms of the series are less than a unit off each.
std::uint64_t exponential(std::uint64_t x) {
  constexpr std::uint64_t error = 32;
  std::uint64_t sum = fixed::one;
  std::uint64_t term = fixed::one;
  bool is_added = false;
  for (std::uint64_t divisor = 1; term > 0; ++divisor, is_added = !is_added) {
    term = fixed::multiply(term, x) / divisor;
    sum = is_added ? sum + term : sum - term;
  }
  return sum + error;
}

}  // namespace

double highest_product(std::int64_t cost, std::uint32_t factors) {
  constexpr std::int64_t unit = std::int64_t{1} << 40;
  constexpr std::int64_t with_zero = std::int64_t{1} << 60;  // a suitability of 0
  if (cost >= with_zero) return 0;
  const std::int64_t least = cost - log_cost_error * std::int64_t{factors};
  if (least <= 0) return 1;
  constexpr double e_to_minus_700 = 1e-304;  // rounded up
  if (least >= 700 * unit) return e_to_minus_700;
  const fixed::Wide log = fixed::Wide{static_cast<std::uint64_t>(least)} << (fixed::bits - 40);
  const auto halvings = static_cast<int>(log / fixed::log_of_two);
  const auto rest = static_cast<std::uint64_t>(log % fixed::log_of_two);
  const double product =
      std::ldexp(static_cast<double>(exponential(rest)), -static_cast<int>(fixed::bits) - halvings);
  return std::min(1.0, std::nextafter(product, 1.0));
}

}  // namespace cbc
