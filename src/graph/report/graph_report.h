#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "versions/difference/catalog_diff.h"

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

/// A picture as JSON, for programs. Bytes of names that are no valid UTF-8 are replaced.
[[nodiscard]] std::string graph_json(const draw::Diagram& diagram);
[[nodiscard]] std::string graph_schema();

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

/// The performances that differ in values of the situation, for a person to read, a line for each.
[[nodiscard]] std::string fitting_text(const std::vector<FittingChange>& changes,
                                       const Style& style);

/// The differences as JSON; `before` and `after` name the catalogs.
[[nodiscard]] std::string diff_json(const CatalogDiff& diff, std::string_view before,
                                    std::string_view after);
[[nodiscard]] std::string diff_schema();

}  // namespace cbc
