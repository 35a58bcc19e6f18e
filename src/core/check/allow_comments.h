#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

/// What people say about single findings: comments that allow them, beside what they are about.
namespace cbc {

/// A file with comments that control its findings.
struct CommentedFile {
  std::string file;                          ///< name in messages
  std::string_view text;                     ///< as it was read
  const yaml::Document* document = nullptr;  ///< of the text, if it is valid YAML
  /// Whether every rule could be decided. If not, an allow without a finding may still be needed.
  bool is_complete = true;
};

/// Removes the findings of a file that comments of the file allow:
///
///     # cbc: allow required-goal, dead-task -- the reason, for people
///     - task: A
///       timeout: 5   # cbc: allow no-timeout-effect
///
/// At the end of a line, a comment is about what begins on this line; on a line of its own, it is
/// about the entry that follows, with everything in it. If several comments allow a finding, the
/// innermost of them, or else the last, counts as used.
///
/// Adds findings about the comments: unknown-rule for what is not understood, and unused-allow for
/// an allow that no finding needs, or of a fixed rule. No comment allows these.
///
/// The result is in the order of Diagnostics::sort.
[[nodiscard]] std::vector<Diagnostic> apply_allow_comments(std::vector<Diagnostic> findings,
                                                           const CommentedFile& file);

/// What is to be reported of the findings of one file, in the order of Diagnostics::sort. Comments
/// are applied first, then the settings, also to the findings about comments.
[[nodiscard]] std::vector<Diagnostic> control_findings(std::vector<Diagnostic> findings,
                                                       CommentedFile file,
                                                       const SeveritySettings& settings);

}  // namespace cbc
