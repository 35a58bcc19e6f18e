#pragma once

#include <vector>

#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "core/files/file_set.h"
#include "runtime/compiled/compiled_catalog.h"

// What `cbc lint` finds in one file that was read, under the control of its comments and of the
// settings that apply to it. Whoever has several files brings them together.

namespace cbc::cli {

/// Checks a catalog; or a text that is not valid YAML, whatever it may have been.
[[nodiscard]] CheckedCatalog check_catalog_file(const InputFile& file,
                                                const SeveritySettings& settings,
                                                const LintOptions& options);

/// Checks a script or a property file, which is valid YAML. `names`, if not null, takes where names
/// of the catalog stand.
[[nodiscard]] std::vector<Diagnostic> check_about_catalog(const InputFile& file,
                                                          const CompiledCatalog& catalog,
                                                          const SeveritySettings& settings,
                                                          std::vector<NamePlace>* names = nullptr);

}  // namespace cbc::cli
