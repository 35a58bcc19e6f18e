#pragma once

#include "lint/semantics.h"

namespace cbc {

/// Reports minimum performances that no choice of behaviors reaches, with the best that is reached.
void check_minimum_performances(Semantics& semantics);

}  // namespace cbc
