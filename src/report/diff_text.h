#pragma once

#include <string>

#include "diff/catalog_diff.h"
#include "text/style.h"

namespace cbc {

/// The differences for a person to read, a line for each: `-` removed, `+` added, `~` changed.
/// Empty if there are none.
[[nodiscard]] std::string diff_text(const CatalogDiff& diff, const Style& style);

}  // namespace cbc
