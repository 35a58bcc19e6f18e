// Random catalogs in which much is impossible: for the semantic rules of lint.
#pragma once

#include "model.h"
#include "random.h"

namespace cbc::oracle {

// Without cycles, and without errors but exclusive requirements. The groups are small: at most
// 1000 assignments and 60 constraints each. A behavior may require a task twice.
Catalog generate_strict_catalog(Random& random);

// Adds up to three situation variables, and conditions of behaviors on them.
void add_situation(Catalog& catalog, Random& random);

}  // namespace cbc::oracle
