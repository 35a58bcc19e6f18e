#include "text/position_map.h"

#include <algorithm>

namespace cbc {
namespace {

constexpr std::size_t stride = 256;

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

// Bytes that begin a character. Texts that are no valid UTF-8 are refused at the first bad byte,
// so what stray continuation bytes count for does not matter.
std::size_t count_beginnings(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !is_continuation(byte); }));
}

}  // namespace

PositionMap::PositionMap(std::string_view text) : text_(text), line_starts_{0} {
  for (std::size_t at = text.find('\n'); at != std::string_view::npos;
       at = text.find('\n', at + 1)) {
    line_starts_.push_back(at + 1);
  }
  checkpoints_.reserve(text.size() / stride + 1);
  std::size_t characters = 0;
  for (std::size_t at = 0; at <= text.size(); at += stride) {
    checkpoints_.push_back(characters);
    characters += count_beginnings(text.substr(at, stride));
  }
}

std::size_t PositionMap::characters_before(std::size_t offset) const {
  const std::size_t block = offset / stride;
  return checkpoints_[block] +
         count_beginnings(text_.substr(block * stride, offset - block * stride));
}

std::size_t PositionMap::characters_between(std::size_t begin, std::size_t end) const {
  if (end - begin <= stride) return count_beginnings(text_.substr(begin, end - begin));
  return characters_before(end) - characters_before(begin);
}

Position PositionMap::at(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::size_t start = *(next - 1);
  return {static_cast<std::uint32_t>(next - line_starts_.begin()),
          static_cast<std::uint32_t>(characters_between(start, offset) + 1)};
}

std::string_view PositionMap::line(std::uint32_t number) const {
  if (number == 0 || number > line_starts_.size()) return {};
  const std::size_t begin = line_starts_[number - 1];
  std::size_t end = number < line_starts_.size() ? line_starts_[number] - 1 : text_.size();
  if (end > begin && text_[end - 1] == '\r') --end;
  return text_.substr(begin, end - begin);
}

/// Where in [begin, end] the given number of characters lies behind `begin`.
std::size_t PositionMap::offset_of(std::size_t begin, std::size_t end,
                                   std::size_t characters) const {
  const std::size_t wanted = characters_before(begin) + characters;
  const auto next = std::upper_bound(checkpoints_.begin(), checkpoints_.end(), wanted);
  const auto block = static_cast<std::size_t>(next - checkpoints_.begin()) - 1;
  std::size_t offset = std::max(begin, block * stride);
  // A block may begin within a character, which counts as one before it.
  while (offset < end && is_continuation(text_[offset])) ++offset;
  for (std::size_t seen = characters_before(offset); seen < wanted && offset < end; ++seen) {
    do {
      ++offset;
    } while (offset < end && is_continuation(text_[offset]));
  }
  return std::min(offset, end);
}

std::size_t PositionMap::offset(const Position& place) const {
  if (place.line > line_starts_.size()) return text_.size();
  const std::size_t begin = line_starts_[place.line - 1];
  const std::size_t end =
      place.line < line_starts_.size() ? line_starts_[place.line] - 1 : text_.size();
  return offset_of(begin, end, place.column - 1);
}

PositionMap::Excerpt PositionMap::excerpt(const Position& place, std::size_t radius) const {
  const std::string_view whole = line(place.line);
  if (whole.empty()) return {};
  const std::size_t begin = line_starts_[place.line - 1];
  const std::size_t end = begin + whole.size();
  const std::size_t column = place.column - 1;
  const std::size_t before = column > radius ? column - radius : 0;
  const std::size_t from = offset_of(begin, end, before);
  const std::size_t to = offset_of(begin, end, column + radius);
  return {text_.substr(from, to - from), characters_between(begin, from), to < end};
}

}  // namespace cbc
