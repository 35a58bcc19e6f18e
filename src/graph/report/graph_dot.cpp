#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

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

constexpr std::size_t line_length = 10;  // characters, about

/// A quoted string of DOT. Only the quote itself needs a backslash; in labels, backslashes and
/// ampersands must be escaped as well.
std::string dot_id(std::string_view id) {
  std::string dot = "\"";
  for (const char character : id) {
    if (character == '"') dot += '\\';
    dot += character;
  }
  return dot + '"';
}

std::string shown(std::string_view text) {
  std::string dot;
  for (const char character : text) {
    if (character == '"' || character == '\\') dot += '\\';
    dot += character;
    if (character == '&') dot += "amp;";
  }
  return dot;
}

/// The attributes of a node or an edge: "[a=b, c=d]", or nothing.
class DotAttributes {
 public:
  void add(std::string_view name, std::string_view value) {
    text_ += fmt::format("{}{}={}", text_.empty() ? " [" : ", ", name, value);
  }
  void add_color(std::string_view name, std::string_view color) {
    add(name, fmt::format("\"{}\"", color));
  }
  void add_label(std::string_view text) { add("label", fmt::format("\"{}\"", shown(text))); }
  /// Long names are broken into lines, since pictures tend to be wide rather than high.
  void add_label(const draw::Node& node) {
    std::vector<std::string_view> lines = wrap_name(node.label, line_length);
    lines.insert(lines.end(), node.notes.begin(), node.notes.end());
    add("label", fmt::format("\"{}\"", join(lines, "\\n", shown)));
  }
  [[nodiscard]] std::string end() const { return text_.empty() ? ";\n" : text_ + "];\n"; }

 private:
  std::string text_;
};

/// A small framed box, as a table of DOT's labels.
std::string swatch(palette::Color color, std::string_view style, std::string_view sign = " ") {
  return fmt::format(
      R"(<table border="1" cellborder="0" cellpadding="0" cellspacing="0" style="{}" color="{}" )"
      R"(bgcolor="{}"><tr><td width="22" height="8"><font point-size="6">{}</font></td></tr></table>)",
      style, color.line, color.fill, sign.empty() ? " " : sign);
}

std::string colored(std::string_view text, std::string_view color) {
  return fmt::format(R"(<font color="{}">{}</font>)", color, text);
}

/// What a legend shows of shapes, lines and marks.
struct Sample {
  std::string operator()(NodeKind kind) const {
    switch (kind) {
      case NodeKind::task:
        return swatch(palette::task, "rounded");
      case NodeKind::behavior:
        return swatch(palette::behavior, "solid");
      case NodeKind::hub:
        break;
    }
    return colored("●····", palette::exclusion);
  }
  std::string operator()(EdgeKind kind) const {
    switch (kind) {
      case EdgeKind::performed_by:
      case EdgeKind::same_behavior:
        break;
      case EdgeKind::requirement:
        return colored("– –▸", palette::requirement);
      case EdgeKind::exclusion:
        return colored("·····", palette::exclusion);
    }
    return "——";
  }
  std::string operator()(Mark mark) const {
    const std::optional<palette::Look> look = palette::look_of(mark);
    const std::string style = look->is_dashed ? "dashed" : "solid";
    return swatch(look->color, style, sign_of(mark));
  }
  std::string operator()(LegendEntry::Frame) const {
    return swatch({palette::frame, palette::framed}, "rounded");
  }
  std::string operator()(const std::string& text) const { return text; }
};

class DotWriter {
 public:
  explicit DotWriter(const draw::Diagram& diagram) : diagram_(diagram) {}

  std::string run() && {
    dot_ = fmt::format("digraph {} {{\n", dot_id(draw::id_of("catalog", diagram_.file)));
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
    if (!diagram_.legend.empty()) add_legend();
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
    dot_ += fmt::format("  labelloc=t; label=\"{}\";\n",
                        join(draw::caption_of(*diagram_.moment), "\\n", shown));
  }

  /// One node: nodes and edges as samples would be spread over the columns of the picture.
  void add_legend() {
    dot_ +=
        "  \"legend\" [shape=plain, style=\"\", fontsize=9, label=<<table border=\"1\" "
        "cellborder=\"0\" cellspacing=\"2\" cellpadding=\"1\" color=\"" +
        std::string(palette::frame) + "\">\n";
    for (const LegendEntry& entry : diagram_.legend) {
      dot_ += fmt::format("    <tr><td>{}</td><td align=\"left\">{}</td></tr>\n",
                          std::visit(Sample(), entry.sample), entry.meaning);
    }
    dot_ += "  </table>>];\n";
  }

  void add_nodes() {
    for (const draw::Node& node : diagram_.nodes) {
      if (node.cluster == none) add_node(node, "  ");
    }
    const auto members = draw::cluster_members(diagram_);
    for (std::size_t place = 0; place < members.size(); ++place) {
      const draw::Cluster& cluster = diagram_.clusters[place];
      dot_ += fmt::format(
          "  subgraph {} {{\n    label=\"{}\"; labeljust=l; style=\"rounded,filled\"; "
          "color=\"{}\"; fillcolor=\"{}\";\n",
          dot_id(cluster.id), shown(cluster.label), palette::frame, palette::framed);
      for (const draw::Node* const node : members[place]) add_node(*node, "    ");
      dot_ += "  }\n";
    }
  }

  void add_node(const draw::Node& node, std::string_view indent) {
    DotAttributes attributes;
    if (node.kind == NodeKind::hub) {
      add_hub(node, attributes);
    } else {
      add_shape(node, attributes);
    }
    dot_ += fmt::format("{}{}{}", indent, dot_id(node.id), attributes.end());
  }

  /// A dot, or a box if it has a label. (An xlabel beside a dot does not work with pack.)
  static void add_hub(const draw::Node& node, DotAttributes& attributes) {
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

  static void add_shape(const draw::Node& node, DotAttributes& attributes) {
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
    DotAttributes attributes;
    if (!edge.label.empty()) attributes.add_label(edge.label);
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
    dot_ += fmt::format("  {} -> {}{}", dot_id(diagram_.nodes[edge.from].id),
                        dot_id(diagram_.nodes[edge.to].id), attributes.end());
  }

  [[nodiscard]] bool is_hub(std::uint32_t node) const {
    return diagram_.nodes[node].kind == NodeKind::hub;
  }

  const draw::Diagram& diagram_;
  std::string dot_;
};

}  // namespace

std::string graph_dot(const draw::Diagram& diagram) { return DotWriter(diagram).run(); }

}  // namespace cbc
