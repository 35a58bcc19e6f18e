#pragma once

#include <cstdint>
#include <vector>

#include "core/property/properties.h"
#include "explore/properties/explore.h"
#include "plain_model.h"
#include "runtime/compiled/compiled_catalog.h"

// What explore() is held against: a search without any means but a set of states.

namespace cbc::plain {

/// Visits every state of the groups, breadth first, the moves of each in the order in which scripts
/// are compared; so the first path to a state is the one that counts. After more than `max_states`
/// states, at least 1, the search ends as explore() does at a limit. Throws std::runtime_error if a
/// state is inconsistent, or the coordinator fails.
[[nodiscard]] Exploration explore_plainly(const CompiledCatalog& catalog,
                                          const std::vector<GroupId>& groups,
                                          const Assumptions& assumptions,
                                          const std::vector<const Property*>& properties,
                                          std::uint64_t max_states);

}  // namespace cbc::plain
