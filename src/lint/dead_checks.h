#pragma once

#include "lint/semantics.h"

namespace cbc {

/// Reports tasks and behaviors that no assignment has, with a minimal set of constraints as the
/// reason; each fault where it is, and not again where it shows.
void check_dead(Semantics& semantics);

}  // namespace cbc
