#pragma once

#include <string>

#include "lint/linted_file.h"
#include "text/style.h"

namespace cbc {

/// A catalog in numbers, for a person: a table that begins with the name of the file. If the
/// catalog could not be understood, one line that says so.
[[nodiscard]] std::string lint_summary(const LintedFile& file, const Style& style);

}  // namespace cbc
