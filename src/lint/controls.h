#pragma once

#include <vector>

#include "cbc/diagnostic.h"
#include "lint/allow_comments.h"
#include "lint/severity_settings.h"

namespace cbc {

/// What is to be reported of the findings of one file, in the order of Diagnostics::sort: its
/// comments are applied first, then the settings, to the findings about comments, too.
[[nodiscard]] std::vector<Diagnostic> control_findings(std::vector<Diagnostic> findings,
                                                       CommentedFile file,
                                                       const SeveritySettings& settings);

}  // namespace cbc
