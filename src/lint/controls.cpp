#include "lint/controls.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "cbc/rules.h"

namespace cbc {

std::vector<Diagnostic> control_findings(std::vector<Diagnostic> findings, CommentedFile file,
                                         const SeveritySettings& settings) {
  // Past the node limit the finding that a comment is for may just not have been found.
  file.is_complete = file.is_complete &&
                     std::none_of(findings.begin(), findings.end(), [](const Diagnostic& finding) {
                       return finding.rule == rule::undecided;
                     });
  std::vector<Diagnostic> reported;
  for (Diagnostic& finding : apply_allow_comments(std::move(findings), file)) {
    const std::optional<Severity> severity = settings.severity_of(finding);
    if (!severity) continue;
    finding.severity = *severity;
    reported.push_back(std::move(finding));
  }
  return reported;
}

}  // namespace cbc
