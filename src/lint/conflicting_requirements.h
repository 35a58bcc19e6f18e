#pragma once

#include <vector>

#include "catalog/catalog.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports behaviors that require two tasks which exclude one another. Returns, by behavior,
/// whether it can never be active because of that, or because it requires a task that excludes its
/// own (which has been reported).
[[nodiscard]] std::vector<bool> check_conflicting_requirements(const Catalog& catalog,
                                                               Reporter& reporter);

}  // namespace cbc
