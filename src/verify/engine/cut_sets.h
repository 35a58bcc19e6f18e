#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"

// Faults that together make a task impossible: its minimal cut sets.

namespace cbc {

/// How far a search for cut sets has come.
struct CutSetProgress {
  std::uint32_t size = 0;      ///< of the sets that are examined now
  std::uint64_t examined = 0;  ///< sets
  std::uint64_t found = 0;     ///< cut sets
};

struct CutSetOptions {
  std::uint32_t order = 1;  ///< the largest size of a cut set
  /// Called before each search for an assignment, and now and then during a long one; false ends
  /// the whole search. May be empty.
  std::function<bool(const CutSetProgress&)> on_progress;
};

/// The minimal cut sets of a task, up to some size.
struct CutSets {
  /// By size, then in catalog order, as are the behaviors of a set. One empty set: the task cannot
  /// run even without a fault.
  std::vector<std::vector<BehaviorId>> sets;
  /// Whether all sets up to the order are there.
  bool complete = false;
  /// If not complete: all sets smaller than this are there. Each set that is there is minimal.
  std::uint32_t incomplete_size = 0;
  std::uint64_t searches = 0;  ///< for assignments
};

/// The behaviors that a situation rules out, by BehaviorId: they do not fit, or own(b) is false.
/// Variables that `situation` does not mention may have any value; without a situation nothing is
/// ruled out.
[[nodiscard]] std::vector<bool> ruled_out_by(const CompiledCatalog& catalog,
                                             const std::optional<SituationPart>& situation);

/// The minimal sets of behaviors without which the task cannot run: no assignment that satisfies
/// all constraints runs it while none of the set, and none of those ruled out (by BehaviorId), is
/// active.
[[nodiscard]] CutSets find_cut_sets(const CompiledCatalog& catalog, TaskId task,
                                    const std::vector<bool>& ruled_out,
                                    const CutSetOptions& options);

}  // namespace cbc
