#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/explain/reasons.h"

namespace cbc {

// The exploration of all reachable states of some groups (docs/verify.md, "States").

/// One move. Moves are compared in the order of the kinds, then by `subject`, then by `choice` in
/// the order in which priorities or values are listed.
struct Move {
  enum class Kind : std::uint8_t {
    start,
    stop,
    success,           ///< finish with goal_achieved
    failure,           ///< finish with process_failure
    situation_change,  ///< finish with situation_change
    fault,
    repair,
    variable,  ///< a situation variable gets another value
    own,       ///< own(b) becomes the other of the two
    due        ///< the first set of the queue comes due
  };
  Kind kind = Kind::due;
  /// Place in the catalog of the task (start, stop), the behavior, or the variable; 0 if due.
  std::uint32_t subject = 0;
  /// Of start: the priority. Of variable: the value. Of own: whether the behavior is available now.
  std::int32_t choice = 0;

  bool operator==(const Move&) const = default;
};

/// Where an exploration ends although states are left. 0: no limit.
struct ExplorationLimits {
  std::uint64_t max_states = 0;
  std::uint64_t max_memory = 0;  ///< bytes, of states, successors, tables and remembered decisions
  double seconds = 0;
};

/// What ended an exploration before its end.
enum class ExplorationEnd : std::uint8_t {
  max_states,
  max_memory,
  time_limit,
  too_many,  ///< there are no numbers left for states
  stopped    ///< by on_progress
};

struct ExplorationProgress {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::uint64_t waiting = 0;  ///< states that are not expanded yet
  std::uint32_t depth = 0;
};

struct ExplorationOptions {
  ExplorationLimits limits;
  unsigned jobs = 1;
  /// Takes states for the same that differ only in the order of requests of equal priority that
  /// cannot interact (Model::interaction_classes). They have the same moves, to the same states in
  /// this sense: verdicts, scripts and least numbers of moves stay as they are, and only the counts
  /// of states and transitions, and the depth, are those of what is left.
  bool reduce = false;
  /// Called now and then, by one thread at a time; false ends the exploration as a limit does. May
  /// be empty.
  std::function<bool(const ExplorationProgress&)> on_progress;
};

/// What was found out about one property.
struct Verdict {
  enum class Result : std::uint8_t { proved, violated, undecided };
  Result result = Result::undecided;
  /// The shortest counterexample; of a reachable that is proved, the shortest witness; empty if the
  /// first state is one, or there is none. Of can_start the refused start is its last move.
  std::vector<Move> script;
  bool has_script = false;
};

/// The result of the exploration of some groups.
struct Exploration {
  std::vector<std::uint32_t> groups;  ///< ascending
  bool complete = false;              ///< false: a limit ended it
  bool reduced = false;               ///< see ExplorationOptions::reduce
  std::optional<ExplorationEnd> end;  ///< which one; if not complete
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

  std::vector<Verdict> verdicts;  ///< in the order of the properties
  /// See Model::find_obstacle(); then nothing was explored.
  std::optional<std::string> error;
  /// Of start, stop and finish events: how many answers were looked up, how many computed.
  std::uint64_t decisions_remembered = 0;
  std::uint64_t decisions_computed = 0;
  std::uint64_t bytes = 0;  ///< of states and their index
};

/// Visits every reachable state of the groups. Same results for any number of jobs. `properties`
/// are about tasks and behaviors of these groups only; the variables that they name are part of the
/// state.
[[nodiscard]] Exploration explore(const CompiledCatalog& catalog,
                                  const std::vector<std::uint32_t>& groups,
                                  const Assumptions& assumptions,
                                  const std::vector<const Property*>& properties,
                                  const ExplorationOptions& options);

}  // namespace cbc
