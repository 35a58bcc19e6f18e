#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <vector>

#include "ask/ask.h"
#include "ask/situation_space.h"
#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"

// Faults that together make a task impossible: its minimal cut sets (docs/verify.md, "Cut sets").

namespace cbc {

/// How far a search for cut sets has come.
struct CutSetProgress {
  std::uint32_t size = 0;      ///< of the sets that are examined now; values count, too
  std::uint64_t examined = 0;  ///< sets
  std::uint64_t found = 0;     ///< cut sets
};

struct CutSetOptions {
  std::uint32_t order = 1;  ///< the most behaviors of a cut set
  /// Also finds the sets that suffice in some of the situations.
  bool in_some_situation = false;
  /// Called before each search for an assignment, and now and then during a long one; false ends
  /// the whole search. May be empty.
  std::function<bool(const CutSetProgress&)> on_progress;
};

/// Behaviors without which a task cannot run where some situation variables have these values.
struct CutSet {
  BehaviorSet behaviors;  ///< in catalog order
  /// In catalog order, one of a variable, and in some situation together; none: in every situation.
  std::vector<VariableValue> values = {};

  [[nodiscard]] bool operator==(const CutSet&) const = default;
};

/// The minimal cut sets of a task, up to some size: of none of them, a part suffices under the same
/// values or fewer.
struct CutSets {
  /// By number of behaviors, then in catalog order, then by the values. No behaviors: the task
  /// cannot run even without a fault.
  std::vector<CutSet> sets;
  /// Whether all sets up to the order are there.
  bool complete = false;
  /// If not complete: all sets with fewer behaviors and values than this are there. Each set that
  /// is there is minimal.
  std::uint32_t incomplete_size = 0;
  std::uint64_t searches = 0;  ///< for assignments

  /// Those that suffice in every situation.
  [[nodiscard]] std::vector<BehaviorSet> in_every_situation() const;
};

/// The minimal sets of behaviors without which the task cannot run in any of the situations: in
/// none of them there is an assignment that satisfies all constraints and runs it with behaviors
/// that are available there, none of which is in the set.
[[nodiscard]] CutSets find_cut_sets(const SituationSpace& situations, TaskId task,
                                    const CutSetOptions& options);

}  // namespace cbc
