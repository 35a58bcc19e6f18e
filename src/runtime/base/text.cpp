#include "runtime/base/text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace cbc::utf8 {
namespace {

struct Interval {
  char32_t first;
  char32_t last;
};

// The blocks that matter for source lines; a wrong width only moves a caret.
constexpr std::array zero_width = {
    Interval{0x0300, 0x036F}, Interval{0x200B, 0x200F}, Interval{0x20D0, 0x20FF},
    Interval{0xFE00, 0xFE0F}, Interval{0xFE20, 0xFE2F}, Interval{0xFEFF, 0xFEFF},
};
/// Default_Ignorable_Code_Point of Unicode 15, the marks of annotations (U+FFF9 to U+FFFB), the
/// Braille pattern without dots (U+2800), and what is no character, of which XML allows not all.
constexpr std::array invisible = {
    Interval{0x00AD, 0x00AD},   Interval{0x034F, 0x034F},   Interval{0x061C, 0x061C},
    Interval{0x115F, 0x1160},   Interval{0x17B4, 0x17B5},   Interval{0x180B, 0x180F},
    Interval{0x200B, 0x200F},   Interval{0x202A, 0x202E},   Interval{0x2060, 0x206F},
    Interval{0x2800, 0x2800},   Interval{0x3164, 0x3164},   Interval{0xFE00, 0xFE0F},
    Interval{0xFDD0, 0xFDEF},   Interval{0xFEFF, 0xFEFF},   Interval{0xFFA0, 0xFFA0},
    Interval{0xFFF0, 0xFFFB},   Interval{0xFFFE, 0xFFFF},   Interval{0x1BCA0, 0x1BCA3},
    Interval{0x1D173, 0x1D17A}, Interval{0xE0000, 0xE0FFF},
};
constexpr std::array double_width = {
    Interval{0x1100, 0x115F},   Interval{0x2E80, 0x303E},   Interval{0x3041, 0xA4CF},
    Interval{0xAC00, 0xD7A3},   Interval{0xF900, 0xFAFF},   Interval{0xFE30, 0xFE6F},
    Interval{0xFF00, 0xFF60},   Interval{0xFFE0, 0xFFE6},   Interval{0x1F300, 0x1F64F},
    Interval{0x1F680, 0x1F6FF}, Interval{0x1F900, 0x1F9FF}, Interval{0x20000, 0x3FFFD},
};

template <std::size_t size>
bool contains(const std::array<Interval, size>& intervals, char32_t character) {
  return std::any_of(intervals.begin(), intervals.end(), [character](const Interval& interval) {
    return interval.first <= character && character <= interval.last;
  });
}

/// How many bytes at a place are certainly ASCII: a multiple of eight.
std::size_t skip_ascii(std::string_view text, std::size_t offset) {
  std::size_t bytes = 0;
  std::uint64_t word = 0;
  while (text.size() - offset - bytes >= sizeof word) {
    std::memcpy(&word, text.data() + offset + bytes, sizeof word);
    if ((word & 0x8080808080808080) != 0) break;
    bytes += sizeof word;
  }
  return bytes;
}

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

Decoded decode(std::string_view text, std::size_t offset) {
  const auto lead = static_cast<unsigned char>(text[offset]);
  if (lead < 0x80) return {lead, 1, true};

  std::size_t bytes = 0;
  char32_t character = 0;
  char32_t smallest = 0;  // a smaller one is an overlong form
  if ((lead & 0xE0U) == 0xC0U) {
    bytes = 2;
    character = lead & 0x1FU;
    smallest = 0x80;
  } else if ((lead & 0xF0U) == 0xE0U) {
    bytes = 3;
    character = lead & 0x0FU;
    smallest = 0x800;
  } else if ((lead & 0xF8U) == 0xF0U) {
    bytes = 4;
    character = lead & 0x07U;
    smallest = 0x10000;
  } else {
    return {};
  }
  if (text.size() - offset < bytes) return {};
  for (std::size_t i = 1; i < bytes; ++i) {
    const char byte = text[offset + i];
    if (!is_continuation(byte)) return {};
    character = (character << 6U) | (static_cast<unsigned char>(byte) & 0x3FU);
  }
  const bool surrogate = character >= 0xD800 && character <= 0xDFFF;
  if (character < smallest || character > 0x10FFFF || surrogate) return {};
  return {character, bytes, true};
}

std::optional<std::size_t> find_invalid(std::string_view text) {
  for (std::size_t offset = skip_ascii(text, 0); offset < text.size();) {
    const Decoded decoded = decode(text, offset);
    if (!decoded.valid) return offset;
    offset += decoded.bytes;
    if (decoded.bytes > 1) offset += skip_ascii(text, offset);
  }
  return std::nullopt;
}

std::size_t count_characters(std::string_view text) {
  std::size_t count = skip_ascii(text, 0);
  for (std::size_t offset = count; offset < text.size(); ++count) {
    const std::size_t bytes = decode(text, offset).bytes;
    const std::size_t skipped = bytes > 1 ? skip_ascii(text, offset + bytes) : 0;
    offset += bytes + skipped;
    count += skipped;
  }
  return count;
}

std::size_t display_width(char32_t character) {
  if (contains(zero_width, character)) return 0;
  return contains(double_width, character) ? 2 : 1;
}

}  // namespace cbc::utf8

namespace cbc {

bool is_invisible(char32_t character) {
  return character >= utf8::invisible.front().first && utf8::contains(utf8::invisible, character);
}

namespace {

constexpr std::size_t longest = 80;

std::string escape(char32_t character) {
  constexpr std::string_view digits = "0123456789abcdef";
  switch (character) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      break;
  }
  std::string result = character < 0x100 ? "\\x" : character < 0x10000 ? "\\u" : "\\U";
  for (unsigned shift = character < 0x100 ? 8 : character < 0x10000 ? 16 : 32; shift > 0;) {
    shift -= 4;
    result += digits[(character >> shift) & 0xFU];
  }
  return result;
}

/// At most `limit` characters of the text, with what does not print escaped.
std::string escape_some(std::string_view text, std::size_t limit) {
  std::string result;
  std::size_t characters = 0;
  const auto prints = [](char byte) { return byte >= ' ' && byte < 0x7F; };
  for (std::size_t offset = 0; offset < text.size(); ++characters) {
    const std::size_t begin = offset;
    for (; offset < text.size() && characters < limit && prints(text[offset]); ++characters) {
      ++offset;
    }
    result += text.substr(begin, offset - begin);
    if (offset == text.size()) break;
    if (characters == limit) return result + "...";
    const utf8::Decoded decoded = utf8::decode(text, offset);
    if (!decoded.valid) {
      result += escape(static_cast<unsigned char>(text[offset]));
    } else if (is_control(decoded.character)) {
      result += escape(decoded.character);
    } else {
      result += text.substr(offset, decoded.bytes);
    }
    offset += decoded.bytes;
  }
  return result;
}

}  // namespace

bool is_control(char32_t character) {
  return character < 0x20 || (character >= 0x7F && character < 0xA0) || character == 0x2028 ||
         character == 0x2029 || is_invisible(character);
}

std::string quote(std::string_view text) { return concat("'", escape_some(text, longest), "'"); }

std::string printable(std::string_view text) { return escape_some(text, text.size()); }

namespace {

constexpr Decimal failure(DecimalError error) { return {0, error}; }

bool is_digit(char character) { return character >= '0' && character <= '9'; }

// Far beyond any exponent that matters, and far from overflow, as texts have fewer digits.
constexpr std::int64_t exponent_limit = 1'000'000'000'000;

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<Number> scan() {
    Number number;
    number.negative = take_sign();
    std::string digits(take_digits());
    const std::size_t before_point = digits.size();
    if (take('.')) digits += take_digits();
    if (digits.empty()) return std::nullopt;
    std::int64_t exponent = 0;
    if (take('e') || take('E')) {
      const bool negative = take_sign();
      const std::string_view exponent_digits = take_digits();
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
    digits.erase(0, first);
    number.digits = std::move(digits);
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

  std::string_view take_digits() {
    std::size_t size = 0;
    while (size < text_.size() && is_digit(text_[size])) ++size;
    const std::string_view digits = text_.substr(0, size);
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
  // The range is checked first: "100.00001 is over 100" is the more useful message.
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
  text.insert(text.end() - decimals, '.');
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return negative ? concat("-", text) : text;
}

std::string format_percent(std::int64_t degree) { return format_decimal(degree, 4) + " %"; }

}  // namespace cbc
