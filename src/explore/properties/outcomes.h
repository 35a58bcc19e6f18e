#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "explore/controls/catalog_system.h"
#include "explore/model/model.h"
#include "explore/space/state_space.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What events can come to: a set of running tasks and their behaviors, in some reachable state
/// with nothing in the queue (docs/verify.md, "All outcomes").
struct ReachableOutcome {
  /// Tasks and their behaviors, as places in the catalog; in catalog order.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> running;
  std::vector<Move> script;  ///< the first of the shortest ones that lead to such a state

  // The state to which the script leads.

  SituationPart situation;         ///< as far as it is part of the state; in catalog order
  std::vector<BehaviorId> faulty;  ///< in catalog order
};

/// The outcomes among the states up to StateSpace::expanded_depth(): each once, those with shorter
/// scripts first, then compared as lists of tasks and behaviors in catalog order. After the run.
/// `systems`: those of the space.
[[nodiscard]] std::vector<ReachableOutcome> find_outcomes(
    const std::vector<CatalogSystem*>& systems, StateSpace& space);

/// The property of which the script of an outcome of a group is a witness.
[[nodiscard]] Property property_of(const CompiledCatalog& catalog, GroupId group,
                                   const ReachableOutcome& outcome);

}  // namespace cbc
