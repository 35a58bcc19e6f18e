#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// The one place where positions of the protocol and offsets in a text meet.

namespace cbc::lsp {

/// What a character of a position counts: code units of UTF-16, or bytes.
enum class Encoding : std::uint8_t { utf16, utf8 };

/// A place as the protocol has it; lines and characters count from 0.
struct Place {
  std::uint32_t line = 0;
  std::uint32_t character = 0;
};

struct PlaceRange {
  Place begin;
  Place end;
};

/// A text that knows its lines. Line breaks are LF, CR LF and CR, as the protocol says.
class Text {
 public:
  Text(std::string content, Encoding encoding);
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  [[nodiscard]] const std::string& content() const { return content_; }

  /// What lies behind the end of a line counts as the end of it, and behind the last line as the
  /// end of the text.
  [[nodiscard]] std::size_t offset_of(const Place& place) const;
  /// Of an offset inside of a character: its begin.
  [[nodiscard]] Place place_of(std::size_t offset) const;

  /// Of a finding, which counts characters, and not a byte order mark.
  [[nodiscard]] std::size_t offset_of(const Position& position) const;
  [[nodiscard]] PlaceRange range_of(const Range& range) const;

 private:
  /// A character in a long line, where counting can begin.
  struct Mark {
    std::size_t offset = 0;
    std::size_t units = 0;  ///< of UTF-16, from the begin of the line
  };

  [[nodiscard]] std::size_t end_of_line(std::size_t line) const;
  [[nodiscard]] std::vector<Mark> marks_of_lines() const;
  template <typename IsBehind>
  [[nodiscard]] Mark last_mark(std::size_t line, const IsBehind& is_behind) const;

  std::string content_;
  Encoding encoding_;
  std::vector<std::size_t> lines_;  ///< where each begins
  std::vector<Mark> marks_;         ///< in the order of the text
  PositionMap positions_;           ///< as findings count them
};

/// A piece of a text, in bytes, and what comes in its place.
struct TextChange {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// Few and small changes that make one text another one: line by line, where both have as many.
[[nodiscard]] std::vector<TextChange> changes_between(std::string_view before,
                                                      std::string_view after);

}  // namespace cbc::lsp
