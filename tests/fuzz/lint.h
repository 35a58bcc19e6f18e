// Lints texts as `cbc lint --fix` does.
#pragma once

#include <memory>
#include <string>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::fuzz {

struct LintedCatalog {
  LintedFile file;
  Catalog catalog;
  std::shared_ptr<const CompiledCatalog> compiled;
  std::size_t errors = 0;
};
[[nodiscard]] LintedCatalog lint(std::string text, const SeveritySettings& settings);

/// Writes the findings in one of the formats: all of them for each input would be slow.
void report(const LintedFile& file);

/// Applies all fixes, which must end, keep the meaning, and add no errors.
void fix(const LintedCatalog& linted, const SeveritySettings& settings);

}  // namespace cbc::fuzz
