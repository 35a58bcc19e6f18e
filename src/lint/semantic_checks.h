#pragma once

#include "catalog/catalog.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "lint/lint.h"

namespace cbc {

/// Reports what the constraints of a catalog make impossible, or say in vain: exactly, by search.
/// The catalog was understood as a whole, and its requirements have no cycle.
void check_semantics(const Catalog& catalog, const CompiledCatalog& compiled,
                     const LintOptions& options, Reporter& reporter);

}  // namespace cbc
