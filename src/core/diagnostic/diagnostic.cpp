#include "core/diagnostic/diagnostic.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {

std::string_view name_of(Severity severity) {
  constexpr std::string_view names[] = {"note", "warning", "error"};
  return names[static_cast<std::size_t>(severity)];
}

std::string format_place(std::string_view file, const Position& place) {
  return fmt::format("{}:{}:{}", file, place.line, place.column);
}

void Diagnostics::add(Diagnostic diagnostic) { all_.push_back(std::move(diagnostic)); }

void Diagnostics::sort() {
  // Findings at the same place keep the order in which they were reported.
  std::stable_sort(all_.begin(), all_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.file, a.range.begin, a.rule) < std::tie(b.file, b.range.begin, b.rule);
  });
}

std::size_t Diagnostics::count(Severity severity) const {
  return static_cast<std::size_t>(std::count_if(
      all_.begin(), all_.end(),
      [severity](const Diagnostic& diagnostic) { return diagnostic.severity == severity; }));
}

void Reporter::report(const Rule& rule, const Range& range, std::string message,
                      std::vector<Note> notes, std::vector<Edit> edits) {
  report_as({rule.severity, rule.is_fixed}, rule, range, std::move(message), std::move(notes),
            std::move(edits));
}

void Reporter::report_as(const Standing& standing, const Rule& rule, const Range& range,
                         std::string message, std::vector<Note> notes, std::vector<Edit> edits) {
  std::string identity(rule.name);
  identity += ' ' + std::to_string(range.begin.line) + ' ' + std::to_string(range.begin.column) +
              ' ' + message;
  if (!reported_.insert(std::move(identity)).second) return;
  if (standing.severity == Severity::error) {
    ++errors_;
    ++errors_of_[rule.name];
  }
  diagnostics_.add({rule.name, standing.severity, file_, range, std::move(message),
                    std::move(notes), std::move(edits), standing.is_fixed, standing.is_off});
}

std::size_t Reporter::errors(const Rule& rule) const {
  const auto found = errors_of_.find(rule.name);
  return found == errors_of_.end() ? 0 : found->second;
}

namespace {

constexpr std::size_t stride = 256;

bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

// Bytes that begin a character, eight at a time: every byte of every input is counted here. Texts
// that are not valid UTF-8 are refused at the first bad byte, so it does not matter how stray
// continuation bytes count.
std::size_t count_beginnings(std::string_view text) {
  constexpr std::uint64_t lowest_bits = 0x0101'0101'0101'0101;
  std::size_t count = text.size();
  std::size_t at = 0;
  for (; at + 8 <= text.size(); at += 8) {
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, text.data() + at, 8);
    const std::uint64_t continuations = (bytes >> 7) & ~(bytes >> 6) & lowest_bits;
    count -= (continuations * lowest_bits) >> 56;  // the product adds all bytes up in the highest
  }
  for (; at < text.size(); ++at) count -= is_continuation(text[at]) ? 1U : 0U;
  return count;
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

namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";
constexpr std::string_view excerpt_indentation = "  ";
constexpr std::string_view ellipsis = "...";

// Characters of a line that are shown, and how many of them come before the place.
constexpr std::size_t longest_line = 96;
constexpr std::size_t context_before = 48;

// One character of a line as it is printed.
struct Cell {
  std::string_view text;
  std::string_view blank;  // takes the same number of columns in the line of the caret
  std::size_t width = 1;
};

std::vector<Cell> split(std::string_view line) {
  constexpr std::string_view blanks = "  ";
  std::vector<Cell> cells;
  for (std::size_t offset = 0; offset < line.size();) {
    const utf8::Decoded decoded = utf8::decode(line, offset);
    const char32_t character = decoded.character;
    if (character == '\t') {
      cells.push_back({"\t", "\t", 1});
    } else if (!decoded.valid || is_control(character)) {
      cells.push_back({replacement_character, " ", 1});
    } else {
      const std::size_t width = utf8::display_width(character);
      cells.push_back({line.substr(offset, decoded.bytes), blanks.substr(0, width), width});
    }
    offset += decoded.bytes;
  }
  return cells;
}

// The line of a place, and a caret below it with a tail up to the end of the range.
std::string render_line(const Range& range, const PositionMap::Excerpt& line, const Style& style) {
  const std::vector<Cell> cells = split(line.text);
  const auto cell_of = [&](std::uint32_t column) {
    return std::min<std::size_t>(column - 1 - line.characters_before, cells.size());
  };
  const std::size_t begin = cell_of(range.begin.column);
  const bool ends_here = range.end.line == range.begin.line;
  const std::size_t end = std::max(ends_here ? cell_of(range.end.column) : cells.size(), begin + 1);

  std::size_t first = 0;
  std::size_t last = cells.size();
  if (cells.size() > longest_line) {
    first = begin > context_before ? begin - context_before : 0;
    first = std::min(first, cells.size() - longest_line);
    last = first + longest_line;
  }

  std::string source(excerpt_indentation);
  std::string blank(excerpt_indentation);
  std::size_t tail = 0;
  if (first > 0 || line.characters_before > 0) {
    source += ellipsis;
    blank.append(ellipsis.size(), ' ');
  }
  for (std::size_t i = first; i < last; ++i) {
    source += cells[i].text;
    if (i < begin) blank += cells[i].blank;
    if (i > begin && i < end) tail += cells[i].width;
    if (i == begin && cells[i].width > 1) tail += cells[i].width - 1;
  }
  if (last < cells.size() || line.is_cut_after) source += ellipsis;
  return source + "\n" + blank + style.paint(style.caret, "^" + std::string(tail, '~')) + "\n";
}

std::string render_place(const std::string& file, const Range& range, Severity severity,
                         const std::string& message, const SourceTexts& sources,
                         const Style& style) {
  const std::string place = printable(file) + ":" + std::to_string(range.begin.line) + ":" +
                            std::to_string(range.begin.column) + ":";
  std::string text = style.paint(style.strong, place) + " " +
                     style.paint(style.of(severity), std::string(name_of(severity)) + ":") + " " +
                     printable(message) + "\n";
  const PositionMap::Excerpt line = sources.excerpt(file, range.begin, longest_line);
  if (!line.text.empty()) text += render_line(range, line, style);
  return text;
}

}  // namespace

void SourceTexts::add(std::string file, std::string_view text) {
  texts_.try_emplace(std::move(file), utf8::without_byte_order_mark(text));
}

PositionMap::Excerpt SourceTexts::excerpt(std::string_view file, const Position& place,
                                          std::size_t radius) const {
  const auto found = texts_.find(file);
  return found == texts_.end() ? PositionMap::Excerpt{} : found->second.excerpt(place, radius);
}

std::string render(const Diagnostic& diagnostic, const SourceTexts& sources, const Style& style) {
  std::string text =
      render_place(diagnostic.file, diagnostic.range, diagnostic.severity,
                   diagnostic.message + " [" + std::string(diagnostic.rule) + "]", sources, style);
  for (const Note& note : diagnostic.notes) {
    text += render_place(note.file, note.range, Severity::note, note.message, sources, style);
  }
  return text;
}

}  // namespace cbc
