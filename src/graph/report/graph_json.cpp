#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/compile/catalog_json.h"
#include "core/support/json.h"
#include "core/support/json_description.h"
#include "core/words/words.h"
#include "graph/report/graph_report.h"
#include "runtime/base/text.h"
#include "versions/difference/catalog_diff.h"
#include "versions/difference/catalog_facts.h"

namespace cbc {
namespace draw {

static std::string_view name_of(View view) {
  constexpr std::string_view names[] = {"full", "tasks", "constraints", "behaviors"};
  return names[static_cast<std::size_t>(view)];
}

static std::string_view name_of(NodeKind kind) {
  constexpr std::string_view names[] = {"task", "behavior", "hub"};
  return names[static_cast<std::size_t>(kind)];
}

static std::string_view name_of(EdgeKind kind) {
  constexpr std::string_view names[] = {"performed_by", "requirement", "exclusion",
                                        "same_behavior"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace draw

namespace json::graph {

using draw::Edge;
using draw::EdgeKind;
using draw::Mark;
using draw::Moment;
using draw::Node;
using draw::NodeKind;

/// A node or an edge; the drawing is the context.
constexpr auto mark = named("mark",
                            "How it is highlighted: the catalog has an error there; or, in a "
                            "state, it is in use both before "
                            "and after the last event, only after it, only before it, or it is a "
                            "behavior that could not be "
                            "activated. null: not highlighted.",
                            nullable(words_among({Mark::faulty, Mark::active, Mark::started,
                                                  Mark::stopped, Mark::unavailable})));

constexpr auto mark_of = [](const auto& of) {
  return name_of(of.mark).empty() ? std::nullopt : std::optional(of.mark);
};

constexpr auto id = named("id", "Unique among the nodes, derived from the name.",
                          matching("^(task|behavior|exclusivity):"));

constexpr auto state = object(
    "state", "The state that is drawn, if a script was run (--script).",
    member("script", any_text, "The script, as given.", &Moment::script),
    member("index", count, "Index of the last event, as in cbc.solve/1; 0: none yet.",
           &Moment::index),
    member("time", nullable(seconds), "Time of the last event in seconds; null: none yet.",
           [](const Moment& of) { return of.index == 0 ? nullptr : &of.time; }),
    member("event", nullable(text), "The last event and its outcome; null: none yet.",
           [](const Moment& of) { return of.index == 0 ? nullptr : &of.event; }),
    optional("situation", text,
             "The values of all situation variables, if the catalog has any: \"TARGET is near, GPS "
             "is true\".",
             [](const Moment& of) { return of.situation.empty() ? nullptr : &of.situation; }));

constexpr auto name_of_node = [](const Node& node) { return node.name; };

constexpr auto group_of_node = member(
    "group", nullable(count),
    "The group of tasks that constraints connect, as in `search` of cbc.solve/1; null: not in "
    "a group.",
    [](const Node& node) { return node.group == none ? nullptr : &node.group; });

constexpr auto node = variants(
    "node", "", group(member("id", id, "", &Node::id)), "kind", &Node::kind,
    group(member("mark", mark, "", mark_of),
          member("notes", texts, "Other text in the drawing, line by line.", &Node::notes)),
    variant(
        {NodeKind::task}, "", member("name", text, "", name_of_node), group_of_node,
        member("minimum_performance", nullable(percent), "In percent; null: none.",
               [](const Node& of) {
                 return of.minimum_performance > 0 ? &of.minimum_performance : nullptr;
               }),
        member("defined", boolean, "false: the task is named but not defined, which is an error.",
               &Node::is_defined),
        optional("priority", nullable(priority),
                 "Only in a state: the priority of its request, or 0 if it started by itself; "
                 "null: neither.",
                 [](const Node& of, const draw::Diagram& diagram) {
                   return of.priority || diagram.moment ? &of.priority : nullptr;
                 })),
    variant({NodeKind::behavior}, "",
            member("name", nullable(text), "null: the name is missing, which is an error.",
                   [](const Node& of) { return of.name.empty() ? nullptr : &of.name; }),
            group_of_node,
            member("package", any_text, "The package; empty if none is given.", &Node::package),
            optional("situation", conditions,
                     "Only if it names situation variables: the values of each in which it fits; "
                     "true and false for a variable that is declared without values.",
                     [](const Node& of) {
                       return of.situation.empty() ? std::nullopt
                                                   : std::optional(by_variable(of.situation));
                     })),
    variant({NodeKind::hub},
            "A list of tasks that exclude one another, or of which so many may run, with an edge "
            "to each of them.",
            member("name", null, "", name_of_node), group_of_node,
            member("left_out", count, "Number of tasks in the list that are not drawn.",
                   &Node::left_out),
            optional("at_most", integer(2), "How many of the tasks may run, where not one.",
                     [](const Node& of) {
                       return of.at_most > 1 ? std::optional(of.at_most) : std::nullopt;
                     })));

constexpr auto ends =
    group(member(
              "from", id, "", [](const Edge& of, const draw::Diagram& diagram) -> const auto& {
                return diagram.nodes[of.from].id;
              }),
          member(
              "to", id, "", [](const Edge& of, const draw::Diagram& diagram) -> const auto& {
                return diagram.nodes[of.to].id;
              }));

constexpr auto edge = variants(
    "edge", "", group(), "kind", &Edge::kind, group(member("mark", mark, "", mark_of)),
    variant({EdgeKind::performed_by}, "From a task to a behavior that performs it.", ends,
            member("suitability", percent, "Suitability in percent.",
                   [](const Edge& of) { return of.degree.value_or(0); })),
    variant(
        {EdgeKind::requirement}, "To a task that is required.", ends,
        member("minimum_performance", nullable(percent),
               "Minimum performance in percent; null: none. In the view `tasks`, the highest of "
               "all behaviors.",
               &Edge::degree)),
    variant({EdgeKind::exclusion, EdgeKind::same_behavior},
            "exclusion: between two tasks that exclude one another, or from a hub to one of its "
            "tasks. same_behavior: between tasks that one behavior performs.",
            ends));

constexpr auto report = object(
    "",
    "The output of `cbc graph --format json` (schema cbc.graph/1): a drawing of a catalog without "
    "positions and colors. A catalog with errors is included as far as it can be understood.",
    schema_member("cbc.graph/1"),
    member("catalog", any_text, "The catalog, as given.", &draw::Diagram::file),
    member("view", words(draw::View::behaviors),
           "The view: everything, what tasks require, which constraints connect tasks, or what "
           "behaviors require.",
           &draw::Diagram::view),
    optional("state", state, "", &draw::Diagram::moment),
    member("nodes", list(node).on_lines(),
           "Tasks, behaviors, and lists of tasks that exclude one another.", &draw::Diagram::nodes),
    member("edges", list(edge).on_lines(), "The edges between nodes, which they refer to by id.",
           &draw::Diagram::edges));

}  // namespace json::graph

std::string graph_json(const draw::Diagram& diagram) {
  return json::document(json::graph::report, diagram, diagram);
}

std::string graph_schema() {
  return json::schema("graph", "Output of cbc graph", json::graph::report);
}

namespace {

using ChangeKind = CatalogChange::Kind;
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
    case ChangeSubject::limit:
      return "list of " + task;
    case ChangeSubject::exclusion:
      return task + " excludes " + printable(change.other_task);
  }
  return {};
}

/// For a new task, behavior or variable the name is enough, and in which situations it matters; its
/// other attributes are in the catalog.
bool is_told(const CatalogChange& change, const AttributeChange& attribute) {
  if (change.kind == ChangeKind::changed) return true;
  switch (change.subject) {
    case ChangeSubject::task:
      return false;
    case ChangeSubject::behavior:
      return attribute.name.starts_with(condition_prefix);
    case ChangeSubject::variable:
      return attribute.name == "values";
    default:
      return true;
  }
}

}  // namespace

std::string diff_text(const CatalogDiff& diff, const Style& style) {
  std::string text;
  for (const NewName& name : diff.renamed) {
    const std::string_view kind =
        name.subject == ChangeSubject::variable ? "situation variable" : name_of(name.subject);
    text += style.paint(style.warning, fmt::format("~ {} {} renamed to {}", kind,
                                                   printable(name.before), printable(name.after))) +
            "\n";
  }
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
    for (const AttributeChange& attribute : change.attributes) {
      if (!is_told(change, attribute)) continue;
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

std::string fitting_text(const std::vector<FittingChange>& changes, const Style& style) {
  std::string text;
  for (const FittingChange& change : changes) {
    const std::string line =
        fmt::format("~ {} in {} {}: {} -> {}", printable(change.task), printable(change.variable),
                    printable(change.value), change.before, change.after);
    text += style.paint(style.warning, line) + "\n";
  }
  return text;
}

namespace json::diff {

/// What type the value has depends on the attribute.
struct Setting {
  void write(JsonWriter& json, const AttributeValue& value, NoContext /*context*/) const {
    if (const bool* const truth = std::get_if<bool>(&value)) return json.put(*truth);
    if (const auto* const degree = std::get_if<Millionths>(&value)) {
      return json.put(in_percent(*degree));
    }
    if (const auto* const time = std::get_if<Microseconds>(&value)) {
      return json.put(to_seconds(*time));
    }
    if (const auto* const text = std::get_if<std::string>(&value)) return json.put(*text);
    json.put(nullptr);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_list("type", std::array{"boolean", "number", "string", "null"});
  }
};

constexpr auto attribute =
    object(
        "attribute",
        "`before` is the value in the older catalog, `after` the value in the newer one; null if "
        "not set.",
        member("name", text,
               "suitability, minimum_performance: in percent. timeout: in seconds. `parameter "
               "NAME`: the allowed values of a parameter of a task, empty if any value is "
               "allowed. reactive_priority and at_most are texts, too. values, initial value: of a "
               "situation variable, null if it is declared without any. `situation NAME`: the "
               "values of a situation variable in which a "
               "behavior fits; true or false for a variable that is declared without values.",
               &AttributeChange::name),
        member("before", Setting(), "", &AttributeChange::before),
        member("after", Setting(), "", &AttributeChange::after))
        .related(R"json([{"oneOf": [
          {"properties": {"name": {"enum": ["suitability", "minimum_performance", "timeout"]},
                          "before": {"type": ["number", "null"], "minimum": 0},
                          "after": {"type": ["number", "null"], "minimum": 0}}},
          {"properties": {"name": {"enum": ["reactive_start", "start_on_request", "requestable",
                                            "resume"]},
                          "before": {"type": ["boolean", "null"]},
                          "after": {"type": ["boolean", "null"]}}},
          {"properties": {"name": {"const": "execution_goal"},
                          "before": {"enum": ["achieve_goal", "keep_running", null]},
                          "after": {"enum": ["achieve_goal", "keep_running", null]}}},
          {"properties": {"name": {"type": "string",
                                   "pattern": "^(package$|parameter |values$|initial value$|reactive_priority$|improve$|retry$|at_most$)"},
                          "before": {"type": ["string", "null"]},
                          "after": {"type": ["string", "null"]}}},
          {"properties": {"name": {"type": "string", "pattern": "^situation "},
                          "before": {"type": ["string", "boolean", "null"]},
                          "after": {"type": ["string", "boolean", "null"]}}}]}])json");

constexpr auto kind =
    member("kind",
           named("kind",
                 "removed: only the older catalog has it. added: only the newer one has it. "
                 "changed: both have it, with different attributes.",
                 words(ChangeKind::changed)),
           "", &CatalogChange::kind);
constexpr auto task = member("task", text, "", &CatalogChange::task);
constexpr auto behavior = member("behavior", text, "", &CatalogChange::behavior);

constexpr auto change =
    variants(
        "change", "", group(kind), "subject", &CatalogChange::subject,
        group(member("attributes", list(attribute),
                     "For `changed`, the attributes that differ; otherwise those that are set.",
                     &CatalogChange::attributes)),
        variant({ChangeSubject::task}, "", task), variant({ChangeSubject::behavior}, "", behavior),
        variant({ChangeSubject::performs, ChangeSubject::requirement},
                "A behavior performs or requires a task.", behavior, task),
        variant({ChangeSubject::variable}, "",
                member("variable", text, "", &CatalogChange::variable)),
        variant({ChangeSubject::limit}, "A list of tasks of which several may run.",
                member("tasks", text, "Their names in order, with ', ' between them.",
                       &CatalogChange::task)),
        variant(
            {ChangeSubject::exclusion},
            "Two tasks exclude one another; `other_task` comes after `task` in the order of names. "
            "They have no attributes.",
            task, member("other_task", text, "", &CatalogChange::other_task)))
        .related(R"json([
          {"if": {"properties": {"kind": {"const": "changed"}}},
           "then": {"properties": {"subject": {"not": {"const": "exclusion"}},
                                   "attributes": {"type": "array", "minItems": 1}}}},
          {"if": {"properties": {"subject": {"const": "exclusion"}}},
           "then": {"properties": {"attributes": {"type": "array", "maxItems": 0}}}}])json");

/// The two files, and how they differ.
struct Report {
  const CatalogDiff& diff;
  std::string_view before;
  std::string_view after;
};

constexpr auto report =
    object("",
           "The output of `cbc graph --diff OLD NEW --format json` (schema cbc.diff/1): the "
           "differences in meaning between the catalogs, ordered by subject and then by name.",
           schema_member("cbc.diff/1"),
           member("old", text, "The older catalog, as given.", &Report::before),
           member("new", text, "The newer catalog, as given.", &Report::after),
           member(
               "changes", list(change), "",
               [](const Report& of) -> const auto& { return of.diff.changes; }),
           member("further_exclusions", count,
                  "How many pairs of exclusive tasks differ in addition to the 100000 listed.",
                  [](const Report& of) { return of.diff.further_exclusions; }));

}  // namespace json::diff

std::string diff_json(const CatalogDiff& diff, std::string_view before, std::string_view after) {
  return json::document(json::diff::report, json::diff::Report{diff, before, after});
}

std::string diff_schema() {
  return json::schema("diff", "Differences between two catalogs", json::diff::report);
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
