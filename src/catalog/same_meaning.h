#pragma once

#include "catalog/catalog.h"

namespace cbc {

/// Whether two catalogs say the same, wherever it stands in their files: the same tasks and
/// behaviors in the same order with the same attributes, requirements that ask for the same, and
/// lists that exclude the same. Lists count only for the pairs of tasks that they exclude; equal
/// entries of a parameter one after another count as one.
[[nodiscard]] bool same_meaning(const Catalog& a, const Catalog& b);

}  // namespace cbc
