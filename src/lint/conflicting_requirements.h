#pragma once

#include "lint/semantics.h"

namespace cbc {

/// Reports behaviors that require two tasks which exclude one another. What requires a task that
/// excludes its own has been reported, and is marked as explained.
void check_conflicting_requirements(Semantics& semantics);

}  // namespace cbc
