#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/report/catalog_json.h"
#include "core/report/catalog_words.h"
#include "core/support/json.h"
#include "graph/engine/catalog_diff.h"
#include "graph/report/graph_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using draw::Edge;
using draw::EdgeKind;
using draw::Mark;
using draw::NodeKind;

std::string_view name_of(draw::View view) {
  constexpr std::string_view names[] = {"full", "tasks", "constraints", "behaviors"};
  return names[static_cast<std::size_t>(view)];
}

std::string_view name_of(NodeKind kind) {
  constexpr std::string_view names[] = {"task", "behavior", "hub"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(EdgeKind kind) {
  constexpr std::string_view names[] = {"performed_by", "requirement", "exclusion",
                                        "same_behavior"};
  return names[static_cast<std::size_t>(kind)];
}

void write_mark(JsonWriter& json, Mark mark) {
  const std::string_view name = name_of(mark);
  json.write("mark", name.empty() ? std::nullopt : std::optional(name));
}

void write_moment(JsonWriter& json, const draw::Moment& moment) {
  json.open("state", '{');
  json.write_members({{"script", moment.script}, {"index", moment.index}});
  if (moment.index == 0) {
    json.write_members({{"time", nullptr}, {"event", nullptr}});
  } else {
    json.write_seconds("time", moment.time);
    json.write("event", moment.event);
  }
  if (!moment.situation.empty()) json.write("situation", moment.situation);
  json.close('}');
}

void write_node(JsonWriter& json, const draw::Node& node, bool has_state) {
  json.on_new_line().open('{');
  const bool is_unnamed = node.name.empty() && node.kind != NodeKind::task;
  json.write_members({{"id", node.id}, {"kind", name_of(node.kind)}});
  json.write("name", is_unnamed ? std::nullopt : std::optional(node.name));
  json.write("group", node.group == none ? std::nullopt : std::optional(node.group));
  if (node.kind == NodeKind::behavior) {
    json.write("package", node.package);
    if (!node.situation.empty()) write_conditions(json, node.situation);
  }
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
  json.write_members({{"kind", name_of(edge.kind)},
                      {"from", diagram.nodes[edge.from].id},
                      {"to", diagram.nodes[edge.to].id}});
  if (edge.kind == EdgeKind::performed_by) json.write_percent("suitability", edge.degree);
  if (edge.kind == EdgeKind::requirement) json.write_percent("minimum_performance", edge.degree);
  write_mark(json, edge.mark);
  json.close('}');
}

}  // namespace

std::string graph_json(const draw::Diagram& diagram) {
  return json_line([&](JsonWriter& json) {
    json.write_members(
        {{"schema", "cbc.graph/1"}, {"catalog", diagram.file}, {"view", name_of(diagram.view)}});
    if (diagram.moment) write_moment(json, *diagram.moment);
    json.write_list("nodes", diagram.nodes, [&](const draw::Node& node) {
      write_node(json, node, diagram.moment.has_value());
    });
    json.write_list("edges", diagram.edges,
                    [&](const Edge& edge) { write_edge(json, diagram, edge); });
  });
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
    case ChangeSubject::variable:
      return "situation variable " + printable(change.variable);
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
    // For a new task, behavior or variable the name is enough; its attributes are in the catalog.
    const bool is_whole =
        change.kind != ChangeKind::changed &&
        (change.subject == ChangeSubject::task || change.subject == ChangeSubject::behavior ||
         change.subject == ChangeSubject::variable);
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

JsonPlain to_json(const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) return *truth;
  if (const auto* const degree = std::get_if<Millionths>(&value)) return in_percent(*degree);
  if (const auto* const time = std::get_if<Microseconds>(&value)) return to_seconds(*time);
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

void write_change(JsonWriter& json, const CatalogChange& change) {
  json.open('{');
  json.write_members({{"kind", name_of(change.kind)}, {"subject", name_of(change.subject)}});
  if (!change.behavior.empty()) json.write("behavior", change.behavior);
  if (!change.task.empty()) json.write("task", change.task);
  if (!change.variable.empty()) json.write("variable", change.variable);
  if (!change.other_task.empty()) json.write("other_task", change.other_task);
  json.write_list("attributes", change.attributes, [&](const AttributeChange& attribute) {
    json.write_object({{"name", attribute.name},
                       {"before", to_json(attribute.before)},
                       {"after", to_json(attribute.after)}});
  });
  json.close('}');
}

}  // namespace

std::string diff_json(const CatalogDiff& diff, std::string_view before, std::string_view after) {
  return json_line([&](JsonWriter& json) {
    json.write_members({{"schema", "cbc.diff/1"}, {"old", before}, {"new", after}});
    json.write_list("changes", diff.changes,
                    [&](const CatalogChange& change) { write_change(json, change); });
    json.write("further_exclusions", diff.further_exclusions);
  });
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
