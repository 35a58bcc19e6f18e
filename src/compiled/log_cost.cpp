#include "compiled/log_cost.h"

#include <cmath>

namespace cbc {
namespace {

std::int64_t log_of_prime(Millionths prime) {
  return std::llround(std::log(static_cast<double>(prime)) * 0x1p40);
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

}  // namespace

std::int64_t log_cost(Millionths degree) {
  if (degree == 0) return 0;
  return sum_of_prime_logs(one_million) - sum_of_prime_logs(degree);
}

}  // namespace cbc
