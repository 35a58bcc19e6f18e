#pragma once

#include <vector>

#include "catalog/reader.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/reporter.h"
#include "lint/lint.h"

namespace cbc {

/// Reports what the constraints of a catalog make impossible, or say in vain: exactly, by search.
/// All names of the catalog were understood, and its requirements have no cycle.
/// `conflicts`: of check_conflicting_requirements.
void check_semantics(const CatalogReading& reading, const CompiledCatalog& compiled,
                     const std::vector<bool>& conflicts, const LintOptions& options,
                     Reporter& reporter);

}  // namespace cbc
