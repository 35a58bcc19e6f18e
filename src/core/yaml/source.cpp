#include "core/yaml/source.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/support/json.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::yaml {
namespace {

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

/// JSON writes what lies beyond U+FFFF and does not show as two escapes, which YAML does not take
/// for one character.
std::string in_quotes(std::string_view text) {
  std::string quoted = "\"";
  const auto add = [&quoted](std::string_view part) {
    std::string json;
    append_text(json, part);
    quoted.append(json, 1, json.size() - 2);
  };
  std::size_t begin = 0;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    if (decoded.character > 0xFFFF && is_control(decoded.character)) {
      add(text.substr(begin, offset - begin));
      quoted += fmt::format("\\U{:08x}", static_cast<std::uint32_t>(decoded.character));
      begin = offset + decoded.bytes;
    }
    offset += decoded.bytes;
  }
  add(text.substr(begin));
  return quoted + "\"";
}

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

namespace {

bool opens(char byte) { return byte == '[' || byte == '{'; }

/// The first bracket or brace at or after `offset`, or the end of the text.
std::size_t find_bracket(std::string_view text, std::size_t offset) {
  for (offset = find_content(text, offset); offset < text.size();
       offset = find_content(text, offset)) {
    const char byte = text[offset];
    const bool begins = offset == 0 || is_blank(text[offset - 1]) ||
                        is_flow_indicator(text[offset - 1]) || text[offset - 1] == ':';
    if ((byte == '"' || byte == '\'') && begins) {
      offset = end_of_quoted(text, offset).value_or(text.size());
      continue;
    }
    if (opens(byte) || byte == ']' || byte == '}') return offset;
    ++offset;
  }
  return text.size();
}

}  // namespace

bool is_closed(std::string_view text, std::size_t offset) {
  std::size_t open = 0;
  for (offset = find_bracket(text, offset); offset < text.size();
       offset = find_bracket(text, offset + 1)) {
    if (opens(text[offset])) {
      ++open;
    } else if (--open == 0) {
      return true;
    }
  }
  return false;
}

std::optional<std::size_t> find_open_bracket(std::string_view text, std::size_t begin,
                                             std::size_t end) {
  std::vector<std::size_t> open;
  for (std::size_t offset = find_bracket(text, begin); offset < end;
       offset = find_bracket(text, offset + 1)) {
    if (opens(text[offset])) {
      open.push_back(offset);
    } else if (!open.empty()) {
      open.pop_back();
    }
  }
  return open.empty() ? std::nullopt : std::optional(open.back());
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

namespace {

constexpr std::string_view blanks = " \t";

std::size_t count_leading_spaces(std::string_view text) {
  return std::min(text.find_first_not_of(' '), text.size());
}

/// The lines of a block scalar, from the end of the line with its indicator. Their indentation is
/// that of the first one that is not blank, less the blanks with which `value` begins that line.
Span find_block_text(std::string_view text, std::size_t indicator, std::string_view value) {
  const std::size_t begin = end_of_line(text, indicator);
  const std::size_t first = value.find_first_not_of(" \n");
  const std::size_t content = text.find_first_not_of(" \r\n", begin);
  if (first == std::string_view::npos || content == std::string_view::npos) return {begin, begin};

  const std::size_t more = first - (value.rfind('\n', first) + 1);
  const std::size_t column = content - (text.rfind('\n', content) + 1);
  const std::size_t indentation = column - std::min(more, column);
  std::size_t end = end_of_line(text, content);
  while (end < text.size()) {
    const std::size_t next_end = end_of_line(text, end + 1);
    const std::string_view line = text.substr(end + 1, next_end - end - 1);
    const bool is_blank = line.find_first_not_of(" \r") == std::string_view::npos;
    if (!is_blank && count_leading_spaces(line) < indentation) break;
    end = next_end;
  }
  return {begin, end};
}

/// The scalars that may contain a '#' that begins no comment, in order.
std::vector<Span> find_scalars(std::string_view text, const Document& document) {
  std::vector<Span> scalars;
  const PositionMap positions(text);
  for (const Node& node : document.nodes()) {
    if (node.kind != Kind::scalar) continue;
    const std::size_t begin = positions.offset(node.range.begin);
    const char first = begin < text.size() ? text[begin] : '\0';
    if (first == '"' || first == '\'') {
      scalars.push_back({begin, positions.offset(node.range.end)});
    } else if (first == '|' || first == '>') {
      scalars.push_back(find_block_text(text, begin, node.text));
    }
  }
  return scalars;
}

/// Tells what lies within scalars. Offsets must be asked for in order.
class ScalarFilter {
 public:
  explicit ScalarFilter(std::vector<Span> scalars) : scalars_(std::move(scalars)) {}

  /// Whether a character is part of a scalar.
  bool contains(std::size_t offset) {
    skip_before(offset);
    return next_ < scalars_.size() && scalars_[next_].begin <= offset;
  }

  /// Whether a scalar goes on at an offset.
  bool continues_at(std::size_t offset) {
    skip_before(offset);
    return next_ < scalars_.size() && scalars_[next_].begin < offset;
  }

 private:
  void skip_before(std::size_t offset) {
    while (next_ < scalars_.size() && scalars_[next_].end <= offset) ++next_;
  }

  std::vector<Span> scalars_;
  std::size_t next_ = 0;
};

/// Where the comment of a line begins.
std::optional<std::size_t> find_comment(std::string_view text, const Span& line,
                                        ScalarFilter& scalars) {
  const std::string_view content = text.substr(line.begin, line.end - line.begin);
  for (std::size_t at = content.find('#'); at != std::string_view::npos;
       at = content.find('#', at + 1)) {
    const bool may_begin = at == 0 || blanks.find(content[at - 1]) != std::string_view::npos;
    if (may_begin && !scalars.contains(line.begin + at)) return line.begin + at;
  }
  return std::nullopt;
}

/// The depth of a line that begins with `content`. The mark before a document is no entry.
std::optional<std::size_t> depth_of(std::string_view content) {
  if (content.substr(0, 3) == "---" &&
      content.find_first_not_of(blanks, 3) == std::string_view::npos) {
    return std::nullopt;
  }
  const std::size_t indentation = count_leading_spaces(content);
  content.remove_prefix(indentation);
  const bool is_item = content.substr(0, 1) == "-" &&
                       (content.size() == 1 || blanks.find(content[1]) != std::string_view::npos);
  return 2 * indentation + (is_item ? 1 : 0);
}

}  // namespace

std::vector<SourceLine> split_lines(std::string_view text, const Document* document) {
  ScalarFilter scalars(document == nullptr ? std::vector<Span>{} : find_scalars(text, *document));
  std::vector<SourceLine> lines;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t line_break = end_of_line(text, begin);
    SourceLine line;
    line.begin = begin;
    line.end = line_break > begin && text[line_break - 1] == '\r' ? line_break - 1 : line_break;
    const bool continues = scalars.continues_at(begin);
    line.comment = find_comment(text, {line.begin, line.end}, scalars);
    const std::string_view content = text.substr(begin, line.comment.value_or(line.end) - begin);
    line.has_content = continues || content.find_first_not_of(blanks) != std::string_view::npos;
    if (line.has_content && !continues) line.depth = depth_of(content);
    lines.push_back(line);
    begin = line_break + 1;
  }
  return lines;
}

}  // namespace cbc::yaml
