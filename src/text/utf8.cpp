#include "text/utf8.h"

#include <algorithm>
#include <array>

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
  for (std::size_t offset = 0; offset < text.size();) {
    const Decoded decoded = decode(text, offset);
    if (!decoded.valid) return offset;
    offset += decoded.bytes;
  }
  return std::nullopt;
}

std::size_t count_characters(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t offset = 0; offset < text.size(); ++count) {
    offset += decode(text, offset).bytes;
  }
  return count;
}

std::size_t display_width(char32_t character) {
  if (contains(zero_width, character)) return 0;
  return contains(double_width, character) ? 2 : 1;
}

}  // namespace cbc::utf8
