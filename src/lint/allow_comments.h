#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cbc/diagnostic.h"
#include "yaml/document.h"

namespace cbc {

/// A file with comments that control its findings.
struct CommentedFile {
  std::string file;                          ///< name in messages
  std::string_view text;                     ///< as it was read
  const yaml::Document* document = nullptr;  ///< of the text, if it is valid YAML
  /// Whether every rule could be decided. If not, an allow without a finding may be needed yet.
  bool is_complete = true;
};

/// Removes the findings of a file that comments of the file allow:
///
///     # cbc: allow required-goal, dead-task -- the reason, as far as anybody cares
///     - task: A
///       timeout: 5   # cbc: allow no-timeout-effect
///
/// At the end of a line a comment is about what begins on this line; on a line of its own it is
/// about the entry that follows, with all that is in it. If several comments allow a finding, the
/// innermost, or else the last one, is the one that is used.
///
/// Adds findings about the comments: of unknown-rule for what is not understood, and of
/// unused-allow for an allow that nothing needs, or that is of a fixed rule. Such findings can be
/// allowed, too; but not that an allow of unused-allow is itself unused.
///
/// The result is in the order of Diagnostics::sort.
[[nodiscard]] std::vector<Diagnostic> apply_allow_comments(std::vector<Diagnostic> findings,
                                                           const CommentedFile& file);

}  // namespace cbc
