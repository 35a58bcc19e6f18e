#pragma once

#include "catalog/catalog.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports each set of tasks that require one another, by one shortest cycle.
void check_requirement_cycles(const Catalog& catalog, Reporter& reporter);

/// Reports each requirement of a task that excludes all the tasks of its behavior.
void check_exclusive_requirements(const Catalog& catalog, Reporter& reporter);

}  // namespace cbc
