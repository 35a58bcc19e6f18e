#pragma once

#include "catalog/catalog.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Reports exclusivity lists that exclude nothing, or nothing new.
void check_exclusivity(const Catalog& catalog, Reporter& reporter);

}  // namespace cbc
