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

void write_percent(JsonWriter& json, std::string_view name, std::optional<Millionths> degree) {
  if (!degree) {
    json.write_null(name);
  } else if (*degree % 10'000 == 0) {
    json.write_integer(name, *degree / 10'000);
  } else {
    json.write_number(name, static_cast<double>(*degree) / 10'000);
  }
}

void write_mark(JsonWriter& json, Mark mark) {
  if (name_of(mark).empty()) {
    json.write_null("mark");
  } else {
    json.write_text("mark", name_of(mark));
  }
}

void write_moment(JsonWriter& json, const draw::Moment& moment) {
  json.open("state", '{');
  json.write_text("script", moment.script);
  json.write_integer("index", moment.index);
  if (moment.index == 0) {
    json.write_null("time");
    json.write_null("event");
  } else {
    json.write_seconds("time", moment.time);
    json.write_text("event", moment.event);
  }
  json.close('}');
}

std::string node_to_text(const Node& node, bool has_state) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write_text("id", node.id);
  json.write_text("kind", name_of(node.kind));
  if (node.name.empty() && node.kind != NodeKind::task) {
    json.write_null("name");
  } else {
    json.write_text("name", node.name);
  }
  if (node.group == none) {
    json.write_null("group");
  } else {
    json.write_integer("group", node.group);
  }
  if (node.kind == NodeKind::behavior) json.write_text("package", node.package);
  if (node.kind == NodeKind::hub) json.write_integer("left_out", node.left_out);
  if (node.kind == NodeKind::task) {
    const Millionths minimum = node.minimum_performance;
    write_percent(json, "minimum_performance", minimum > 0 ? std::optional(minimum) : std::nullopt);
    json.write_truth("defined", node.is_defined);
    if (node.priority) {
      json.write_integer("priority", *node.priority);
    } else if (has_state) {
      json.write_null("priority");
    }
  }
  write_mark(json, node.mark);
  json.open("notes", '[');
  for (const std::string& note : node.notes) json.write_text(note);
  json.close(']');
  json.close('}');
  return text;
}

std::string edge_to_text(const draw::Diagram& diagram, const Edge& edge) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write_text("kind", name_of(edge.kind));
  json.write_text("from", diagram.nodes[edge.from].id);
  json.write_text("to", diagram.nodes[edge.to].id);
  if (edge.kind == EdgeKind::performed_by) write_percent(json, "suitability", edge.degree);
  if (edge.kind == EdgeKind::requirement) write_percent(json, "minimum_performance", edge.degree);
  write_mark(json, edge.mark);
  json.close('}');
  return text;
}

}  // namespace

std::string graph_json(const draw::Diagram& diagram) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write_text("schema", "cbc.graph/1");
  json.write_text("catalog", diagram.file);
  json.write_text("view", name_of(diagram.view));
  if (diagram.moment) write_moment(json, *diagram.moment);
  json.open("nodes", '[');
  for (const Node& node : diagram.nodes) {
    append_item(text, node_to_text(node, diagram.moment.has_value()));
  }
  json.close(']');
  json.open("edges", '[');
  for (const Edge& edge : diagram.edges) append_item(text, edge_to_text(diagram, edge));
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
    // Of a new task the name is news enough; what it is set to stands in the catalog.
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
    json.write_truth(name, *truth);
  } else if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    json.write_number(name, *degree / 10'000.0);
  } else if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    json.write_number(name, static_cast<double>(*time) / 1'000'000.0);
  } else if (const std::string* const text = std::get_if<std::string>(&value)) {
    json.write_text(name, *text);
  } else {
    json.write_null(name);
  }
}

void write_change(JsonWriter& json, const CatalogChange& change) {
  json.open('{');
  json.write_text("kind", name_of(change.kind));
  json.write_text("subject", name_of(change.subject));
  if (!change.behavior.empty()) json.write_text("behavior", change.behavior);
  if (!change.task.empty()) json.write_text("task", change.task);
  if (!change.other_task.empty()) json.write_text("other_task", change.other_task);
  json.open("attributes", '[');
  for (const AttributeChange& attribute : change.attributes) {
    json.open('{');
    json.write_text("name", attribute.name);
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
  json.write_text("schema", "cbc.diff/1");
  json.write_text("old", before);
  json.write_text("new", after);
  json.open("changes", '[');
  for (const CatalogChange& change : diff.changes) write_change(json, change);
  json.close(']');
  json.write_integer("further_exclusions", diff.further_exclusions);
  json.close('}');
  return text += '\n';
}

}  // namespace cbc
