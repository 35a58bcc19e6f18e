#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "graph/engine/catalog_graph.h"

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
