#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cbc/diagnostic.h"
#include "lint/summary.h"

namespace cbc {

/// What lint has to say about one file.
struct LintedFile {
  std::string file;                  ///< name in messages
  std::string text;                  ///< as it was read
  std::vector<Diagnostic> findings;  ///< in the order of Diagnostics::sort
  std::optional<Summary> summary;    ///< of a catalog that was understood
  bool is_script = false;            ///< an event script, which has no summary
};

/// Number of findings of a severity in a file, in all files.
[[nodiscard]] std::size_t count(const LintedFile& file, Severity severity);
[[nodiscard]] std::size_t count(const std::vector<LintedFile>& files, Severity severity);

}  // namespace cbc
