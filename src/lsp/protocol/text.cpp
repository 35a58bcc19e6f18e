#include "lsp/protocol/text.h"

#include <algorithm>
#include <utility>

#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

/// Code units of UTF-16 that a character takes.
std::size_t units_of(const utf8::Decoded& decoded) { return decoded.character > 0xFFFF ? 2 : 1; }

std::vector<std::size_t> begins_of_lines(std::string_view text) {
  std::vector<std::size_t> begins{0};
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_pair = text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n';
    if (text[at] == '\n' || (text[at] == '\r' && !is_pair)) begins.push_back(at + 1);
  }
  return begins;
}

}  // namespace

Text::Text(std::string content, Encoding encoding)
    : content_(std::move(content)),
      encoding_(encoding),
      lines_(begins_of_lines(content_)),
      marks_(marks_of_lines()),
      positions_(utf8::without_byte_order_mark(content_)) {}

/// Without the line break.
std::size_t Text::end_of_line(std::size_t line) const {
  std::size_t end = line + 1 < lines_.size() ? lines_[line + 1] : content_.size();
  while (end > lines_[line] && (content_[end - 1] == '\n' || content_[end - 1] == '\r')) --end;
  return end;
}

/// A file of JSON may be one line of any length; what is shorter than this needs no mark.
std::vector<Text::Mark> Text::marks_of_lines() const {
  constexpr std::size_t distance = 1024;
  std::vector<Mark> marks;
  if (encoding_ == Encoding::utf8) return marks;
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    const std::size_t end = end_of_line(line);
    Mark at{lines_[line], 0};
    for (std::size_t next = at.offset + distance; next < end; next = at.offset + distance) {
      while (at.offset < next) {
        const utf8::Decoded decoded = utf8::decode(content_, at.offset);
        at.units += units_of(decoded);
        at.offset += decoded.bytes;
      }
      marks.push_back(at);
    }
  }
  return marks;
}

/// The last one in a line that is not behind something, or else the begin of the line.
template <typename IsBehind>
Text::Mark Text::last_mark(std::size_t line, const IsBehind& is_behind) const {
  const std::size_t end = line + 1 < lines_.size() ? lines_[line + 1] : content_.size() + 1;
  const auto next = std::partition_point(marks_.begin(), marks_.end(), [&](const Mark& mark) {
    return mark.offset < lines_[line] || (mark.offset < end && !is_behind(mark));
  });
  if (next == marks_.begin() || (next - 1)->offset < lines_[line]) return {lines_[line], 0};
  return *(next - 1);
}

std::size_t Text::offset_of(const Place& place) const {
  if (place.line >= lines_.size()) return content_.size();
  std::size_t at = lines_[place.line];
  const std::size_t end = end_of_line(place.line);
  if (encoding_ == Encoding::utf8) {
    at = std::min(end, at + place.character);
    while (at > lines_[place.line] && at < end && is_continuation(content_[at])) --at;
    return at;
  }
  const Mark mark =
      last_mark(place.line, [&](const Mark& other) { return other.units > place.character; });
  at = mark.offset;
  for (std::size_t left = place.character - mark.units; at < end;) {
    const utf8::Decoded decoded = utf8::decode(content_, at);
    if (left < units_of(decoded)) break;
    left -= units_of(decoded);
    at += decoded.bytes;
  }
  return at;
}

Place Text::place_of(std::size_t offset) const {
  offset = std::min(offset, content_.size());
  const auto next = std::upper_bound(lines_.begin(), lines_.end(), offset);
  const auto line = static_cast<std::size_t>(next - lines_.begin()) - 1;
  std::size_t character = 0;
  if (encoding_ == Encoding::utf8) {
    character = offset - lines_[line];
  } else {
    const Mark mark =
        last_mark(line, [offset](const Mark& other) { return other.offset > offset; });
    character = mark.units;
    for (std::size_t at = mark.offset; at < offset;) {
      const utf8::Decoded decoded = utf8::decode(content_, at);
      if (at + decoded.bytes > offset) break;
      character += units_of(decoded);
      at += decoded.bytes;
    }
  }
  return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(character)};
}

std::size_t Text::offset_of(const Position& position) const {
  const std::size_t mark = content_.size() - utf8::without_byte_order_mark(content_).size();
  return mark + positions_.offset(position);
}

PlaceRange Text::range_of(const Range& range) const {
  return {place_of(offset_of(range.begin)), place_of(offset_of(range.end))};
}

namespace {

/// What is left of two pieces without what both begin and end with, moved by an offset.
TextChange difference(std::string_view before, std::string_view after, std::size_t offset) {
  const std::size_t most = std::min(before.size(), after.size());
  std::size_t head = 0;
  while (head < most && before[head] == after[head]) ++head;
  while (head > 0 && head < before.size() && is_continuation(before[head])) --head;
  std::size_t tail = 0;
  while (tail < most - head && before[before.size() - 1 - tail] == after[after.size() - 1 - tail]) {
    ++tail;
  }
  while (tail > 0 && is_continuation(before[before.size() - tail])) --tail;
  return {offset + head, offset + before.size() - tail,
          std::string(after.substr(head, after.size() - tail - head))};
}

}  // namespace

std::vector<TextChange> changes_between(std::string_view before, std::string_view after) {
  if (before == after) return {};
  if (std::count(before.begin(), before.end(), '\n') !=
      std::count(after.begin(), after.end(), '\n')) {
    return {difference(before, after, 0)};
  }
  std::vector<TextChange> changes;
  for (std::size_t old_at = 0, new_at = 0; old_at <= before.size() && new_at <= after.size();) {
    const std::size_t old_end = std::min(before.find('\n', old_at), before.size());
    const std::size_t new_end = std::min(after.find('\n', new_at), after.size());
    const std::string_view old_line = before.substr(old_at, old_end - old_at);
    const std::string_view new_line = after.substr(new_at, new_end - new_at);
    if (old_line != new_line) changes.push_back(difference(old_line, new_line, old_at));
    old_at = old_end + 1;
    new_at = new_end + 1;
  }
  return changes;
}

}  // namespace cbc::lsp
