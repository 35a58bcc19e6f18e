#include "core/words/layout.h"

#include <algorithm>
#include <set>

#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::size_t longest_name = 28;
/// With less room, breaks would only make the text harder to read.
constexpr std::size_t least_room = 20;

}  // namespace

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    if (text[offset] == '\x1b') {
      offset = std::min(text.find('m', offset), text.size() - 1) + 1;
      continue;
    }
    const utf8::Decoded decoded = utf8::decode(text, offset);
    width += utf8::display_width(decoded.character);
    offset += decoded.bytes;
  }
  return width;
}

std::string shorten(const std::string& name, std::size_t columns) {
  std::size_t rest = width_of(name);  // from `offset` on
  if (rest <= columns) return name;
  constexpr std::string_view dots = "...";
  const std::size_t kept = columns - dots.size();
  std::size_t offset = 0;
  const auto width_of_next = [&] {
    return utf8::display_width(utf8::decode(name, offset).character);
  };
  const auto skip = [&] {
    rest -= width_of_next();
    offset += utf8::decode(name, offset).bytes;
  };
  const std::size_t width = rest;
  std::size_t begin = 0;
  while (width - rest <= kept / 2) {
    begin = offset;
    skip();
  }
  while (rest > kept - kept / 2) skip();
  while (width_of_next() == 0) skip();  // would combine with the dots
  return concat(std::string_view(name).substr(0, begin), dots,
                std::string_view(name).substr(offset));
}

std::vector<std::string> shorten(std::vector<std::string> names) {
  std::size_t widest = 0;
  for (const std::string& name : names) widest = std::max(widest, width_of(name));
  const std::size_t different = std::set<std::string>(names.begin(), names.end()).size();
  for (std::size_t columns = longest_name; columns < widest; columns *= 2) {
    std::vector<std::string> shortened;
    shortened.reserve(names.size());
    for (const std::string& name : names) shortened.push_back(shorten(name, columns));
    if (std::set<std::string>(shortened.begin(), shortened.end()).size() == different) {
      return shortened;
    }
  }
  return names;
}

namespace {

/// Whether two words must not be torn apart: a number and its unit.
bool belong_together(std::string_view word, std::string_view next) {
  if (word.empty() || word.back() < '0' || word.back() > '9') return false;
  const std::string_view unit = next.substr(0, next.find_first_of(",.;:)"));
  return unit == "%" || unit == "s";
}

/// Where the word at `begin` ends, with the unit that follows it.
std::size_t end_of_word(std::string_view line, std::size_t begin, Breaks breaks) {
  if (breaks == Breaks::after_commas) {
    const std::size_t comma = line.find(", ", begin);
    return comma == std::string_view::npos ? line.size() : comma + 1;
  }
  const std::size_t end = std::min(line.find(' ', begin), line.size());
  if (end == line.size()) return end;
  const std::size_t end_of_next = std::min(line.find(' ', end + 1), line.size());
  return belong_together(line.substr(begin, end - begin),
                         line.substr(end + 1, end_of_next - end - 1))
             ? end_of_next
             : end;
}

}  // namespace

std::string wrap_line(std::string_view line, std::size_t columns, std::size_t indent,
                      Breaks breaks) {
  if (columns < indent + least_room || width_of(line) <= columns) return std::string(line);
  std::string text;
  std::size_t width = 0;
  bool has_word = false;  // on the present line
  while (!line.empty()) {
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t end = end_of_word(line, blanks, breaks);
    const std::string_view word = line.substr(blanks, end - blanks);
    const std::size_t word_width = width_of(word);
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

std::string_view without_indentation(std::string_view line) {
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

}  // namespace cbc
