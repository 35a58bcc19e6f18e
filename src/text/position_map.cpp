#include "text/position_map.h"

#include <algorithm>

namespace cbc {
namespace {

constexpr std::size_t stride = 256;

// Bytes that begin a character. Texts that are no valid UTF-8 are refused at the first bad byte,
// so what stray continuation bytes count for does not matter.
std::size_t count_beginnings(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
  }));
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

}  // namespace cbc
