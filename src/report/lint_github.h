#pragma once

#include <string>
#include <vector>

#include "lint/linted_file.h"

namespace cbc {

/// A finding as a workflow command of GitHub Actions.
[[nodiscard]] std::string github_command_of(const Diagnostic& finding);

/// What lint found, as workflow commands of GitHub Actions: each becomes an annotation of the line
/// it is about. Places that belong to a finding are further lines of its message.
[[nodiscard]] std::string lint_github(const std::vector<LintedFile>& files);

}  // namespace cbc
