#pragma once

#include <cstdint>
#include <optional>

#include "catalog/reader.h"
#include "cbc/diagnostic.h"
#include "compiled/compiled_catalog.h"
#include "yaml/document.h"

namespace cbc {

struct LintOptions {
  /// Decisions that the search for one answer may take; past them there is a note `undecided`.
  std::uint64_t max_nodes = 100'000;
};

/// What lint found out about a catalog, beside its findings.
struct LintResult {
  CatalogReading reading;
  std::optional<CompiledCatalog> compiled;  ///< if it was understood as a whole
};

/// Reports everything that is wrong with a catalog, of all rules, into `diagnostics`.
[[nodiscard]] LintResult lint_catalog(const yaml::Document& document, const LintOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace cbc
