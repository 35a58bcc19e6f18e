#pragma once

#include <cstdint>

#include "cbc/units.h"

/// Suitabilities and performances as costs, so that products become sums: their logarithms, and
/// back. Computed with integers, as the functions of a math library may differ in the last bit from
/// machine to machine, and compiled catalogs must not.
namespace cbc {

/// -ln(degree / 10^6) in units of 2^-40, for degree in [1, 10^6]; 0 for degree 0, which callers
/// handle separately.
///
/// It is built from the rounded logarithms of the prime factors, so equal products of degrees have
/// equal sums of costs, to the bit; sums of different products that are further apart than
/// log_cost_error for each factor other than 1 are in the right order. Closer sums are compared by
/// exact products; see docs/semantics.md, "Performance".
[[nodiscard]] std::int64_t log_cost(Millionths degree);

/// Bound on the error of one log_cost: at most 19 + 12 prime factors, each half a unit off.
inline constexpr std::int64_t log_cost_error = 16;

/// At least the product of up to `factors` suitabilities whose costs, by log_cost, have a sum of
/// `cost` or more. The same on all machines.
[[nodiscard]] double highest_product(std::int64_t cost, std::uint32_t factors);

}  // namespace cbc
