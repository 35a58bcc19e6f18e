#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "cbc/units.h"

namespace cbc {

/// Why a text is no value of the kind that was asked for.
enum class DecimalError : std::uint8_t { no_error, not_a_number, out_of_range, too_precise };

/// A number that was read from text, in units of 10^-decimals.
struct Decimal {
  std::int64_t value = 0;
  DecimalError error = DecimalError::no_error;
};

/// Reads a decimal number exactly: sign, digits, fraction and exponent are allowed ("-1.50",
/// ".5", "1e1"), trailing zeros do not count as precision. The value is scaled by 10^decimals; one
/// outside [lowest, highest] (scaled, too) is out of range.
[[nodiscard]] Decimal parse_decimal(std::string_view text, int decimals, std::int64_t lowest,
                                    std::int64_t highest);

/// A percentage from 0 to 100 with at most 4 decimals; `value` is in millionths.
[[nodiscard]] Decimal parse_percent(std::string_view text);

/// Seconds from 0 to longest_time with at most 6 decimals; `value` is in microseconds.
[[nodiscard]] Decimal parse_seconds(std::string_view text);

/// An integer without fraction or exponent.
[[nodiscard]] Decimal parse_integer(std::string_view text, std::int64_t lowest,
                                    std::int64_t highest);

/// A decimal number of any size: 0.DIGITS * 10^exponent, negated if `negative`; zero has no digits.
/// Exponents beyond a trillion, either way, count as a trillion.
struct Number {
  bool negative = false;
  std::string digits;  ///< without zeros at either end
  std::int64_t exponent = 0;

  friend bool operator==(const Number&, const Number&) = default;
  /// By value, exactly.
  friend std::strong_ordering operator<=>(const Number& a, const Number& b);
};

/// A number in any spelling that parse_decimal allows.
[[nodiscard]] std::optional<Number> parse_number(std::string_view text);

/// The shortest text of value * 10^-decimals: "1.5".
[[nodiscard]] std::string format_decimal(std::int64_t value, int decimals);

/// A degree in millionths as people write it: "72.5 %".
[[nodiscard]] std::string format_percent(std::int64_t degree);

}  // namespace cbc
