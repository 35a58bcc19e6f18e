#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goal_search.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// Which goals no mission can meet, whatever its events, as far as the assumptions allow them.
struct GoalProof {
  std::vector<GoalSearchResult> groups;  ///< by group
  /// By variable, of those of bound_variables() that have a value which no group shows.
  std::map<std::uint32_t, GoalSearchResult> situations;
  /// By goal: why no move meets it, if that is proven; otherwise empty. See why_unreachable.
  std::vector<std::string> unreachable;
  GoalFacts facts;  ///< of the groups that are complete
  /// See Model::find_obstacle(); then nothing is proven.
  std::optional<std::string> error;
};

/// What holds without a property file: that of `cbc verify`, but requests have the priorities 1 and
/// 2, as some goals are about these, and also start tasks that nothing else could start.
[[nodiscard]] Assumptions assumptions_of_goals(const CompiledCatalog& catalog);

/// Visits all states of each group that are reachable; see GoalSearch.
[[nodiscard]] GoalProof prove_unreachable(const CompiledCatalog& catalog,
                                          std::span<const Goal> goals,
                                          const Assumptions& assumptions,
                                          const GoalSearchOptions& options);

/// The groups that a goal is about: of a variable those whose behaviors name it.
[[nodiscard]] std::vector<GroupId> groups_of(const CompiledCatalog& catalog, const Goal& goal);

/// Whether the goal is that of a timeout before which another one always comes.
[[nodiscard]] bool is_forestalled(const CompiledCatalog& catalog, const Goal& goal,
                                  const GoalFacts& facts);

/// Why no move meets goal `number` of those of a catalog: "no event requests task LAND". `facts`
/// are those of a complete exploration under the assumptions, which did not meet it.
[[nodiscard]] std::string why_unreachable(const CompiledCatalog& catalog,
                                          std::span<const Goal> goals, std::size_t number,
                                          const Assumptions& assumptions, const GoalFacts& facts);

}  // namespace cbc
