#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "coverage/engine/coverage.h"

namespace cbc {

/// The missed goals to begin with, at most `count`, the most important first: constraints that no
/// mission shows to matter, then what goes wrong, then priorities and the queue, then the rest; in
/// each the goals that guard the most tasks, those that may stop if the goal's task does. At most
/// three are of the same kind, as long as there are others.
[[nodiscard]] std::vector<std::uint32_t> first_goals(const CatalogCoverage& coverage,
                                                     std::size_t count);

}  // namespace cbc
