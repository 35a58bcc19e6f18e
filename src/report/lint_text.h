#pragma once

#include <string>
#include <vector>

#include "lint/linted_file.h"
#include "text/style.h"

namespace cbc {

/// What lint found, for a person. Findings of a file that say the same are shown once, with the
/// lines of the others:
///
///     a.yaml:3:3: warning: 'efficacy' is an older name of 'suitability' [deprecated-key]
///       efficacy: 90
///       ^~~~~~~~
///       and 2 more like this, on lines 9, 15
///     3 warnings in 1 file
[[nodiscard]] std::string lint_text(const std::vector<LintedFile>& files, const Style& style);

}  // namespace cbc
