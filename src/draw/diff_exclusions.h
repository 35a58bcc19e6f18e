#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "compiled/compiled_catalog.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"

namespace cbc::draw {

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

}  // namespace cbc::draw
