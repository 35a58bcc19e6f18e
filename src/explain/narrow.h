#pragma once

#include "compiled/compiled_catalog.h"
#include "explain/demand.h"
#include "solver/problem.h"

namespace cbc {

/// Takes out of the domains of a problem what a demand on a task of its group rules out.
void narrow(const CompiledCatalog& catalog, const Demand& demand, Problem& problem);

/// Whether a task of the group can have more than one value.
[[nodiscard]] bool is_open(const CompiledCatalog& catalog, const Problem& problem, TaskId task);

}  // namespace cbc
