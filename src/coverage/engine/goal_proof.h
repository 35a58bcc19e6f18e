#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goal_facts.h"
#include "coverage/engine/goals.h"
#include "coverage/engine/group_walk.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Which goals no mission can meet, whatever its events, as far as the assumptions allow them.
struct GoalProof {
  std::vector<GroupWalkResult> groups;  ///< by group
  /// By goal: why no move meets it, if that is proven; otherwise empty. See why_unreachable.
  std::vector<std::string> unreachable;
  GoalFacts facts;  ///< of the groups that are complete
  /// See Model::find_obstacle(); then nothing is proven.
  std::optional<std::string> error;
};

struct GoalProofOptions {
  std::optional<std::uint32_t> group;  ///< the only one to visit; empty: all
  GroupWalkOptions walk;
};

/// What holds without a property file: that of `cbc verify`, but requests have the priorities 1 and
/// 2, as some goals are about these, and also start tasks that nothing else could start.
[[nodiscard]] Assumptions assumptions_of_goals(const CompiledCatalog& catalog);

/// Visits all states of each group that are reachable (docs/verify.md, "States"), and makes each
/// move from each of them, on a coordinator that is watched for the goals.
[[nodiscard]] GoalProof prove_unreachable(const CompiledCatalog& catalog,
                                          std::span<const Goal> goals,
                                          const Assumptions& assumptions,
                                          const GoalProofOptions& options);

}  // namespace cbc
