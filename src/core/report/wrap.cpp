#include "core/report/wrap.h"

#include <algorithm>

#include "core/report/table_parts.h"

namespace cbc {
namespace {

/// With less room, breaks would only make the text harder to read.
constexpr std::size_t least_room = 20;

/// The columns that a text with escape sequences takes.
std::size_t visible_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    const std::size_t escape = std::min(text.find('\x1b'), text.size());
    width += width_of(text.substr(0, escape));
    text.remove_prefix(escape);
    if (!text.empty()) text.remove_prefix(std::min(text.find('m'), text.size() - 1) + 1);
  }
  return width;
}

/// Whether two words must not be torn apart: a number and its unit.
bool belong_together(std::string_view word, std::string_view next) {
  if (word.empty() || word.back() < '0' || word.back() > '9') return false;
  const std::string_view unit = next.substr(0, next.find_first_of(",.;:)"));
  return unit == "%" || unit == "s";
}

/// Where the word at `begin` ends, with the unit that follows it.
std::size_t end_of_word(std::string_view line, std::size_t begin) {
  const std::size_t end = std::min(line.find(' ', begin), line.size());
  if (end == line.size()) return end;
  const std::size_t end_of_next = std::min(line.find(' ', end + 1), line.size());
  return belong_together(line.substr(begin, end - begin),
                         line.substr(end + 1, end_of_next - end - 1))
             ? end_of_next
             : end;
}

}  // namespace

std::string wrap_line(std::string_view line, std::size_t columns, std::size_t indent) {
  if (columns < indent + least_room || visible_width(line) <= columns) return std::string(line);
  std::string text;
  std::size_t width = 0;
  bool has_word = false;  // on the present line
  while (!line.empty()) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t end = end_of_word(line, blanks);
    const std::string_view word = line.substr(blanks, end - blanks);
    const std::size_t word_width = visible_width(word);
    if (has_word && width + blanks + word_width > columns) {
      text += "\n" + std::string(indent, ' ');
      width = indent;
    } else {
      text.append(blanks, ' ');
      width += blanks;
    }
    text += word;
    width += word_width;
    has_word = true;
    line.remove_prefix(end);
  }
  return text;
}

std::string indent(std::string_view lines) {
  std::string text;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    text += "    ";
    text += lines.substr(begin, end - begin);
    text += '\n';
    begin = end + 1;
  }
  return text;
}

}  // namespace cbc
