#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/support/json.h"
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
void append_mermaid_id(std::string& text, std::string_view id) {
  constexpr std::string_view digits = "0123456789abcdef";
  bool is_in_name = false;
  for (const char byte : id) {
    if (is_letter_or_digit(byte) || byte == '_') {
      text += byte;
    } else if (byte == ':' && !is_in_name) {
      text += '_';
      is_in_name = true;
    } else {
      const unsigned value = static_cast<unsigned char>(byte);
      text += '.';
      text += digits[value / 16];
      text += digits[value % 16];
    }
  }
}

/// A label. Mermaid reads it as Markdown with its own entities ("#35;"), so every character that
/// may have a meaning there is escaped.
void append_mermaid_label(std::string& text, std::string_view label) {
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
      text += '#' + std::to_string(static_cast<int>(byte)) + ';';
    }
  }
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
      text_ += "  subgraph ";
      append_mermaid_id(text_, diagram_.clusters[place].id);
      text_ += "[\"";
      append_mermaid_label(text_, diagram_.clusters[place].label);
      text_ += "\"]\n";
      for (const draw::Node* const node : members[place]) add_node(*node, "    ");
      text_ += "  end\n";
    }
  }

  void add_legend() {
    text_ += "  legend[\"";
    std::string_view separator;
    for (const LegendEntry& entry : diagram_.legend) {
      text_ += separator;
      append_mermaid_label(text_, std::visit(SampleText(), entry.sample) + ": " + entry.meaning);
      separator = "<br/>";
    }
    text_ += "\"]:::faint\n";
  }

  void add_node(const draw::Node& node, std::string_view indent) {
    text_ += indent;
    append_mermaid_id(text_, node.id);
    switch (node.kind) {
      case NodeKind::task:
        add_text("([\"", node, "\"])");
        break;
      case NodeKind::behavior:
        add_text("[\"", node, "\"]");
        break;
      case NodeKind::hub:
        add_text("((\"", node, "\"))");
        break;
    }
    text_ += ":::" + class_of(node) + '\n';
  }

  void add_text(std::string_view open, const draw::Node& node, std::string_view close) {
    text_ += open;
    if (node.label.empty()) {
      text_ += ' ';
    } else {
      append_mermaid_label(text_, node.label);
    }
    for (const std::string& note : node.notes) {
      text_ += "<br/>";
      append_mermaid_label(text_, note);
    }
    text_ += close;
  }

  void add_edge(const Edge& edge) {
    text_ += "  ";
    append_mermaid_id(text_, diagram_.nodes[edge.from].id);
    switch (edge.kind) {
      case EdgeKind::performed_by:
      case EdgeKind::same_behavior:
        text_ += " ---";
        break;
      case EdgeKind::requirement:
        text_ += " -.->";
        break;
      case EdgeKind::exclusion:
        text_ += " -.-";
        break;
    }
    if (!edge.label.empty()) {
      text_ += "|\"";
      append_mermaid_label(text_, edge.label);
      text_ += "\"|";
    }
    text_ += ' ';
    append_mermaid_id(text_, diagram_.nodes[edge.to].id);
    text_ += '\n';
  }

  void add_class(std::string_view name, const palette::Look& look) {
    text_ += "  classDef ";
    text_ += name;
    text_ += " fill:" + std::string(look.color.fill) + ",stroke:" + std::string(look.color.line) +
             ",color:" + std::string(look.text);
    if (look.is_thick) text_ += ",stroke-width:3px";
    if (look.is_dashed) text_ += ",stroke-dasharray:6 4";
    text_ += '\n';
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
    std::map<std::string, std::vector<std::size_t>> by_style;
    for (std::size_t place = 0; place < diagram_.edges.size(); ++place) {
      by_style[line_style(diagram_.edges[place])].push_back(place);
    }
    for (const auto& [style, edges] : by_style) {
      if (style.empty()) continue;
      std::string_view separator = "  linkStyle ";
      for (const std::size_t edge : edges) {
        text_ += separator;
        text_ += std::to_string(edge);
        separator = ",";
      }
      text_ += ' ' + style + '\n';
    }
  }

  const draw::Diagram& diagram_;
  std::string text_;
};

}  // namespace

std::string graph_mermaid(const draw::Diagram& diagram) { return MermaidWriter(diagram).run(); }

}  // namespace cbc
