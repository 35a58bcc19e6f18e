#pragma once

#include "catalog/reader.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports what is odd about tasks and their parameters, each by itself.
void check_tasks(const CatalogReading& reading, Reporter& reporter);

}  // namespace cbc
