#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coverage/goal_facts.h"
#include "coverage/goals.h"
#include "verify/properties.h"

namespace cbc {

/// Which goals no mission can meet, whatever its events, as far as the assumptions allow them.
struct GoalProof {
  /// What was visited of a group.
  struct Group {
    std::uint64_t states = 0;
    std::uint64_t moves = 0;
    bool is_complete = false;  ///< false: a limit came first, and nothing is proven
  };
  std::vector<Group> groups;  ///< by group
  /// By goal: why no move meets it, if that is proven; otherwise empty. See why_unreachable.
  std::vector<std::string> unreachable;
  GoalFacts facts;  ///< of the groups that are complete
  /// The first state contradicts `never`; then nothing is proven.
  std::optional<std::string> error;
};

struct GoalProofOptions {
  std::optional<std::uint32_t> group;    ///< the only one to visit; empty: all
  std::uint64_t max_states = 1'000'000;  ///< of each group
  /// Called now and then; false ends the exploration as a limit does. May be empty.
  std::function<bool(std::uint32_t group, std::uint64_t states)> on_progress;
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
