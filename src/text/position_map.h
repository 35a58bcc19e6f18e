#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"

namespace cbc {

/// Lines of a text, and the line and column of any byte of it in (nearly) constant time, however
/// long the lines are. Refers to the text, which must outlive it.
class PositionMap {
 public:
  explicit PositionMap(std::string_view text);

  /// The place of the character that begins at `offset`; offsets past the end count as the end.
  [[nodiscard]] Position at(std::size_t offset) const;

  /// The byte at which the character of a place begins. A place past the end of its line counts as
  /// the line break, one past the last line as the end of the text.
  [[nodiscard]] std::size_t offset(const Position& place) const;

  /// The text of a line, which counts from 1, without its line break; empty if there is none.
  [[nodiscard]] std::string_view line(std::uint32_t number) const;

  /// A piece of a line.
  struct Excerpt {
    std::string_view text;
    std::size_t characters_before = 0;  ///< of the line, left out
    bool is_cut_after = false;
  };
  /// The line of a place, at most about `radius` characters to either side of it, however long the
  /// line is.
  [[nodiscard]] Excerpt excerpt(const Position& place, std::size_t radius) const;

 private:
  [[nodiscard]] std::size_t characters_before(std::size_t offset) const;
  [[nodiscard]] std::size_t characters_between(std::size_t begin, std::size_t end) const;
  [[nodiscard]] std::size_t offset_of(std::size_t begin, std::size_t end,
                                      std::size_t characters) const;

  std::string_view text_;
  std::vector<std::size_t> line_starts_;
  // Characters that begin before every 256th byte; columns are differences of such counts.
  std::vector<std::size_t> checkpoints_;
};

}  // namespace cbc
