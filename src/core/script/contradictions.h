#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What is said of one state, by an expectation of a script or a condition of a property file, and
// which parts of it cannot hold together.

/// What is said of the values of tasks. Numbers are those of the compiled catalog.
struct StateClaims {
  /// A task or a behavior, and where it is named.
  struct Named {
    std::uint32_t id = 0;
    Range range;
  };
  struct Running {
    Named task;
    std::optional<Named> behavior;  ///< empty: any
  };

  std::vector<Running> running;
  std::vector<Named> stopped;  ///< tasks
  std::vector<Named> active;   ///< behaviors
  /// Where it is said that no other behavior is active, if it is.
  std::optional<Range> only_active;
};

/// Takes why something can never hold, the place that says it, and places that say otherwise.
using OnContradiction =
    std::function<void(const Range& range, const std::string& why, std::vector<Note> notes)>;

/// Finds claims that contradict each other in any catalog with these behaviors: an active behavior
/// performs a task, and a task has one behavior at most. Tasks that are to run and to be stopped
/// are not reported, nor are behaviors that do not perform their task.
void find_contradictions(const StateClaims& claims, const CompiledCatalog& catalog,
                         const Reporter& reporter, const OnContradiction& on_contradiction);

/// Finds claims that exclusions of the catalog do not allow together. It knows nothing of
/// performances.
void find_excluded(const StateClaims& claims, const CompiledCatalog& catalog,
                   const Reporter& reporter, const OnContradiction& on_contradiction);

/// The same with all that requirements make run, too.
void find_ruled_out(const StateClaims& claims, const CompiledCatalog& catalog,
                    const Reporter& reporter, const OnContradiction& on_contradiction);

}  // namespace cbc
