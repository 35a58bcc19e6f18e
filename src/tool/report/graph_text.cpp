#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "draw/diagram.h"
#include "report/catalog_report.h"
#include "support/json.h"
#include "support/wording.h"

namespace cbc {
namespace {

using draw::Edge;
using draw::EdgeKind;
using draw::Node;
using draw::NodeKind;

constexpr std::size_t line_length = 10;  // characters, about

/// A quoted string of DOT. Only the quote itself needs a backslash; in labels, backslashes and
/// ampersands must be escaped as well.
void append_dot_id(std::string& dot, std::string_view id) {
  dot += '"';
  for (const char character : id) {
    if (character == '"') dot += '\\';
    dot += character;
  }
  dot += '"';
}

void append_shown(std::string& dot, std::string_view text) {
  for (const char character : text) {
    if (character == '"' || character == '\\') dot += '\\';
    dot += character;
    if (character == '&') dot += "amp;";
  }
}

/// The attributes of a node or an edge: "[a=b, c=d]", or nothing.
class Attributes {
 public:
  void add(std::string_view name, std::string_view value) {
    text_ += text_.empty() ? " [" : ", ";
    text_ += name;
    text_ += '=';
    text_ += value;
  }
  void add_color(std::string_view name, std::string_view color) {
    add(name, '"' + std::string(color) + '"');
  }
  void add_shown(std::string_view name, std::string_view text) {
    std::string value = "\"";
    append_shown(value, text);
    add(name, value + '"');
  }
  /// Long names are broken into lines, since pictures tend to be wide rather than high.
  void add_label(const Node& node) {
    std::string value = "\"";
    std::vector<std::string_view> lines = wrap_name(node.label, line_length);
    lines.insert(lines.end(), node.notes.begin(), node.notes.end());
    for (const std::string_view line : lines) {
      if (value.size() > 1) value += "\\n";
      append_shown(value, line);
    }
    add("label", value + '"');
  }
  [[nodiscard]] std::string end() const { return text_.empty() ? ";\n" : text_ + "];\n"; }

 private:
  std::string text_;
};

class DotWriter {
 public:
  explicit DotWriter(const draw::Diagram& diagram) : diagram_(diagram) {}

  std::string run() && {
    dot_ = "digraph ";
    append_dot_id(dot_, draw::id_of("catalog", diagram_.file));
    dot_ += " {\n";
    // White, not transparent: black lines would be invisible on a dark page.
    dot_ += "  graph [rankdir=LR, bgcolor=\"#FFFFFF\", pad=0.2, ";
    add_distances();
    dot_ +=
        "fontname=\"Helvetica,Arial,sans-serif\", fontsize=12];\n"
        "  node [style=filled, height=0.3, margin=\"0.08,0.04\", "
        "fontname=\"Helvetica,Arial,sans-serif\", fontsize=11];\n"
        "  edge [arrowsize=0.6, fontname=\"Helvetica,Arial,sans-serif\", fontsize=9];\n";
    add_nodes();
    for (const Edge& edge : diagram_.edges) add_edge(edge);
    if (diagram_.moment) add_caption();
    dot_ += "}\n";
    return std::move(dot_);
  }

 private:
  /// Many edges need space between the columns. They also take vertical space within a column, so
  /// the picture would grow too high with many nodes.
  void add_distances() {
    const bool is_dense = diagram_.edges.size() > 3 * diagram_.nodes.size() / 2;
    const bool is_large = diagram_.nodes.size() > 40;
    dot_ += is_dense && !is_large ? "ranksep=0.9, " : "ranksep=0.3, ";
    dot_ += is_dense && is_large ? "nodesep=0.02, " : "nodesep=0.15, ";
  }

  /// Comes last, since clusters would inherit it.
  void add_caption() {
    dot_ += "  labelloc=t; label=\"";
    std::string_view separator;
    for (const std::string& line : draw::caption_of(*diagram_.moment)) {
      dot_ += separator;
      append_shown(dot_, line);
      separator = "\\n";
    }
    dot_ += "\";\n";
  }

  void add_nodes() {
    for (const Node& node : diagram_.nodes) {
      if (node.cluster == none) add_node(node, "  ");
    }
    const auto members = draw::cluster_members(diagram_);
    for (std::size_t place = 0; place < members.size(); ++place) {
      const draw::Cluster& cluster = diagram_.clusters[place];
      dot_ += "  subgraph ";
      append_dot_id(dot_, cluster.id);
      dot_ += " {\n    label=\"";
      append_shown(dot_, cluster.label);
      dot_ += "\"; style=rounded; color=\"" + std::string(palette::frame) + "\";\n";
      for (const Node* const node : members[place]) add_node(*node, "    ");
      dot_ += "  }\n";
    }
  }

  void add_node(const Node& node, std::string_view indent) {
    Attributes attributes;
    if (node.kind == NodeKind::hub) {
      add_hub(node, attributes);
    } else {
      add_shape(node, attributes);
    }
    dot_ += indent;
    append_dot_id(dot_, node.id);
    dot_ += attributes.end();
  }

  /// A dot, or a box if it has a label. (An xlabel beside a dot does not work with pack.)
  static void add_hub(const Node& node, Attributes& attributes) {
    const std::optional<palette::Look> look = palette::look_of(node.mark);
    const std::string_view color = look ? look->color.line : palette::exclusion;
    if (node.label.empty()) {
      attributes.add("shape", "circle");
      attributes.add("width", "0.1");
      attributes.add("height", "0.1");
      attributes.add("fixedsize", "true");
      attributes.add("label", "\"\"");
      attributes.add_color("fillcolor", color);
    } else {
      attributes.add("shape", "ellipse");
      attributes.add("margin", "\"0.01,0.01\"");
      attributes.add("fontsize", "9");
      attributes.add_label(node);
      attributes.add_color("fillcolor", palette::paper);
      attributes.add_color("fontcolor", color);
    }
    attributes.add_color("color", color);
  }

  static void add_shape(const Node& node, Attributes& attributes) {
    const bool is_task = node.kind == NodeKind::task;
    palette::Color color = is_task ? palette::task : palette::behavior;
    if (node.color != none) color = palette::of_group(node.color);
    const std::optional<palette::Look> look = palette::look_of(node.mark);
    if (look) color = look->color;
    attributes.add("shape", is_task ? "ellipse" : "box");
    if (is_task) attributes.add("margin", "\"0.01,0.03\"");
    attributes.add_label(node);
    attributes.add_color("color", color.line);
    attributes.add_color("fillcolor", color.fill);
    if (look && look->text != palette::ink) attributes.add_color("fontcolor", look->text);
    if (look && look->is_thick) attributes.add("penwidth", "2");
    if (!node.is_defined || (look && look->is_dashed)) {
      attributes.add("style", "\"filled,dashed\"");
    }
  }

  void add_edge(const Edge& edge) {
    Attributes attributes;
    if (!edge.label.empty()) attributes.add_shown("label", edge.label);
    const std::optional<palette::Look> look = palette::look_of(edge.mark);
    const bool is_thick = look && look->is_thick;
    std::string_view color = palette::ink;
    switch (edge.kind) {
      case EdgeKind::performed_by:
      case EdgeKind::same_behavior:
        attributes.add("dir", "none");
        break;
      case EdgeKind::requirement:
        attributes.add("style", "dashed");
        color = palette::requirement;
        break;
      case EdgeKind::exclusion:
        attributes.add("dir", "none");
        attributes.add("style", "dotted");
        attributes.add("penwidth", is_thick ? "2.5" : "1.5");
        if (!is_hub(edge.from)) attributes.add("constraint", "false");
        color = palette::exclusion;
        break;
    }
    if (look) color = look->color.line;
    if (is_thick && edge.kind != EdgeKind::exclusion) attributes.add("penwidth", "2");
    attributes.add_color("color", color);
    if (!edge.label.empty()) attributes.add_color("fontcolor", color);
    dot_ += "  ";
    append_dot_id(dot_, diagram_.nodes[edge.from].id);
    dot_ += " -> ";
    append_dot_id(dot_, diagram_.nodes[edge.to].id);
    dot_ += attributes.end();
  }

  [[nodiscard]] bool is_hub(std::uint32_t node) const {
    return diagram_.nodes[node].kind == NodeKind::hub;
  }

  const draw::Diagram& diagram_;
  std::string dot_;
};

}  // namespace

std::string graph_dot(const draw::Diagram& diagram) { return DotWriter(diagram).run(); }

namespace {

using draw::Edge;
using draw::EdgeKind;
using draw::Mark;
using draw::Node;
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

std::string class_of_group(std::size_t group) {
  return "group" + std::to_string(group % palette::groups.size());
}

std::string class_of(const Node& node) {
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
    for (const Node& node : diagram_.nodes) {
      if (node.cluster == none) add_node(node, "  ");
    }
    const auto members = draw::cluster_members(diagram_);
    for (std::size_t place = 0; place < members.size(); ++place) {
      text_ += "  subgraph ";
      append_mermaid_id(text_, diagram_.clusters[place].id);
      text_ += "[\"";
      append_mermaid_label(text_, diagram_.clusters[place].label);
      text_ += "\"]\n";
      for (const Node* const node : members[place]) add_node(*node, "    ");
      text_ += "  end\n";
    }
  }

  void add_node(const Node& node, std::string_view indent) {
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

  void add_text(std::string_view open, const Node& node, std::string_view close) {
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
    for (const Node& node : diagram_.nodes) used.insert(class_of(node));
    const auto add = [&](std::string_view name, const palette::Look& look) {
      if (used.contains(std::string(name))) add_class(name, look);
    };
    add("task", {palette::task, palette::ink});
    add("behavior", {palette::behavior, palette::ink});
    add("hub", {{palette::exclusion, palette::exclusion}, palette::paper});
    add("faint", *palette::look_of(Mark::faint));
    for (const Mark mark : standing_out) add(name_of(mark), *palette::look_of(mark));
    palette::Look undefined = *palette::look_of(Mark::faulty);
    undefined.is_dashed = true;
    add("undefined", undefined);
    for (std::uint32_t group = 0; group < palette::groups.size(); ++group) {
      add(class_of_group(group), {palette::groups[group], palette::ink});
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
