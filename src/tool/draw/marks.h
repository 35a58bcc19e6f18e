#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"

namespace cbc::draw {

/// What runs after an event, and what the event changed. Tasks and behaviors are places in the
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
    bool is_undoing = false;  ///< takes back another change of the event
  };
  std::vector<RunningTask> running;
  std::vector<RunningTask> before;        ///< what ran before the event
  std::optional<std::uint32_t> finished;  ///< the active behavior whose end the event reports
  std::vector<Change> changes;            ///< in order
  std::vector<std::uint32_t> unavailable;
  std::vector<std::uint32_t> faulty;
};

/// Marks what is in use, since the event, or until then, and notes what there is to say of it. All
/// else becomes faint. The graph is that of a good catalog.
void mark_state(CatalogGraph& graph, const RunState& state);

/// Marks what has changed in the lists of exclusive tasks of `graph`, which are those of the newer
/// catalog, and adds what the older one alone excludes. `tasks` finds the tasks of both catalogs in
/// the graph by name.
///
/// A task that excludes all others of a list since, or no longer, is marked in that list. Where
/// lists were joined or split, the new or the old one is marked as a whole, beside those that have
/// been there all the time: tasks exclude one another if any list says so without a mark.
void mark_exclusions(const CompiledCatalog& before,
                     const std::unordered_map<std::string_view, std::uint32_t>& tasks,
                     const CatalogDiff& diff, CatalogGraph& graph);

/// Two catalogs as one: all that the newer one has, and what only the older one has, with marks
/// and notes of what `diff`, their comparison, says. Groups are those of the newer one; what it no
/// longer has is in the group of what it was connected with, or in none. The catalogs and `diff`
/// must outlive the result.
///
/// Exclusions that `diff` does not list are not marked.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                                    const CatalogDiff& diff);

}  // namespace cbc::draw
