#pragma once

#include <vector>

#include "ask/formula.h"
#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What the assumptions say of all states. They must outlive it.
[[nodiscard]] PossibleStates possible_states(const CompiledCatalog& catalog,
                                             const Assumptions& assumptions);

/// Whether the constraints alone decide that an always or never holds: no assignment of the groups
/// that satisfies them, with behaviors that fit in one situation that may occur, breaks it, be it
/// reachable or not. `groups`: those that the property is about, see scope_of(). False: this is not
/// so, or the effort of the search for one would be too much.
[[nodiscard]] bool is_proved_by_constraints(const CompiledCatalog& catalog,
                                            const std::vector<GroupId>& groups,
                                            const Assumptions& assumptions,
                                            const Property& property);

}  // namespace cbc
