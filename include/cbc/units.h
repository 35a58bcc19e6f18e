#pragma once

#include <cstdint>

namespace cbc {

/// A degree in [0, 1] in millionths: suitability, performance, minimum performance. 100 % is
/// 1'000'000; percentages of a catalog are exact to four decimals.
using Millionths = std::uint32_t;
inline constexpr Millionths one_million = 1'000'000;

/// A duration or an instant on the coordinator's clock, in microseconds.
using Microseconds = std::int64_t;
inline constexpr Microseconds second = 1'000'000;

/// Largest instant or duration that is accepted from outside: about 31 years.
inline constexpr Microseconds longest_time = 1'000'000'000 * second;

}  // namespace cbc
