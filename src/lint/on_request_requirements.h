#pragma once

#include "lint/semantics.h"

namespace cbc {

/// Reports requirements of tasks that start on request only, and what has to be requested first.
void check_on_request_requirements(Semantics& semantics);

}  // namespace cbc
