#pragma once

#include "catalog/catalog.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports what is odd about behaviors, each by itself.
void check_behaviors(const Catalog& catalog, bool is_complete, Reporter& reporter);

}  // namespace cbc
