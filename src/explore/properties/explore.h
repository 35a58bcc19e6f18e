#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "explore/model/model.h"
#include "explore/moves/stepper.h"
#include "explore/properties/outcomes.h"
#include "explore/properties/property_test.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What holds in all reachable states of some groups (docs/verify.md, "States"): one exploration
// decides several properties, and counts what tasks and behaviors it has seen.

/// How to explore, and what else to look for.
struct ExplorationOptions {
  Budget budget;      ///< of each exploration
  unsigned jobs = 1;  ///< threads
  /// Takes states for the same that differ only in the order of requests of equal priority that
  /// cannot interact (Model::interaction_classes). They have the same moves, to the same states in
  /// this sense: verdicts, scripts and least numbers of moves stay as they are, and only the counts
  /// of states and transitions, and the depth, are those of what is left.
  bool reduce = false;
  bool outcomes = false;  ///< also finds Exploration::outcomes
  /// Of explorations of one catalog. Called by several threads at once; one question may come more
  /// than once. Only moves count, so Exploration::start_refused, for which starts are tried, is
  /// left out. May be empty.
  DecisionListener on_decision;
};

/// Sets apart a quarter of the memory of a budget for remembered decisions.
[[nodiscard]] Stepper::Options share_memory(const ExplorationOptions& options, Budget& budget);

/// "group 2", "groups 0 3".
[[nodiscard]] std::string name_groups(const std::vector<GroupId>& groups);

/// The result of the exploration of some groups.
struct Exploration {
  std::vector<GroupId> groups;     ///< ascending
  bool complete = false;           ///< all states were visited
  bool decided = false;            ///< it ended as soon as all properties were decided
  bool has_left_out = false;       ///< there were moves after which too many requests wait
  std::optional<Budget::End> end;  ///< the limit that ended it; if there was one
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  /// The length of the longest shortest path. Not complete: every state up to this depth was
  /// expanded.
  std::uint32_t depth = 0;
  std::vector<std::uint64_t> states_at_depth;

  // The least number of moves to a state; in catalog order. Numbers are places in the catalog.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;           ///< tasks
  std::vector<std::pair<std::uint32_t, std::uint32_t>> active;         ///< behaviors
  std::vector<std::pair<std::uint32_t, std::uint32_t>> start_refused;  ///< tasks
  struct Together {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::uint32_t depth = 0;
  };
  std::vector<Together> together;  ///< pairs of tasks, a before b

  std::optional<std::vector<ReachableOutcome>> outcomes;  ///< see ExplorationOptions::outcomes

  std::vector<Verdict> verdicts;  ///< in the order of the properties
  /// See Model::find_obstacle(); then nothing was explored.
  std::optional<std::string> error;
  /// How many answers to starts, stops and finishes were looked up, and how many computed.
  std::uint64_t decisions_remembered = 0;
  std::uint64_t decisions_computed = 0;
  std::uint64_t controls = 0;
  std::uint64_t regions = 0;        ///< of environments that a move takes alike, of all controls
  std::uint64_t diagram_nodes = 0;  ///< of the sets of environments
  std::uint64_t bytes = 0;          ///< of all this
};

/// Visits every reachable state of the groups, or as many as it takes to decide all properties.
/// Same results for any number of jobs. `properties` are about tasks and behaviors of these groups
/// only; the variables that they name are part of the state. One with a mark must be the only one.
[[nodiscard]] Exploration explore(const CompiledCatalog& catalog,
                                  const std::vector<GroupId>& groups,
                                  const Assumptions& assumptions,
                                  const std::vector<const Property*>& properties,
                                  const ExplorationOptions& options);

}  // namespace cbc
