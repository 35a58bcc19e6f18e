#pragma once

#include <set>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What of the situation is part of the states of some groups (docs/verify.md, "States").
struct StateSituation {
  std::set<std::uint32_t> variables;
  std::set<BehaviorId> behaviors;  ///< those whose own(b) may change, perhaps of other groups
};

/// What the behaviors of the groups depend on, the variables `watched`, and all that `never` ties
/// to these: what one of its entries names together is decided together.
[[nodiscard]] StateSituation situation_of_states(const CompiledCatalog& catalog,
                                                 const std::vector<GroupId>& groups,
                                                 const Assumptions& assumptions,
                                                 const std::set<std::uint32_t>& watched);

/// The variables that behaviors of a group name.
[[nodiscard]] std::set<std::uint32_t> variables_named_by(const CompiledCatalog& catalog,
                                                         GroupId group);

}  // namespace cbc
