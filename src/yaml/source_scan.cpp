#include "yaml/source_scan.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "text/lines.h"

namespace cbc::yaml {
namespace {

bool is_blank(char byte) { return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n'; }

bool is_blank_at(std::string_view text, std::size_t offset) {
  return offset >= text.size() || is_blank(text[offset]);
}

bool is_flow_indicator(char byte) {
  return byte == ',' || byte == '[' || byte == ']' || byte == '{' || byte == '}';
}

std::size_t begin_of_line(std::string_view text, std::size_t offset) {
  while (offset > 0 && text[offset - 1] != '\n') --offset;
  return offset;
}

// One past a word that ends at a blank, or in brackets at an indicator.
std::size_t end_of_word(std::string_view text, std::size_t offset) {
  while (!is_blank_at(text, offset) && !is_flow_indicator(text[offset])) ++offset;
  return offset;
}

// One past the closing quote, or nothing if there is none.
std::optional<std::size_t> end_of_quoted(std::string_view text, std::size_t offset) {
  const char mark = text[offset];
  for (++offset; offset < text.size(); ++offset) {
    if (text[offset] == '\\' && mark == '"') {
      ++offset;
    } else if (text[offset] == mark) {
      if (mark == '"' || offset + 1 == text.size() || text[offset + 1] != mark) return offset + 1;
      ++offset;
    }
  }
  return std::nullopt;
}

}  // namespace

std::size_t find_content(std::string_view text, std::size_t offset) {
  while (offset < text.size()) {
    if (text[offset] == '#' && (offset == 0 || is_blank(text[offset - 1]))) {
      offset = end_of_line(text, offset);
    } else if (is_blank(text[offset])) {
      ++offset;
    } else {
      break;
    }
  }
  return std::min(offset, text.size());
}

namespace {

// The line that begins at `begin`, without indentation and comment.
std::string_view content_of_line(std::string_view text, std::size_t begin) {
  std::string_view line = text.substr(begin, end_of_line(text, begin) - begin);
  line.remove_prefix(find_content(line, 0));
  line = line.substr(0, line.find(" #"));
  return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

bool has_key(std::string_view line) {
  return line.find(": ") != std::string_view::npos || line.ends_with(':');
}

}  // namespace

std::size_t skip_properties(std::string_view text, std::size_t offset) {
  while (offset < text.size() && (text[offset] == '!' || text[offset] == '&')) {
    // A verbatim tag, !<...>, may contain flow indicators.
    if (text.substr(offset, 2) == "!<") offset = std::min(text.find('>', offset), text.size());
    offset = find_content(text, end_of_word(text, offset));
  }
  return offset;
}

std::size_t end_of_null(std::string_view text, std::size_t offset) {
  for (const std::string_view null : {"~", "null", "Null", "NULL"}) {
    const std::size_t end = offset + null.size();
    if (text.substr(offset, null.size()) == null &&
        (is_blank_at(text, end) || is_flow_indicator(text[end]) || text[end] == ':')) {
      return end;
    }
  }
  return offset;
}

std::size_t end_of_alias(std::string_view text, std::size_t offset) {
  return end_of_word(text, offset);
}

std::size_t find_dash(std::string_view text, std::size_t offset) {
  while (offset < text.size()) {
    offset = find_content(text, offset);
    if (offset < text.size() && text[offset] == '-' && is_blank_at(text, offset + 1)) break;
    if (offset < text.size()) ++offset;
  }
  return offset;
}

std::size_t find_quote(std::string_view text, std::size_t offset) {
  offset = find_content(text, offset);
  while (offset < text.size() && text[offset] != '"' && text[offset] != '\'') {
    offset = find_content(text, offset + 1);
  }
  return offset;
}

bool is_closed(std::string_view text, std::size_t offset) {
  std::size_t open = 0;
  for (offset = find_content(text, offset); offset < text.size();
       offset = find_content(text, offset)) {
    const char byte = text[offset];
    const bool begins = offset == 0 || is_blank(text[offset - 1]) ||
                        is_flow_indicator(text[offset - 1]) || text[offset - 1] == ':';
    if ((byte == '"' || byte == '\'') && begins) {
      offset = end_of_quoted(text, offset).value_or(text.size());
      continue;
    }
    if (byte == '[' || byte == '{') ++open;
    if ((byte == ']' || byte == '}') && --open == 0) return true;
    ++offset;
  }
  return false;
}

std::size_t find_indenting_tab(std::string_view text, std::size_t offset) {
  offset = std::min(offset, text.size());
  const std::size_t begin = begin_of_line(text, offset);
  const std::string_view indentation =
      text.substr(begin, std::min(text.find_first_not_of(" \t", begin), offset) - begin);
  const std::size_t tab = indentation.find('\t');
  return tab == std::string_view::npos ? offset : begin + tab;
}

std::string_view find_line_without_key(std::string_view text, std::size_t offset) {
  std::size_t begin = begin_of_line(text, offset);
  std::string_view line = content_of_line(text, begin);
  if (has_key(line)) {
    const std::size_t column = find_content(text, begin) - begin;
    do {
      if (begin == 0) return {};
      begin = begin_of_line(text, begin - 1);
      line = content_of_line(text, begin);
    } while (line.empty());
    // An entry of a list is a mapping only if its next key is right below.
    const std::size_t next = begin + column;
    const std::size_t dash = find_content(text, begin);
    if (line.starts_with("- ") && find_content(text, dash + 1) == next)
      line.remove_prefix(next - dash);
  }
  if (line.empty() || has_key(line) ||
      std::string_view("-[{\"'").find(line[0]) != std::string_view::npos) {
    return {};
  }
  return line;
}

ScalarExtent extent_of_scalar(std::string_view text, std::size_t offset, std::string_view value) {
  const std::size_t begin = skip_properties(text, offset);
  const char first = begin < text.size() ? text[begin] : '\0';
  if (first == '"' || first == '\'') {
    const std::optional<std::size_t> end = end_of_quoted(text, begin);
    return {begin, end.value_or(begin + 1), false, end.has_value()};
  }
  if (first == '|' || first == '>') return {begin, begin + 1, false};
  if (value.empty()) return {offset, end_of_word(text, offset), true};
  if (text.substr(begin, value.size()) == value) return {begin, begin + value.size(), true};
  const std::string_view line = text.substr(begin, end_of_line(text, begin) - begin);
  return {begin, begin + line.find_last_not_of(" \t\r") + 1, true};
}

}  // namespace cbc::yaml
