#include "lint/linted_file.h"

#include <algorithm>

namespace cbc {

std::size_t count(const LintedFile& file, Severity severity) {
  return static_cast<std::size_t>(std::count_if(
      file.findings.begin(), file.findings.end(),
      [severity](const Diagnostic& finding) { return finding.severity == severity; }));
}

std::size_t count(const std::vector<LintedFile>& files, Severity severity) {
  std::size_t sum = 0;
  for (const LintedFile& file : files) sum += count(file, severity);
  return sum;
}

}  // namespace cbc
