#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cbc/units.h"
#include "graph/engine/catalog_graph.h"
#include "runtime/compiled/compiled_catalog.h"

/// A picture as data: what is drawn, apart from the format it is written in.
namespace cbc::draw {

enum class View : std::uint8_t { full, tasks, constraints, behaviors };

enum class NodeKind : std::uint8_t {
  task,
  behavior,
  hub  ///< an exclusivity list, joined by lines with its tasks
};

enum class EdgeKind : std::uint8_t {
  performed_by,   ///< from a task to a behavior
  requirement,    ///< from what requires to what is required
  exclusion,      ///< without a direction
  same_behavior,  ///< between tasks that one behavior performs; without a direction
};

struct Node {
  NodeKind kind = NodeKind::task;
  std::string id;            ///< unique, from the name
  std::string_view name;     ///< as in the catalog; may be empty
  std::string_view package;  ///< of a task: that of all its behaviors, if they share one
  std::vector<NamedCondition> situation;  ///< of a behavior: in which it fits
  std::uint32_t group = none;
  Millionths minimum_performance = 0;    ///< 0: none
  std::optional<std::int32_t> priority;  ///< of a task: of its request, in a state
  std::uint32_t left_out = 0;            ///< of a hub: tasks of the list that are not drawn
  std::uint32_t at_most = 1;             ///< of a hub: how many tasks of the list may run
  std::string label;                     ///< on one line, fit to be shown
  std::vector<std::string> notes;        ///< each on a line below
  Mark mark = Mark::plain;
  bool is_defined = true;
  std::uint32_t color = none;    ///< number of a color; none: that of the kind
  std::uint32_t cluster = none;  ///< in Diagram::clusters
};

struct Edge {
  EdgeKind kind = EdgeKind::performed_by;
  std::uint32_t from = 0;  ///< in Diagram::nodes
  std::uint32_t to = 0;
  std::optional<Millionths> degree;  ///< the suitability, the minimum performance
  std::string label;
  Mark mark = Mark::plain;
};

/// Nodes in a common frame.
struct Cluster {
  std::string id;
  std::string label;
};

/// What is framed; a group of one node needs no frame.
enum class Clustering : std::uint8_t {
  nothing,
  packages,  ///< their behaviors, and the tasks that nothing else performs
  groups
};

/// A line of a legend: something as it is drawn, or a text beside it, and what it means.
struct LegendEntry {
  enum class Frame : std::uint8_t { package };
  std::variant<NodeKind, EdgeKind, Mark, Frame, std::string> sample;
  std::string meaning;
};

/// The moment whose state a picture shows.
struct Moment {
  std::string script;       ///< its file
  std::uint64_t index = 0;  ///< of the last event; 0: none yet
  Microseconds time = 0;    ///< of this event
  std::string event;        ///< the event and its outcome: "start HOVER, priority 2: accepted"
  std::string situation;    ///< the values of all variables: "TARGET is near, GPS is true"
};

struct Diagram {
  View view = View::full;
  std::string_view file;
  std::optional<Moment> moment;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<Cluster> clusters;
  Clustering clustering = Clustering::nothing;
  std::vector<LegendEntry> legend;  ///< empty: none
};

/// The tasks and behaviors of a catalog that are drawn.
struct Part {
  std::vector<std::uint32_t> tasks;      ///< ascending
  std::vector<std::uint32_t> behaviors;  ///< ascending
  std::vector<bool> has_task;            ///< by task of the catalog
  std::vector<bool> has_behavior;
  std::vector<bool> is_beside;  ///< by task: drawn only because of a neighbor
  std::vector<bool> is_named;   ///< by task: it was asked for
};

[[nodiscard]] Part whole(const CatalogGraph& graph);

[[nodiscard]] Part part_of_group(const CatalogGraph& graph, std::uint32_t group);

/// How far a part extends from the tasks that were asked for.
struct Reach {
  bool up = true;                      ///< to what requires them
  bool down = true;                    ///< to what they require
  std::optional<std::uint32_t> depth;  ///< in steps from task to task; empty: to the end
};

/// Some tasks, their behaviors, and what requires them or is required by them. A few more tasks
/// stand beside these, without their own neighbors: those that the tasks asked for exclude, unless
/// they are many, and those that a behavior also performs.
[[nodiscard]] Part part_around(const CatalogGraph& graph, const std::vector<std::uint32_t>& tasks,
                               const Reach& reach);

/// How the lists of tasks of which at most one runs are drawn.
enum class ExclusivityStyle : std::uint8_t {
  readable,  ///< short lists as pairs, others as hubs
  pairs,     ///< a line between each two
  hubs,      ///< a node for each list of more than two tasks, and a line to each of them
  hidden
};

struct ViewOptions {
  View view = View::full;
  std::optional<ExclusivityStyle> exclusivity;  ///< empty: the one that suits the view
  std::optional<Clustering> clustering;         ///< the same
  bool reduce = false;  ///< in View::tasks: leave out requirements that follow from others
};

/// The picture of a part of a catalog. `graph`, and what it was made of, must outlive it.
[[nodiscard]] Diagram make_diagram(const CatalogGraph& graph, const Part& part,
                                   const ViewOptions& options);

/// Adds a legend: what the picture has of shapes, lines, colors and signs, and nothing else.
void add_legend(Diagram& diagram);

/// The id of a node from its name: "task:HOVER". Different names have different ids, which are
/// valid UTF-8 without control characters and without '#', so that a number may follow after one.
[[nodiscard]] std::string id_of(std::string_view kind, std::string_view name);

/// A name as it is shown: in quotes if it could be overlooked.
[[nodiscard]] std::string label_of(std::string_view name);

/// "≥ 80 %"
[[nodiscard]] std::string at_least(Millionths degree);

/// The label of a line: the suitability, unless it is 100 %, or the minimum performance, and how it
/// differs between two catalogs.
[[nodiscard]] std::string label_of(const CatalogGraph::Performance& performance);
[[nodiscard]] std::string label_of(const CatalogGraph::Requirement& requirement);

/// The lines above a picture of a state: "mission.yaml, after event 3 at 4.5 s", the event, and the
/// situation.
[[nodiscard]] std::vector<std::string> caption_of(const Moment& moment);

/// "+" for what is added, "−" if it is removed, "~" changed, "▶" started, "■" stopped; else empty.
[[nodiscard]] std::string_view sign_of(Mark mark);

/// The label of a line with the sign of its mark: "▶ 90 %".
[[nodiscard]] std::string with_sign(Mark mark, std::string label);

/// The nodes of each cluster, in their order.
[[nodiscard]] std::vector<std::vector<const Node*>> cluster_members(const Diagram& diagram);

}  // namespace cbc::draw
