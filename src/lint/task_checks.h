#pragma once

#include "catalog/catalog.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports what is odd about tasks and their parameters, each by itself. `is_complete`: whether the
/// catalog was understood as a whole, so that what is missing in it is missing in the file.
void check_tasks(const Catalog& catalog, bool is_complete, Reporter& reporter);

}  // namespace cbc
