#include "diagnostic/text.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "text/quote.h"
#include "text/utf8.h"

namespace cbc {
namespace {

constexpr std::string_view replacement_character = "\xEF\xBF\xBD";
constexpr std::string_view indentation = "  ";
constexpr std::string_view ellipsis = "...";

// Characters of a line that are shown, and how many of them come before the place.
constexpr std::size_t longest_line = 96;
constexpr std::size_t context_before = 48;

// One character of a line as it is printed.
struct Cell {
  std::string_view text;
  std::string_view blank;  // what takes the same columns in the line of the caret
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

// The line of a place and a caret below it, with a tail to the end of the range.
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

  std::string source(indentation);
  std::string blank(indentation);
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
