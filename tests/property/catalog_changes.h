#pragma once

#include <string>

#include "model.h"
#include "random.h"

namespace cbc::plain {

/// The catalog in another form that means the same: no defaults, lists of exclusions as pairs or
/// repeated, and everything whose order means nothing in another order.
[[nodiscard]] oracle::Catalog rewrite(oracle::Catalog catalog, oracle::Random& random);

/// Changes one number, constraint or name. Returns what was changed; empty if the catalog has no
/// such thing. The result need not be a valid catalog.
[[nodiscard]] std::string change_one(oracle::Catalog& catalog, oracle::Random& random);

/// Of half of the catalogs many pairs get one number, which is the default.
void share_a_suitability(oracle::Catalog& catalog, oracle::Random& random);

/// Removes a task, what requires and excludes it, and the behaviors that perform nothing else.
/// False: it was the only one.
[[nodiscard]] bool remove_task(oracle::Catalog& catalog, oracle::Random& random);

}  // namespace cbc::plain
