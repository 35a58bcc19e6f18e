#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "cbc/units.h"

/// UTF-8. "Character" means code point; every byte that is not part of a valid sequence counts as
/// one character, so that positions in invalid text are defined, too.
namespace cbc::utf8 {

/// Stands for a byte that is not part of a valid sequence.
inline constexpr char32_t replacement = 0xFFFD;

/// May precede a text, and is not part of it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

struct Decoded {
  char32_t character = replacement;
  std::size_t bytes = 1;
  bool valid = false;
};

/// The character that begins at `text[offset]`; `offset` lies within the text.
[[nodiscard]] Decoded decode(std::string_view text, std::size_t offset);

/// Offset of the first byte that makes `text` invalid, or nothing.
[[nodiscard]] std::optional<std::size_t> find_invalid(std::string_view text);

[[nodiscard]] std::size_t count_characters(std::string_view text);

/// Columns that a character takes on a terminal: 0, 1 or 2.
[[nodiscard]] std::size_t display_width(char32_t character);

}  // namespace cbc::utf8

namespace cbc {

/// Concatenates texts and numbers.
template <typename... Parts>
[[nodiscard]] std::string concat(const Parts&... parts) {
  std::string text;
  const auto append = [&text](const auto& part) {
    if constexpr (requires { std::to_string(part); }) {
      text += std::to_string(part);
    } else {
      text += part;
    }
  };
  (append(parts), ...);
  return text;
}

/// Whether nothing is seen of a character, so that names that differ in it look alike: it has
/// Unicode's property Default_Ignorable_Code_Point, marks annotations, or is no character (U+FFFE).
[[nodiscard]] bool is_invisible(char32_t character);

/// Whether a terminal would not just print a character: control characters, those that break lines
/// or change the direction of the text, and invisible ones.
[[nodiscard]] bool is_control(char32_t character);

/// A piece of input as it is shown in a message: in single quotes, on one line, without control
/// characters, and cut if it is long.
[[nodiscard]] std::string quote(std::string_view text);

/// The same without quotes and without a limit, for tables.
[[nodiscard]] std::string printable(std::string_view text);

/// Why a text is not a number of the requested kind.
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
