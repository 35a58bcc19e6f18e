#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/yaml/document.h"

/// The text of a YAML document: its lines and comments, and where things begin and end in it.
namespace cbc::yaml {

/// A piece of a text in bytes; `end` is one past the last.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Whether a byte separates words: a blank or a line break.
[[nodiscard]] inline bool is_blank(char byte) {
  return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n';
}

/// Where the line of `offset` ends: at its line feed, or at the end of the text.
[[nodiscard]] inline std::size_t end_of_line(std::string_view text, std::size_t offset) {
  return std::min(text.find('\n', offset), text.size());
}

/// A text to be written into YAML: in quotes, so that it is not taken for another type, and with
/// escapes for what does not show.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A line of a YAML text. Offsets are in bytes of the text.
struct SourceLine {
  std::size_t begin = 0;
  std::size_t end = 0;                 ///< without the line break
  std::optional<std::size_t> comment;  ///< where the '#' of its comment stands
  bool has_content = false;            ///< besides the comment
  /// Of a line that begins an entry: what follows and is deeper belongs to this entry. An item of a
  /// list is deeper than a key at the same indentation, as a list may stand below its key.
  std::optional<std::size_t> depth;
};

/// The lines of a text without byte order mark. `document` is what was read from it, and tells
/// comments from texts with a '#'; if the text is not valid YAML, it is nullptr, and every '#' that
/// may begin a comment counts as one.
[[nodiscard]] std::vector<SourceLine> split_lines(std::string_view text, const Document* document);

// What the parser does not report: where things end, and where something is missing. All offsets
// are in bytes.

/// The content that begins at or after `offset`: blanks, line breaks and comments are skipped.
[[nodiscard]] std::size_t find_content(std::string_view text, std::size_t offset);

/// The same, past tags and anchors ("!!str &a text").
[[nodiscard]] std::size_t skip_properties(std::string_view text, std::size_t offset);

/// One past a null that is written out at `offset`; `offset` if there is none.
[[nodiscard]] std::size_t end_of_null(std::string_view text, std::size_t offset);

/// One past the alias ("*name") at `offset`.
[[nodiscard]] std::size_t end_of_alias(std::string_view text, std::size_t offset);

/// The first dash of a list at or after `offset` that is not in a comment.
[[nodiscard]] std::size_t find_dash(std::string_view text, std::size_t offset);

/// Whether the bracket or brace at `offset` is closed. Quotes and comments are understood as well
/// as it takes to explain an error.
[[nodiscard]] bool is_closed(std::string_view text, std::size_t offset);

/// The innermost bracket or brace from `begin` on that is open at `end`, understood as well.
[[nodiscard]] std::optional<std::size_t> find_open_bracket(std::string_view text, std::size_t begin,
                                                           std::size_t end);

/// The first tab that indents the line of `offset`, or `offset` if there is none before it.
[[nodiscard]] std::size_t find_indenting_tab(std::string_view text, std::size_t offset);

/// The first quote at or after `offset` that is not in a comment.
[[nodiscard]] std::size_t find_quote(std::string_view text, std::size_t offset);

/// The line of `offset`, or else the one with content above it, if it seems to lack the colon after
/// its key, or the space after the colon; without indentation, dash and comment. Empty if neither.
[[nodiscard]] std::string_view find_line_without_key(std::string_view text, std::size_t offset);

struct ScalarExtent {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool plain = false;  ///< neither in quotes nor a block
  bool closed = true;  ///< false if it lacks its closing quote
};

/// The extent of the scalar at `offset` with the given value, without its tags and anchors: to its
/// closing quote; of a block scalar its indicator; of a plain one that goes over several lines its
/// first line; of one that consists of a tag only, the tag.
[[nodiscard]] ScalarExtent extent_of_scalar(std::string_view text, std::size_t offset,
                                            std::string_view value);

}  // namespace cbc::yaml
