#include "lint/percent.h"

#include "cbc/rules.h"
#include "text/decimal.h"

namespace cbc {

bool looks_like_fraction(Millionths degree) {
  constexpr Millionths one_percent = one_million / 100;
  return degree > 0 && degree <= one_percent;
}

std::string show_percent(Millionths degree) { return format_decimal(degree, 4) + " %"; }

void check_suspicious_minimum(Millionths minimum, const Range& range, Reporter& reporter) {
  if (!looks_like_fraction(minimum)) return;
  reporter.report(rule::suspicious_minimum, range,
                  "a minimum_performance of " + show_percent(minimum) + " is next to nothing; is " +
                      show_percent(minimum * 100) + " meant?");
}

}  // namespace cbc
