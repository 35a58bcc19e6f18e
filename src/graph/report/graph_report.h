#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/diagram.h"

// Pictures of catalogs, and the differences of two.

namespace cbc {

/// A picture for Graphviz's program `dot`.
[[nodiscard]] std::string graph_dot(const draw::Diagram& diagram);

/// A picture for Mermaid, which draws it where the text stands: in a README file, a pull request.
[[nodiscard]] std::string graph_mermaid(const draw::Diagram& diagram);

/// A picture as JSON, for programs (schema "cbc.graph/1"):
///
///     {"schema": "cbc.graph/1",
///      "catalog": "robot.yaml",
///      "view": "full",                      or tasks, constraints, behaviors
///      "state": {"script": "mission.yaml",  only of a state: what it is that of
///                "index": 3,                as in cbc.solve/1: of the last event; 0: none yet
///                "time": 4.5,               its time; null: none yet
///                "event": "wait",           what it was, and what came of it; null: none yet
///                "situation": "TARGET is near"},   only of a catalog with situation variables
///      "nodes": [
///        {"id": "task:HOVER",               unique, from the name
///         "kind": "task",                   or behavior, hub (an exclusivity list)
///         "name": "HOVER",                  null for a hub, and for a behavior that lacks one
///         "group": 0,                       as in "search" of cbc.solve/1; null: in none
///         "package": "…",                   of a behavior; empty: none given
///         "situation": {"TARGET": ["near"], "GPS": [true]},   of a behavior that names variables:
///                                           the values in which it fits
///         "minimum_performance": 80,        of a task: percent, or null
///         "left_out": 12,                   of a hub: tasks of the list that are not drawn
///         "defined": true,                  of a task: false if it is only named
///         "priority": 2,                    of a task, only of a state: of its request, or null
///         "mark": null,                     how it stands out: "faulty" (an error of the
///                                           catalog); of a state "active", "started" and
///                                           "stopped" (by the event), "unavailable"
///         "notes": ["≥ 80 %"]}],            what else the picture says of it, a line each
///      "edges": [
///        {"kind": "performed_by",           or requirement, exclusion (between two, or from a
///                                           hub), same_behavior (between tasks that one
///                                           behavior performs)
///         "from": "task:HOVER", "to": "behavior:HOVER_WITH_MPC",
///         "suitability": 90,                of performed_by: percent
///         "minimum_performance": null,      of requirement: percent, or null; in the view of the
///                                           tasks the highest of all behaviors
///         "mark": null}]}                   as of nodes
///
/// Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string graph_json(const draw::Diagram& diagram);

/// A format of `cbc graph`.
struct GraphFormat {
  std::string_view name;
  std::array<std::string_view, 2> suffixes;    ///< of files in it; the second one may be empty
  std::string (*write)(const draw::Diagram&);  ///< of one by Graphviz: the input of `dot`
  bool is_by_graphviz = false;                 ///< `dot -T<name>` makes it
  bool is_binary = false;
};

/// The first one is the default.
[[nodiscard]] std::span<const GraphFormat> graph_formats();

/// The differences for a person to read, a line for each: `-` removed, `+` added, `~` changed.
/// Empty if there are none.
[[nodiscard]] std::string diff_text(const CatalogDiff& diff, const Style& style);

/// The differences as JSON, schema cbc.diff/1: `old` and `new` name the catalogs; `changes` has an
/// object for each difference, with `kind` (removed, added, changed), `subject` (task, behavior,
/// performs, requirement, variable, exclusion), the names in question (`task`, `behavior`,
/// `variable`, `other_task`) and
/// `attributes`, each with `name`, `before` and `after`: suitability and minimum_performance in
/// percent, timeout in seconds, null where nothing is set. `further_exclusions` counts those that
/// are not listed.
[[nodiscard]] std::string diff_json(const CatalogDiff& diff, std::string_view before,
                                    std::string_view after);

}  // namespace cbc
