#pragma once

#include <cstdint>

#include "cbc/units.h"

namespace cbc {

/// -ln(degree / 10^6) in units of 2^-40, for degree in [1, 10^6]; 0 for degree 0 (which callers
/// treat apart).
///
/// It is built from the rounded logarithms of the prime factors, so equal products of degrees have
/// equal sums of costs, to the bit; sums of different products that are further apart than
/// log_cost_error for each factor other than 1 are in the right order. What is closer is decided
/// by exact products.
[[nodiscard]] std::int64_t log_cost(Millionths degree);

/// Bound on the error of one log_cost: at most 19 + 12 prime factors, each half a unit off.
inline constexpr std::int64_t log_cost_error = 16;

}  // namespace cbc
