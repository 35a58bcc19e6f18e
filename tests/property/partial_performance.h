#pragma once

#include <cstddef>

#include "enumeration.h"

namespace cbc::oracle {

// Whether Performance(task) is `minimum` at least, where a required task that does not run counts
// for nothing.
[[nodiscard]] bool reaches_with_what_runs(const CatalogFacts& facts, const Assignment& values,
                                          std::size_t task, Millionths minimum);

}  // namespace cbc::oracle
