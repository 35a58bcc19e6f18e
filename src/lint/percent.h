#pragma once

#include <string>
#include <vector>

#include "cbc/diagnostic.h"
#include "cbc/units.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Whether a percentage is over 0 and at most 1: probably a fraction where percent is meant.
[[nodiscard]] bool looks_like_fraction(Millionths degree);

/// A product of degrees, rounded down to four places.
[[nodiscard]] std::string show_product(const std::vector<Millionths>& factors);

/// Reports a minimum performance that looks like a fraction.
void check_suspicious_minimum(Millionths minimum, const Range& range, Reporter& reporter);

}  // namespace cbc
