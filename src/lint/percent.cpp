#include "lint/percent.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "cbc/rules.h"
#include "text/decimal.h"

namespace cbc {

bool looks_like_fraction(Millionths degree) {
  constexpr Millionths one_percent = one_million / 100;
  return degree > 0 && degree <= one_percent;
}

std::string show_product(const std::vector<Millionths>& factors) {
  using boost::multiprecision::cpp_int;
  cpp_int product = 1;
  cpp_int divisor = 1;
  for (const Millionths factor : factors) {
    product *= factor;
    divisor *= one_million;
  }
  return format_percent(static_cast<Millionths>(product * one_million / divisor));
}

void check_suspicious_minimum(Millionths minimum, const Range& range, Reporter& reporter) {
  if (!looks_like_fraction(minimum)) return;
  reporter.report(rule::suspicious_minimum, range,
                  "a minimum_performance of " + format_percent(minimum) +
                      " is next to nothing; is " + format_percent(std::int64_t{minimum} * 100) +
                      " meant?");
}

}  // namespace cbc
