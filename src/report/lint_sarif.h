#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lint/linted_file.h"

namespace cbc {

/// What lint found, as a log of SARIF 2.1.0. `working_directory` is the absolute path that relative
/// names of files start from. Files below it have URIs relative to it, others absolute ones.
///
/// `is_complete`: whether all files could be read.
///
/// Each finding has a fingerprint that stays the same when it moves to another line.
[[nodiscard]] std::string lint_sarif(const std::vector<LintedFile>& files,
                                     std::string_view working_directory, bool is_complete);

}  // namespace cbc
