#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"

/// What stands out in a graph: a state, or the differences between two catalogs.
namespace cbc::draw {

/// What runs after an event, and what the event changed. Tasks and behaviors are indices in the
/// catalog.
struct RunState {
  struct RunningTask {
    std::uint32_t task = 0;
    std::uint32_t behavior = 0;
    std::optional<std::int32_t> priority;  ///< of its request; 0: it started by itself
  };
  struct Change {
    std::uint32_t behavior = 0;
    bool is_activation = false;
    bool is_successful = true;
    bool is_undoing = false;  ///< rolls back an earlier change of the event
  };
  std::vector<RunningTask> running;
  std::vector<RunningTask> before;        ///< what ran before the event
  std::optional<std::uint32_t> finished;  ///< the active behavior whose end the event reports
  std::vector<Change> changes;            ///< in order
  std::vector<std::uint32_t> unavailable;
  std::vector<std::uint32_t> faulty;
};

/// Marks what is in use, and what came into use or went out of it with the event, and adds notes.
/// All else becomes faint. The graph is that of a valid catalog.
void mark_state(CatalogGraph& graph, const RunState& state);

/// Two catalogs as one: everything that the newer one has, and what only the older one has, with
/// marks and notes by `diff`, their comparison. Groups are those of the newer one; what it no
/// longer has is in the group of what it was connected with, or in none. The catalogs and `diff`
/// must outlive the result.
///
/// Exclusions that `diff` does not list are not marked.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                                    const CatalogDiff& diff);

}  // namespace cbc::draw
