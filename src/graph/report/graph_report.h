#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"

// Pictures of catalogs, and the differences of two.

/// Colors that people with any kind of color blindness can tell apart (Okabe and Ito, "Color
/// Universal Design"), and tints of them that black text stands out from, on paper, too. Nothing is
/// told by color alone.
namespace cbc::palette {

struct Color {
  std::string_view line;
  std::string_view fill;
};

inline constexpr std::string_view ink = "#000000";
inline constexpr std::string_view paper = "#FFFFFF";
inline constexpr std::string_view faint = "#767676";
inline constexpr std::string_view frame = "#999999";
inline constexpr std::string_view framed = "#F5F5F5";

inline constexpr Color task = {ink, "#E3F2FB"};  // sky blue
inline constexpr Color behavior = {ink, paper};
inline constexpr std::string_view requirement = "#0072B2";  // blue
inline constexpr std::string_view exclusion = "#B0558B";  // reddish purple, darkened for thin lines

/// Of groups, which have the color of their number; more than these repeat.
inline constexpr std::array<Color, 5> groups = {{{"#E69F00", "#FAE7BF"},    // orange
                                                 {"#009E73", "#BFE7DC"},    // bluish green
                                                 {"#CC79A7", "#F2DDE9"},    // reddish purple
                                                 {"#B8AA00", "#FBF8D0"},    // yellow
                                                 {"#0072B2", "#BFDCEC"}}};  // blue

[[nodiscard]] constexpr const Color& of_group(std::uint32_t group) {
  return groups[group % groups.size()];
}

/// What stands out.
struct Look {
  Color color;
  std::string_view text;
  std::string_view name;  ///< of the color
  bool is_thick = false;
  bool is_dashed = false;  ///< the frame of a node
};

/// Empty if it looks like others of its kind.
[[nodiscard]] constexpr std::optional<Look> look_of(draw::Mark mark) {
  switch (mark) {
    case draw::Mark::plain:
      break;
    case draw::Mark::faint:
      return Look{{faint, paper}, faint, "gray"};
    case draw::Mark::faulty:
      return Look{{"#D55E00", "#FBE5D6"}, ink, "red", true};  // vermillion
    case draw::Mark::added:
      return Look{{"#007A59", "#BFE7DC"}, ink, "green", true};  // bluish green
    case draw::Mark::removed:
      return Look{{"#D55E00", "#FBE5D6"}, ink, "red", true, true};
    case draw::Mark::changed:
      return Look{{"#B37B00", "#FAE7BF"}, ink, "orange", true};  // orange
    case draw::Mark::active:
      return Look{{"#0072B2", "#BFDCEC"}, ink, "blue", true};  // blue
    case draw::Mark::started:
      return look_of(draw::Mark::added);
    case draw::Mark::stopped:
      return look_of(draw::Mark::removed);
    case draw::Mark::unavailable:
      return Look{{faint, "#EEEEEE"}, "#595959", "gray", false, true};
  }
  return std::nullopt;
}

}  // namespace cbc::palette

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
