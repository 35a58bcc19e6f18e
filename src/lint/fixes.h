#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"

namespace cbc {

struct FixedText {
  std::string text;
  /// Places in the findings given, ascending, of those that are mended. The others have no edits,
  /// or it is not safe to apply them, or they are in the way of one another.
  std::vector<std::size_t> mended;
};

/// Applies the edits of findings about a text: for each finding all of them, or none. Nothing else
/// is changed: comments, order, layout, line breaks, a byte order mark, and whether the last line
/// has a line break stay as they are. What stands in a removed entry is mended with it. Removals
/// come first; of edits that overlap otherwise those of the first finding count.
///
/// Mended text may have new findings with edits: repeat it until nothing is mended. It ends, as
/// each time the text has fewer entries or fewer older names.
[[nodiscard]] FixedText apply_fixes(std::string_view text, std::span<const Diagnostic> findings);

}  // namespace cbc
