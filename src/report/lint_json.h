#pragma once

#include <string>
#include <vector>

#include "lint/linted_file.h"

namespace cbc {

/// What lint found, as JSON of the schema cbc.lint/1, one finding on a line. A name that is no
/// valid UTF-8 has replacement characters for what is wrong with it.
[[nodiscard]] std::string lint_json(const std::vector<LintedFile>& files);

}  // namespace cbc
