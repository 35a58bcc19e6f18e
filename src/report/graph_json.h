#pragma once

#include <string>

#include "draw/diagram.h"

namespace cbc {

/// A picture as JSON, for programs (schema "cbc.graph/1"):
///
///     {"schema": "cbc.graph/1",
///      "catalog": "robot.yaml",
///      "view": "full",                      or tasks, constraints, behaviors
///      "state": {"script": "mission.yaml",  only of a state: what it is that of
///                "index": 3,                as in cbc.solve/1: of the last event; 0: none yet
///                "time": 4.5,               its time; null: none yet
///                "event": "wait"},          what it was, and what came of it; null: none yet
///      "nodes": [
///        {"id": "task:HOVER",               unique, from the name
///         "kind": "task",                   or behavior, hub (an exclusivity list)
///         "name": "HOVER",                  null for a hub, and for a behavior that lacks one
///         "group": 0,                       as in "search" of cbc.solve/1; null: in none
///         "package": "…",                   of a behavior; empty: none given
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
///        hub),
///                                           same_behavior (between tasks that one behavior
///                                           performs)
///         "from": "task:HOVER", "to": "behavior:HOVER_WITH_MPC",
///         "suitability": 90,                of performed_by: percent
///         "minimum_performance": null,      of requirement: percent, or null; in the view of the
///                                           tasks the highest of all behaviors
///         "mark": null}]}                   as of nodes
///
/// Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string graph_json(const draw::Diagram& diagram);

}  // namespace cbc
