#pragma once

#include <vector>

#include "lint/semantics.h"

namespace cbc {

/// Reports requirements of tasks that start on request only, and what has to be requested first.
void check_on_request_requirements(Semantics& semantics);

/// The same for a catalog that was not understood as a whole: only the required task itself is
/// known to be requested first. `conflicts`: by behavior, whether it can never be active.
void check_on_request_requirements(const Catalog& catalog, const std::vector<bool>& conflicts,
                                   Reporter& reporter);

}  // namespace cbc
