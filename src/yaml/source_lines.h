#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "yaml/document.h"

namespace cbc::yaml {

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
/// comments from texts with a '#'; if the text is no valid YAML it is nullptr, and every '#' that
/// may begin a comment does.
[[nodiscard]] std::vector<SourceLine> split_lines(std::string_view text, const Document* document);

}  // namespace cbc::yaml
