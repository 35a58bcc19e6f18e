#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "diagnostic/diagnostic.h"

/// Mends texts by the edits of their findings, and shows what that changes.
namespace cbc {

struct FixedText {
  std::string text;
  /// Indices of the findings that are mended, ascending. The others have no edits, or edits that
  /// are not safe to apply or conflict with others.
  std::vector<std::size_t> mended;
};

/// Applies the edits of findings about a text: for each finding all of them, or none. Nothing else
/// is changed: comments, order, layout, line breaks, a byte order mark, and whether the last line
/// has a line break stay as they are. Findings in a removed entry are mended with it. Removals
/// come first; of edits that overlap otherwise those of the first finding count.
///
/// Mended text may have new findings with edits: repeat until nothing is mended. This ends, since
/// the text loses entries or older names each time.
[[nodiscard]] FixedText apply_fixes(std::string_view text, std::span<const Diagnostic> findings);

/// The difference of two texts in the unified format, with three lines of context, for `patch -p1`
/// and `git apply`; empty if there is none. `file` is the name in its head. The work is
/// bounded: where much has changed in one place the difference may not be the shortest.
[[nodiscard]] std::string unified_diff(std::string_view before, std::string_view after,
                                       std::string_view file);

}  // namespace cbc
