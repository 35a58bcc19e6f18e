#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/property/properties.h"
#include "core/support/budget.h"
#include "coverage/engine/goal_system.h"
#include "coverage/engine/goals.h"
#include "explore/model/model.h"
#include "explore/space/state_space.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// What the searches of all groups may take together.
struct GoalSearchOptions {
  Budget budget;      ///< of all groups together; states and memory: of each
  unsigned jobs = 1;  ///< threads
  double kept = 0;    ///< the share of the time for what comes after all groups

  /// The budget of one of several groups that are visited one after the other: a tenth of the time
  /// is shared by those after it, which may be small.
  [[nodiscard]] Budget budget_of(GroupId group, std::size_t groups) const;
};

/// What a search visited.
struct GoalSearchResult {
  std::uint64_t states = 0;
  std::uint64_t moves = 0;
  bool is_complete = false;        ///< false: a limit came first, and nothing is proven
  std::optional<Budget::End> end;  ///< which one; if not complete
  /// See Model::find_obstacle(); then nothing was visited.
  std::optional<std::string> error;
};

/// What a search is about.
struct GoalScope {
  std::optional<GroupId> group;
  /// Without a group: a variable that no behavior names, with what `never` ties to it.
  std::uint32_t variable = none;
};

/// The variables that may change, that no behavior names, and that `never` binds to others or to
/// some of their values. In catalog order.
[[nodiscard]] std::vector<std::uint32_t> bound_variables(const CompiledCatalog& catalog,
                                                         const Assumptions& assumptions);

/// Visits the reachable states of a scope (docs/verify.md, "States"), and finds the goals that
/// their moves meet: the exploration of `cbc verify`, of a GoalSystem.
class GoalSearch {
 public:
  /// Everything must outlive it.
  GoalSearch(const CompiledCatalog& catalog, GoalScope scope, const Assumptions& assumptions,
             const GoalQuestion& question, const GoalSearchOptions& options);

  /// Once. If it is complete, adds what was seen, and the goals that are met, by goal, but for
  /// returns if the question is about moves. `on_depth`: called before and after the moves of each
  /// depth are made. May be empty.
  [[nodiscard]] GoalSearchResult run(GoalFacts& facts, std::vector<std::uint8_t>& met,
                                     const std::function<void()>& on_depth = {});

  /// Not if there is an error.
  [[nodiscard]] StateSpace& space() { return *space_; }
  [[nodiscard]] const std::vector<GoalSystem*>& systems() const { return systems_; }

 private:
  void find_returns(std::vector<std::uint8_t>& met);
  void report(GoalFacts& facts, std::vector<std::uint8_t>& met);

  const GoalQuestion& question_;
  const Model model_;
  std::vector<GoalSystem*> systems_;
  std::optional<StateSpace> space_;
};

}  // namespace cbc
