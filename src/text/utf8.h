#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

/// UTF-8. "Character" means code point; every byte that is not part of a valid sequence counts as
/// one character, so that places in a damaged text are defined too.
namespace cbc::utf8 {

/// Stands for a byte that is not part of a valid sequence.
inline constexpr char32_t replacement = 0xFFFD;

/// May stand before a text, and is no part of it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
[[nodiscard]] std::string_view without_byte_order_mark(std::string_view text);

struct Decoded {
  char32_t character = replacement;
  std::size_t bytes = 1;
  bool valid = false;
};

/// The character that begins at `text[offset]`; `offset` lies within the text.
[[nodiscard]] Decoded decode(std::string_view text, std::size_t offset);

/// Offset of the first byte that makes `text` invalid, or nothing.
[[nodiscard]] std::optional<std::size_t> find_invalid(std::string_view text);

[[nodiscard]] std::size_t count_characters(std::string_view text);

/// Columns that a character takes on a terminal: 0, 1 or 2.
[[nodiscard]] std::size_t display_width(char32_t character);

}  // namespace cbc::utf8
