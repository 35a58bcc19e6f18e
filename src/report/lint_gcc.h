#pragma once

#include <string>
#include <vector>

#include "lint/linted_file.h"

namespace cbc {

/// What lint found, in the form of gcc, which editors understand, one place on a line:
///
///     a.yaml:3:9: error: task 'HOVER' is defined twice [duplicate-task]
///     a.yaml:1:9: note: first here
[[nodiscard]] std::string lint_gcc(const std::vector<LintedFile>& files);

}  // namespace cbc
