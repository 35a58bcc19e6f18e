#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "catalog/situation.h"
#include "compile/compile.h"
#include "compiled/compiled_file.h"
#include "diagnostic/diagnostic.h"
#include "diff/catalog_diff.h"
#include "draw/catalog_graph.h"
#include "draw/diagram.h"
#include "support/json.h"

// What is shown of a catalog: its content, pictures of it, and the differences of two.

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

/// Lists what a compiled catalog holds, for a person and for comparisons: one fact on a line, the
/// terms of catalogs, and no numbers that a change elsewhere would shift (lines of the source are
/// in the JSON only). First the file, then the totals, then each group: its numbers, its tasks
/// (with their behaviors, best first), its behaviors (with what they require) and its exclusivity
/// lists.
[[nodiscard]] std::string catalog_text(const CompiledFile& file);

/// What a compiled catalog holds, as JSON of the schema cbc.catalog/1, one task, behavior or
/// exclusivity list on a line:
///
///     {"schema": "cbc.catalog/1",
///      "format": 1,                         version of the file format
///      "written_by": "0.1.0",               version of cbc
///      "source": {"file": "a.yaml",         as it was named to cbc compile
///                 "digest": "…"},           XXH3-128 of its text, 32 hexadecimal digits
///      "content_digest": "…",               the same of what the file holds
///      "size": 8312,                        of the file, in bytes
///      "tasks": 21, "behaviors": 26,
///      "levels": 3,                         1 + highest level
///      "constraints": {"exclusive_pairs": 17, "requirements": 16, "task_minimums": 0,
///                      "total": 33},
///      "search_space": "1327104",           product of 1 + number of behaviors; a text
///      "variables": [                       of the situation; the first value is the initial one
///        {"variable": "TARGET", "values": ["far", "near"]},
///        {"variable": "GPS", "values": [true, false]}],      declared without values
///      "groups": [{                         in the order of their first task
///        "group": 0,                        as in "search" of cbc.solve/1
///        "levels", "constraints", "search_space": as above, for the group
///        "tasks": [{                        in catalog order
///          "task": "HOVER",
///          "level": 1,                      highest of its behaviors
///          "execution_goal": "achieve_goal",
///          "start_on_request": true,
///          "reactive_start": false,
///          "timeout": 12.5,                 seconds, or null
///          "minimum_performance": 80,       percent, or null
///          "line": 50,                      of that, in the source, or null
///          "parameters": [{"parameter": "speed", "allowed_values": ["0", "30"]}],
///          "behaviors": [                   in the order of the search: best suitability first
///            {"behavior": "HOVER_WITH_MPC", "suitability": 90}]}],       percent
///        "behaviors": [{                    in catalog order
///          "behavior": "HOVER_WITH_MPC",
///          "level": 1,                      0: requires nothing
///          "package": "…",                  empty: none given
///          "timeout": null,                 seconds; null: that of the task
///          "situation": {"TARGET": ["near"]},   the values in which it fits, of each variable that
///                                           it names
///          "requires": [{"task": "LOCALIZE", "minimum_performance": 80, "line": 12}]}],
///        "exclusivity": [{"tasks": ["HOVER", "LAND"], "line": 20}]}]}
///
/// allowed_values is a list of texts, or one text that names a type. Bytes that are no valid UTF-8
/// are replaced.
[[nodiscard]] std::string catalog_json(const CompiledFile& file);

/// Writes a value of a situation variable: a text, or true or false if the variable was declared
/// without values.
void write_plain_value(JsonWriter& json, const CompiledCatalog& catalog, VariableValue value);

/// Writes a situation variable: {"variable": "TARGET", "values": ["far", "near"]}. The values of
/// one without values of its own are true and false.
void write_variable(JsonWriter& json, const CompiledCatalog& catalog, std::uint32_t index);

/// Writes the member "situation" of an object: {"TARGET": ["near", "far"], "GPS": [true]}.
void write_conditions(JsonWriter& json, std::span<const NamedCondition> conditions);

/// Writes the member "constraints" of an object, which counts them.
void write_constraints(JsonWriter& json, const ConstraintCount& constraints);

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
