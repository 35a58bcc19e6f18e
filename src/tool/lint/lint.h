#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "catalog/reader.h"
#include "compile/numbers.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/diagnostic.h"
#include "yaml/document.h"

/// Checks catalogs by all rules.
namespace cbc {

struct LintOptions {
  /// Decisions that the search for one answer may take; past them there is a finding `undecided`.
  std::uint64_t max_nodes = 100'000;
};

/// What lint knows about a catalog, besides its findings.
struct LintResult {
  CatalogReading reading;
  std::optional<CompiledCatalog> compiled;  ///< if all of it was understood
};

/// Reports everything that is wrong with a catalog, by all rules, into `diagnostics`.
[[nodiscard]] LintResult lint_catalog(const yaml::Document& document, const LintOptions& options,
                                      Diagnostics& diagnostics);

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
