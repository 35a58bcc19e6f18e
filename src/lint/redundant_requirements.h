#pragma once

#include "lint/semantics.h"

namespace cbc {

/// Reports requirements that are satisfied wherever the behavior and all other constraints are.
void check_redundant_requirements(Semantics& semantics);

}  // namespace cbc
