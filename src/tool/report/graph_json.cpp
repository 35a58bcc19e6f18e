#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "diff/catalog_diff.h"
#include "report/graph_report.h"
#include "support/json.h"

namespace cbc {
namespace {

using draw::Edge;
using draw::EdgeKind;
using draw::Mark;
using draw::Node;
using draw::NodeKind;

std::string_view name_of(draw::View view) {
  switch (view) {
    case draw::View::tasks:
      return "tasks";
    case draw::View::constraints:
      return "constraints";
    case draw::View::behaviors:
      return "behaviors";
    case draw::View::full:
      break;
  }
  return "full";
}

std::string_view name_of(NodeKind kind) {
  switch (kind) {
    case NodeKind::behavior:
      return "behavior";
    case NodeKind::hub:
      return "hub";
    case NodeKind::task:
      break;
  }
  return "task";
}

std::string_view name_of(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::requirement:
      return "requirement";
    case EdgeKind::exclusion:
      return "exclusion";
    case EdgeKind::same_behavior:
      return "same_behavior";
    case EdgeKind::performed_by:
      break;
  }
  return "performed_by";
}

void write_mark(JsonWriter& json, Mark mark) {
  const std::string_view name = name_of(mark);
  json.write("mark", name.empty() ? std::nullopt : std::optional(name));
}

void write_moment(JsonWriter& json, const draw::Moment& moment) {
  json.open("state", '{');
  json.write("script", moment.script);
  json.write("index", moment.index);
  if (moment.index == 0) {
    json.write("time", nullptr);
    json.write("event", nullptr);
  } else {
    json.write_seconds("time", moment.time);
    json.write("event", moment.event);
  }
  json.close('}');
}

void write_node(JsonWriter& json, const Node& node, bool has_state) {
  json.on_new_line().open('{');
  json.write("id", node.id);
  json.write("kind", name_of(node.kind));
  const bool is_unnamed = node.name.empty() && node.kind != NodeKind::task;
  json.write("name", is_unnamed ? std::nullopt : std::optional(node.name));
  json.write("group", node.group == none ? std::nullopt : std::optional(node.group));
  if (node.kind == NodeKind::behavior) json.write("package", node.package);
  if (node.kind == NodeKind::hub) json.write("left_out", node.left_out);
  if (node.kind == NodeKind::task) {
    const Millionths minimum = node.minimum_performance;
    json.write_percent("minimum_performance", minimum > 0 ? std::optional(minimum) : std::nullopt);
    json.write("defined", node.is_defined);
    if (node.priority || has_state) json.write("priority", node.priority);
  }
  write_mark(json, node.mark);
  json.write_list("notes", node.notes);
  json.close('}');
}

void write_edge(JsonWriter& json, const draw::Diagram& diagram, const Edge& edge) {
  json.on_new_line().open('{');
  json.write("kind", name_of(edge.kind));
  json.write("from", diagram.nodes[edge.from].id);
  json.write("to", diagram.nodes[edge.to].id);
  if (edge.kind == EdgeKind::performed_by) json.write_percent("suitability", edge.degree);
  if (edge.kind == EdgeKind::requirement) json.write_percent("minimum_performance", edge.degree);
  write_mark(json, edge.mark);
  json.close('}');
}

}  // namespace

std::string graph_json(const draw::Diagram& diagram) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write("schema", "cbc.graph/1");
  json.write("catalog", diagram.file);
  json.write("view", name_of(diagram.view));
  if (diagram.moment) write_moment(json, *diagram.moment);
  json.open("nodes", '[');
  for (const Node& node : diagram.nodes) {
    write_node(json, node, diagram.moment.has_value());
  }
  json.close(']');
  json.open("edges", '[');
  for (const Edge& edge : diagram.edges) write_edge(json, diagram, edge);
  json.close(']');
  json.close('}');
  text += '\n';
  return text;
}

namespace {

using ChangeKind = CatalogChange::Kind;
using ChangeSubject = CatalogChange::Subject;

std::string describe_subject(const CatalogChange& change) {
  const std::string task = printable(change.task);
  const std::string behavior = printable(change.behavior);
  switch (change.subject) {
    case ChangeSubject::task:
      return "task " + task;
    case ChangeSubject::behavior:
      return "behavior " + behavior;
    case ChangeSubject::performs:
      return behavior + " performs " + task;
    case ChangeSubject::requirement:
      return behavior + " requires " + task;
    case ChangeSubject::exclusion:
      return task + " excludes " + printable(change.other_task);
  }
  return {};
}

}  // namespace

std::string diff_text(const CatalogDiff& diff, const Style& style) {
  std::string text;
  for (const CatalogChange& change : diff.changes) {
    std::string_view color = style.warning;
    char sign = '~';
    if (change.kind == ChangeKind::removed) {
      color = style.bad;
      sign = '-';
    } else if (change.kind == ChangeKind::added) {
      color = style.good;
      sign = '+';
    }
    std::string line = fmt::format("{} {}", sign, describe_subject(change));
    std::string_view separator = ": ";
    // For a new task or behavior the name is enough; its attributes are in the catalog.
    const bool is_whole =
        change.kind != ChangeKind::changed &&
        (change.subject == ChangeSubject::task || change.subject == ChangeSubject::behavior);
    for (const AttributeChange& attribute : change.attributes) {
      if (is_whole) break;
      line += separator;
      line += describe(change, attribute);
      separator = ", ";
    }
    text += style.paint(color, line) + "\n";
  }
  if (diff.further_exclusions > 0) {
    text += fmt::format("and {} further exclusions\n", diff.further_exclusions);
  }
  return text;
}

namespace {

void write_value(JsonWriter& json, std::string_view name, const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) {
    json.write(name, *truth);
  } else if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    json.write(name, *degree / 10'000.0);
  } else if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    json.write(name, static_cast<double>(*time) / 1'000'000.0);
  } else if (const std::string* const text = std::get_if<std::string>(&value)) {
    json.write(name, *text);
  } else {
    json.write(name, nullptr);
  }
}

void write_change(JsonWriter& json, const CatalogChange& change) {
  json.open('{');
  json.write("kind", name_of(change.kind));
  json.write("subject", name_of(change.subject));
  if (!change.behavior.empty()) json.write("behavior", change.behavior);
  if (!change.task.empty()) json.write("task", change.task);
  if (!change.other_task.empty()) json.write("other_task", change.other_task);
  json.open("attributes", '[');
  for (const AttributeChange& attribute : change.attributes) {
    json.open('{');
    json.write("name", attribute.name);
    write_value(json, "before", attribute.before);
    write_value(json, "after", attribute.after);
    json.close('}');
  }
  json.close(']');
  json.close('}');
}

}  // namespace

std::string diff_json(const CatalogDiff& diff, std::string_view before, std::string_view after) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write("schema", "cbc.diff/1");
  json.write("old", before);
  json.write("new", after);
  json.open("changes", '[');
  for (const CatalogChange& change : diff.changes) write_change(json, change);
  json.close(']');
  json.write("further_exclusions", diff.further_exclusions);
  json.close('}');
  return text += '\n';
}

std::span<const GraphFormat> graph_formats() {
  static constexpr GraphFormat formats[] = {
      {"dot", {".dot", ".gv"}, graph_dot},      {"mermaid", {".mmd", ".mermaid"}, graph_mermaid},
      {"json", {".json"}, graph_json},          {"svg", {".svg"}, graph_dot, true},
      {"png", {".png"}, graph_dot, true, true}, {"pdf", {".pdf"}, graph_dot, true, true},
  };
  return formats;
}

}  // namespace cbc
