#include "text/decimal.h"

#include <algorithm>
#include <string>

namespace cbc {
namespace {

constexpr Decimal failure(DecimalError error) { return {0, error}; }

bool is_digit(char character) { return character >= '0' && character <= '9'; }

// Far beyond any exponent that matters, far below overflow: the digits of a text are fewer.
constexpr std::int64_t exponent_limit = 1'000'000'000'000;

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<Number> scan() {
    Number number;
    number.negative = take_sign();
    std::string digits = take_digits();
    const std::size_t before_point = digits.size();
    if (take('.')) digits += take_digits();
    if (digits.empty()) return std::nullopt;
    std::int64_t exponent = 0;
    if (take('e') || take('E')) {
      const bool negative = take_sign();
      const std::string exponent_digits = take_digits();
      if (exponent_digits.empty()) return std::nullopt;
      for (const char digit : exponent_digits) {
        exponent = std::min(exponent * 10 + (digit - '0'), exponent_limit);
      }
      if (negative) exponent = -exponent;
    }
    if (!text_.empty()) return std::nullopt;

    const std::size_t first = digits.find_first_not_of('0');
    if (first == std::string::npos) return Number{};
    digits.erase(digits.find_last_not_of('0') + 1);
    number.exponent =
        exponent + static_cast<std::int64_t>(before_point) - static_cast<std::int64_t>(first);
    number.digits = digits.substr(first);
    return number;
  }

 private:
  bool take(char character) {
    if (text_.empty() || text_.front() != character) return false;
    text_.remove_prefix(1);
    return true;
  }

  // Whether the sign is a minus.
  bool take_sign() {
    if (take('+')) return false;
    return take('-');
  }

  std::string take_digits() {
    std::size_t size = 0;
    while (size < text_.size() && is_digit(text_[size])) ++size;
    std::string digits(text_.substr(0, size));
    text_.remove_prefix(size);
    return digits;
  }

  std::string_view text_;
};

}  // namespace

std::optional<Number> parse_number(std::string_view text) { return Scanner(text).scan(); }

std::strong_ordering operator<=>(const Number& a, const Number& b) {
  if (a == b) return std::strong_ordering::equal;
  const auto sign = [](const Number& number) {
    return number.digits.empty() ? 0 : number.negative ? -1 : 1;
  };
  if (sign(a) != sign(b)) return sign(a) <=> sign(b);
  const Number& low = a.negative ? b : a;
  const Number& high = a.negative ? a : b;
  if (low.exponent != high.exponent) return low.exponent <=> high.exponent;
  return low.digits.compare(high.digits) <=> 0;
}

Decimal parse_decimal(std::string_view text, int decimals, std::int64_t lowest,
                      std::int64_t highest) {
  const std::optional<Number> number = parse_number(text);
  if (!number) return failure(DecimalError::not_a_number);

  // The scaled number has `places` digits before its point.
  const std::int64_t places = number->exponent + decimals;
  const bool whole = static_cast<std::int64_t>(number->digits.size()) <= places;
  std::int64_t value = 0;
  if (!number->digits.empty() && places > 0) {
    if (places > 18) return failure(DecimalError::out_of_range);
    for (std::int64_t i = 0; i < places; ++i) {
      const auto at = static_cast<std::size_t>(i);
      value = value * 10 + (at < number->digits.size() ? number->digits[at] - '0' : 0);
    }
  }
  if (number->negative) value = -value;
  // A range comes first: "100.00001 is over 100" is the more useful of the two.
  const bool beyond =
      !whole && !number->digits.empty() &&
      ((!number->negative && value >= highest) || (number->negative && value <= lowest));
  if (value < lowest || value > highest || beyond) return failure(DecimalError::out_of_range);
  if (!whole && !number->digits.empty()) return failure(DecimalError::too_precise);
  return {value, DecimalError::no_error};
}

Decimal parse_percent(std::string_view text) { return parse_decimal(text, 4, 0, one_million); }

Decimal parse_seconds(std::string_view text) { return parse_decimal(text, 6, 0, longest_time); }

Decimal parse_integer(std::string_view text, std::int64_t lowest, std::int64_t highest) {
  if (text.find_first_of(".eE") != std::string_view::npos) {
    return failure(DecimalError::not_a_number);
  }
  return parse_decimal(text, 0, lowest, highest);
}

std::string format_decimal(std::int64_t value, int decimals) {
  const bool negative = value < 0;
  std::string text = std::to_string(value).substr(negative ? 1 : 0);
  const auto places = static_cast<std::size_t>(decimals);
  if (text.size() <= places) text.insert(0, places + 1 - text.size(), '0');
  text.insert(text.size() - places, ".");
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return negative ? "-" + text : text;
}

std::string format_percent(std::int64_t degree) { return format_decimal(degree, 4) + " %"; }

}  // namespace cbc
