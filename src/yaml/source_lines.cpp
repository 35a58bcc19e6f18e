#include "yaml/source_lines.h"

#include <algorithm>
#include <utility>

#include "text/lines.h"

namespace cbc::yaml {
namespace {

constexpr std::string_view blanks = " \t";

/// A stretch of text in bytes.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::size_t count_leading_spaces(std::string_view text) {
  return std::min(text.find_first_not_of(' '), text.size());
}

/// Finds the offsets of places that are asked for in the order of the text.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  std::size_t advance_to(const Position& place) {
    while (at_.line < place.line && offset_ < text_.size()) {
      offset_ = std::min(end_of_line(text_, offset_) + 1, text_.size());
      at_ = {at_.line + 1, 1};
    }
    while (at_ < place && offset_ < text_.size()) {
      do {
        ++offset_;
      } while (offset_ < text_.size() && is_continuation(text_[offset_]));
      ++at_.column;
    }
    return offset_;
  }

 private:
  static bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
  }

  std::string_view text_;
  std::size_t offset_ = 0;
  Position at_;
};

/// The lines of a block scalar, from the end of the line with its indicator. How far they are
/// indented is seen from the first one that is not blank: `value` has what it is indented more.
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

/// The scalars that may have a '#' which begins no comment, in order.
std::vector<Span> find_scalars(std::string_view text, const Document& document) {
  std::vector<Span> scalars;
  Cursor cursor(text);
  for (const auto& node : document.nodes()) {
    if (node->kind != Kind::scalar) continue;
    const std::size_t begin = cursor.advance_to(node->range.begin);
    const char first = begin < text.size() ? text[begin] : '\0';
    if (first == '"' || first == '\'') {
      scalars.push_back({begin, cursor.advance_to(node->range.end)});
    } else if (first == '|' || first == '>') {
      scalars.push_back(find_block_text(text, begin, node->text));
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

/// Of a line that begins with `content`. The mark before a document is no entry.
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
