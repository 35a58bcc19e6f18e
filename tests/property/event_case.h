// The comparison of the implementation with the oracle, for one case.
#pragma once

#include <optional>
#include <string>

#include "generator.h"
#include "random.h"
#include "statistics.h"

namespace cbc::oracle {

// Where the events of the implementation are not those of the oracle, or a conflict that it reports
// is wrong, with the catalog and the script; nothing if all is well. `forms` chooses how they are
// written. Statistics may be null.
std::optional<std::string> find_fault(const Case& sample, Random& forms, Statistics* statistics);

}  // namespace cbc::oracle
