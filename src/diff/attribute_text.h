#pragma once

#include <string>

#include "diff/catalog_diff.h"

namespace cbc {

/// What a difference says of an attribute: "timeout 5 s -> 10 s" if it has changed, "timeout 5 s"
/// if one catalog alone has it.
[[nodiscard]] std::string describe(const CatalogChange& change, const AttributeChange& attribute);

}  // namespace cbc
