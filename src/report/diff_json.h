#pragma once

#include <string>
#include <string_view>

#include "diff/catalog_diff.h"

namespace cbc {

/// The differences as JSON, schema cbc.diff/1: `old` and `new` name the catalogs; `changes` has an
/// object for each difference, with `kind` (removed, added, changed), `subject` (task, behavior,
/// performs, requirement, exclusion), the names in question (`task`, `behavior`, `other_task`) and
/// `attributes`, each with `name`, `before` and `after`: suitability and minimum_performance in
/// percent, timeout in seconds, null where nothing is set. `further_exclusions` counts those that
/// are not listed.
[[nodiscard]] std::string diff_json(const CatalogDiff& diff, std::string_view before,
                                    std::string_view after);

}  // namespace cbc
