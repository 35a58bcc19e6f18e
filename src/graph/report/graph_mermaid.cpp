#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/support/json.h"
#include "core/support/wording.h"
#include "graph/engine/diagram.h"
#include "graph/report/graph_report.h"

namespace cbc {
namespace {

using draw::Edge;
using draw::EdgeKind;
using draw::LegendEntry;
using draw::Mark;
using draw::NodeKind;

constexpr std::array standing_out = {Mark::faulty, Mark::added,   Mark::removed, Mark::changed,
                                     Mark::active, Mark::started, Mark::stopped, Mark::unavailable};

bool is_letter_or_digit(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9');
}

bool is_ascii(char byte) { return static_cast<unsigned char>(byte) < 0x80; }

/// An id of one word: "task_HOVER". ".20" stands for another byte.
std::string mermaid_id(std::string_view id) {
  std::string text;
  bool is_in_name = false;
  for (const char byte : id) {
    if (is_letter_or_digit(byte) || byte == '_') {
      text += byte;
    } else if (byte == ':' && !is_in_name) {
      text += '_';
      is_in_name = true;
    } else {
      text += fmt::format(".{:02x}", static_cast<unsigned char>(byte));
    }
  }
  return text;
}

/// A label. Mermaid reads it as Markdown with its own entities ("#35;"), so every character that
/// may have a meaning there is escaped.
std::string mermaid_label(std::string_view label) {
  std::string text;
  for (std::size_t i = 0; i < label.size(); ++i) {
    const char byte = label[i];
    const bool is_inside = i > 0 && i + 1 < label.size() && is_letter_or_digit(label[i - 1]) &&
                           is_letter_or_digit(label[i + 1]);
    const bool is_single_blank =
        byte == ' ' && i > 0 && i + 1 < label.size() && label[i - 1] != ' ';
    const bool is_single_percent =
        byte == '%' && label.substr(i + 1, 1) != "%" && (i == 0 || label[i - 1] != '%');
    const bool stands_for_itself = is_single_percent || is_letter_or_digit(byte) ||
                                   !is_ascii(byte) || is_single_blank ||
                                   (is_inside && (byte == '_' || byte == '.' || byte == '-'));
    if (stands_for_itself) {
      text += byte;
    } else {
      text += fmt::format("#{};", static_cast<int>(byte));
    }
  }
  return text;
}

/// What a legend says of shapes, lines and marks: its node is text.
struct SampleText {
  std::string operator()(NodeKind kind) const {
    switch (kind) {
      case NodeKind::task:
        return "round";
      case NodeKind::behavior:
        return "angular";
      case NodeKind::hub:
        break;
    }
    return "● · · ·";
  }
  std::string operator()(EdgeKind kind) const {
    switch (kind) {
      case EdgeKind::performed_by:
      case EdgeKind::same_behavior:
        break;
      case EdgeKind::requirement:
        return "– – ▸";
      case EdgeKind::exclusion:
        return "· · · ·";
    }
    return "——";
  }
  std::string operator()(Mark mark) const {
    const std::optional<palette::Look> look = palette::look_of(mark);
    return draw::with_sign(mark, std::string(look->name) + (look->is_dashed ? ", dashed" : ""));
  }
  std::string operator()(LegendEntry::Frame) const { return "frame"; }
  std::string operator()(const std::string& text) const { return text; }
};

std::string class_of_group(std::size_t group) {
  return "group" + std::to_string(group % palette::groups.size());
}

std::string class_of(const draw::Node& node) {
  if (node.mark == Mark::faint) return "faint";
  if (node.mark != Mark::plain)
    return node.is_defined ? std::string(name_of(node.mark)) : "undefined";
  if (node.color != none) return class_of_group(node.color);
  if (node.kind == NodeKind::hub) return "hub";
  return node.kind == NodeKind::task ? "task" : "behavior";
}

class MermaidWriter {
 public:
  explicit MermaidWriter(const draw::Diagram& diagram) : diagram_(diagram) {}

  std::string run() && {
    if (diagram_.moment) add_title();
    text_ += "flowchart LR\n";
    add_nodes();
    for (const Edge& edge : diagram_.edges) add_edge(edge);
    if (!diagram_.legend.empty()) add_legend();
    add_classes();
    add_line_styles();
    return std::move(text_);
  }

 private:
  /// The front matter between the dashes is YAML, which includes JSON. Mermaid takes "<stdin>" in
  /// titles for a tag, and titles have no entities to escape it with.
  void add_title() {
    std::string title;
    for (const std::string& line : draw::caption_of(*diagram_.moment)) {
      if (!title.empty()) title += ": ";
      for (const char byte : line) {
        if (byte == '<') {
          title += "‹";
        } else if (byte == '>') {
          title += "›";
        } else {
          title += byte;
        }
      }
    }
    text_ += "---\ntitle: ";
    append_text(text_, title);
    text_ += "\n---\n";
  }

  void add_nodes() {
    for (const draw::Node& node : diagram_.nodes) {
      if (node.cluster == none) add_node(node, "  ");
    }
    const auto members = draw::cluster_members(diagram_);
    for (std::size_t place = 0; place < members.size(); ++place) {
      const draw::Cluster& cluster = diagram_.clusters[place];
      text_ += fmt::format("  subgraph {}[\"{}\"]\n", mermaid_id(cluster.id),
                           mermaid_label(cluster.label));
      for (const draw::Node* const node : members[place]) add_node(*node, "    ");
      text_ += "  end\n";
    }
  }

  void add_legend() {
    const auto line = [](const LegendEntry& entry) {
      return mermaid_label(std::visit(SampleText(), entry.sample) + ": " + entry.meaning);
    };
    text_ += fmt::format("  legend[\"{}\"]:::faint\n", join(diagram_.legend, "<br/>", line));
  }

  void add_node(const draw::Node& node, std::string_view indent) {
    constexpr std::pair<std::string_view, std::string_view> brackets[] = {
        {"([", "])"}, {"[", "]"}, {"((", "))"}};
    const auto [open, close] = brackets[static_cast<std::size_t>(node.kind)];
    std::string label = node.label.empty() ? " " : mermaid_label(node.label);
    for (const std::string& note : node.notes) label += "<br/>" + mermaid_label(note);
    text_ += fmt::format("{}{}{}\"{}\"{}:::{}\n", indent, mermaid_id(node.id), open, label, close,
                         class_of(node));
  }

  void add_edge(const Edge& edge) {
    constexpr std::string_view lines[] = {"---", "-.->", "-.-", "---"};
    text_ += fmt::format("  {} {}", mermaid_id(diagram_.nodes[edge.from].id),
                         lines[static_cast<std::size_t>(edge.kind)]);
    if (!edge.label.empty()) text_ += fmt::format("|\"{}\"|", mermaid_label(edge.label));
    text_ += fmt::format(" {}\n", mermaid_id(diagram_.nodes[edge.to].id));
  }

  void add_class(std::string_view name, const palette::Look& look) {
    text_ += fmt::format("  classDef {} fill:{},stroke:{},color:{}{}{}\n", name, look.color.fill,
                         look.color.line, look.text, look.is_thick ? ",stroke-width:3px" : "",
                         look.is_dashed ? ",stroke-dasharray:6 4" : "");
  }

  /// Fills, lines and texts have colors, so that the nodes look alike on light and dark pages.
  void add_classes() {
    std::set<std::string> used;
    for (const draw::Node& node : diagram_.nodes) used.insert(class_of(node));
    if (!diagram_.legend.empty()) used.insert("faint");
    const auto add = [&](std::string_view name, const palette::Look& look) {
      if (used.contains(std::string(name))) add_class(name, look);
    };
    add("task", {palette::task, palette::ink, {}});
    add("behavior", {palette::behavior, palette::ink, {}});
    add("hub", {{palette::exclusion, palette::exclusion}, palette::paper, {}});
    add("faint", *palette::look_of(Mark::faint));
    for (const Mark mark : standing_out) add(name_of(mark), *palette::look_of(mark));
    palette::Look undefined = *palette::look_of(Mark::faulty);
    undefined.is_dashed = true;
    add("undefined", undefined);
    for (std::uint32_t group = 0; group < palette::groups.size(); ++group) {
      add(class_of_group(group), {palette::groups[group], palette::ink, {}});
    }
  }

  /// Plain lines keep the color of the page's theme.
  static std::string line_style(const Edge& edge) {
    std::string style;
    if (const std::optional<palette::Look> look = palette::look_of(edge.mark)) {
      style = "stroke:" + std::string(look->color.line);
      if (look->is_thick) style += ",stroke-width:3px";
    }
    if (edge.kind != EdgeKind::exclusion) return style;
    return style + (style.empty() ? "" : ",") + "stroke-dasharray:2 5";
  }

  /// One for each edge: a second one would replace the first.
  void add_line_styles() {
    std::map<std::string, std::vector<std::string>> by_style;
    for (std::size_t place = 0; place < diagram_.edges.size(); ++place) {
      by_style[line_style(diagram_.edges[place])].push_back(std::to_string(place));
    }
    for (const auto& [style, edges] : by_style) {
      if (!style.empty()) text_ += fmt::format("  linkStyle {} {}\n", join(edges, ","), style);
    }
  }

  const draw::Diagram& diagram_;
  std::string text_;
};

}  // namespace

std::string graph_mermaid(const draw::Diagram& diagram) { return MermaidWriter(diagram).run(); }

}  // namespace cbc
