#include "runtime/compiled/log_cost.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cbc {
namespace {

__extension__ using Wide = unsigned __int128;  // -Wpedantic knows no such type

constexpr unsigned bits = 60;  ///< after the binary point
constexpr std::uint64_t one = std::uint64_t{1} << bits;
constexpr std::uint64_t log_of_two = 799'144'290'325'165'979;  ///< ln(2) * 2^60

std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>((Wide{a} * b) >> bits);
}

/// ln(m) = 2 artanh(z) = 2 (z + z^3 / 3 + z^5 / 5 + ...) with z = (m - 1) / (m + 1), for
/// n = m * 2^exponent and m in [1, 2), so that z is at most 1/3.
std::int64_t log_of_prime(Millionths prime) {
  const auto exponent = static_cast<unsigned>(std::bit_width(prime)) - 1;
  const std::uint64_t m = std::uint64_t{prime} << (bits - exponent);
  const auto z = static_cast<std::uint64_t>((Wide{m - one} << bits) / (m + one));
  const std::uint64_t square = multiply(z, z);
  std::uint64_t sum = 0;
  std::uint64_t divisor = 1;
  for (std::uint64_t power = z; power > 0; power = multiply(power, square)) {
    sum += power / divisor;
    divisor += 2;
  }
  const Wide log = Wide{exponent} * log_of_two + 2 * Wide{sum};
  constexpr unsigned surplus = bits - 40;
  return static_cast<std::int64_t>((log + (Wide{1} << (surplus - 1))) >> surplus);
}

std::int64_t sum_of_prime_logs(Millionths number) {
  std::int64_t sum = 0;
  for (Millionths divisor = 2; divisor * divisor <= number; ++divisor) {
    if (number % divisor != 0) continue;
    const std::int64_t log = log_of_prime(divisor);
    for (; number % divisor == 0; number /= divisor) sum += log;
  }
  return number > 1 ? sum + log_of_prime(number) : sum;
}

/// e^-x for x below ln(2), rounded up. The terms of the series are less than a unit off each.
std::uint64_t exponential(std::uint64_t x) {
  constexpr std::uint64_t error = 32;
  std::uint64_t sum = one;
  std::uint64_t term = one;
  bool is_added = false;
  for (std::uint64_t divisor = 1; term > 0; ++divisor, is_added = !is_added) {
    term = multiply(term, x) / divisor;
    sum = is_added ? sum + term : sum - term;
  }
  return sum + error;
}

}  // namespace

std::int64_t log_cost(Millionths degree) {
  if (degree == 0) return 0;
  return sum_of_prime_logs(one_million) - sum_of_prime_logs(degree);
}

double highest_product(std::int64_t cost, std::uint32_t factors) {
  constexpr std::int64_t unit = std::int64_t{1} << 40;
  constexpr std::int64_t with_zero = std::int64_t{1} << 60;  // a suitability of 0
  if (cost >= with_zero) return 0;
  const std::int64_t least = cost - log_cost_error * std::int64_t{factors};
  if (least <= 0) return 1;
  constexpr double e_to_minus_700 = 1e-304;  // rounded up
  if (least >= 700 * unit) return e_to_minus_700;
  const Wide log = Wide{static_cast<std::uint64_t>(least)} << (bits - 40);
  const auto halvings = static_cast<int>(log / log_of_two);
  const auto rest = static_cast<std::uint64_t>(log % log_of_two);
  const double product =
      std::ldexp(static_cast<double>(exponential(rest)), -static_cast<int>(bits) - halvings);
  return std::min(1.0, std::nextafter(product, 1.0));
}

}  // namespace cbc
