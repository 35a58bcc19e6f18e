#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "draw/catalog_graph.h"

/// A picture as data: what is drawn, apart from the format it is written in.
namespace cbc::draw {

enum class View : std::uint8_t { full, tasks, constraints, behaviors };

enum class NodeKind : std::uint8_t {
  task,
  behavior,
  hub  ///< an exclusivity list, with a line to each of its tasks
};

enum class EdgeKind : std::uint8_t {
  performed_by,   ///< from a task to a behavior
  requirement,    ///< to what is required
  exclusion,      ///< without a direction
  same_behavior,  ///< between tasks that one behavior performs; without a direction
};

struct Node {
  NodeKind kind = NodeKind::task;
  std::string id;         ///< unique, from the name
  std::string_view name;  ///< as in the catalog; empty: it has none
  std::string_view package;
  std::uint32_t group = none;
  Millionths minimum_performance = 0;    ///< 0: none
  std::optional<std::int32_t> priority;  ///< of a task: of its request, in a state
  std::uint32_t left_out = 0;            ///< of a hub: tasks of the list that are not drawn
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

/// When the state was that a picture shows.
struct Moment {
  std::string script;       ///< its file
  std::uint64_t index = 0;  ///< of the last event; 0: none yet
  Microseconds time = 0;    ///< of this event
  std::string event;  ///< what it was and what came of it: "start HOVER, priority 2: accepted"
};

struct Diagram {
  View view = View::full;
  std::string_view file;
  std::optional<Moment> moment;
  std::vector<Node> nodes;
  std::vector<Edge> edges;
  std::vector<Cluster> clusters;
};

/// The tasks and behaviors of a catalog that are drawn.
struct Part {
  std::vector<std::uint32_t> tasks;      ///< ascending
  std::vector<std::uint32_t> behaviors;  ///< ascending
  std::vector<bool> has_task;            ///< by task of the catalog
  std::vector<bool> has_behavior;
  std::vector<bool> is_beside;  ///< by task: it is only drawn because of one beside it
  std::vector<bool> is_named;   ///< by task: it was asked for
};

[[nodiscard]] Part whole(const CatalogGraph& graph);

[[nodiscard]] Part part_of_group(const CatalogGraph& graph, std::uint32_t group);

/// How far to go from the tasks that were asked for.
struct Reach {
  bool up = true;                      ///< to what requires them
  bool down = true;                    ///< to what they require
  std::optional<std::uint32_t> depth;  ///< in steps from task to task; empty: to the end
};

/// Some tasks, their behaviors, and what requires them or is required by them. A few tasks stand
/// beside those, without what belongs to them: those that the tasks asked for exclude, unless these
/// are many, and those that a behavior also performs.
[[nodiscard]] Part part_around(const CatalogGraph& graph, const std::vector<std::uint32_t>& tasks,
                               const Reach& reach);

/// How the lists of tasks of which at most one runs are drawn.
enum class ExclusivityStyle : std::uint8_t {
  readable,  ///< short lists as pairs, others as hubs
  pairs,     ///< a line between each two
  hubs,      ///< a node for each list of more than two tasks, and a line to each of them
  hidden
};

/// What frames are drawn around; a group of one node needs none.
enum class Clustering : std::uint8_t { nothing, packages, groups };

struct ViewOptions {
  View view = View::full;
  std::optional<ExclusivityStyle> exclusivity;  ///< empty: what suits the view
  std::optional<Clustering> clustering;         ///< the same
  bool reduce = false;  ///< in View::tasks: leave out requirements that follow from others
};

/// The picture of a part of a catalog. `graph`, and what it was made of, must outlive it.
[[nodiscard]] Diagram make_diagram(const CatalogGraph& graph, const Part& part,
                                   const ViewOptions& options);

/// Adds a key to the kinds of nodes and edges that a picture has.
void add_legend(Diagram& diagram);

/// The id of what has this name: "task:HOVER". Different names have different ids; these are valid
/// UTF-8, without control characters, and without '#', which is free for numbers behind them.
[[nodiscard]] std::string id_of(std::string_view kind, std::string_view name);

/// A name as it is shown. One that could be overlooked stands in quotes.
[[nodiscard]] std::string label_of(std::string_view name);

/// "≥ 80 %"
[[nodiscard]] std::string at_least(Millionths degree);

/// What stands at a line: the suitability, unless it is 100 %; the minimum performance. Of two
/// catalogs, what has changed.
[[nodiscard]] std::string label_of(const CatalogGraph::Performance& performance);
[[nodiscard]] std::string label_of(const CatalogGraph::Requirement& requirement);

/// The lines above a picture of a state: "mission.yaml, after event 3 at 4.5 s", and the event.
[[nodiscard]] std::vector<std::string> caption_of(const Moment& moment);

/// The label of a line with a sign for its mark: "+ 90 %" if it is added or started, "− 90 %" if it
/// is removed or stopped, "~ 90 %" if it is changed.
[[nodiscard]] std::string with_sign(Mark mark, std::string label);

/// Makes the nodes of a picture, which the views connect.
class Builder {
 public:
  Builder(const CatalogGraph& graph, const Part& part, const ViewOptions& options);

  /// A node for each task, each behavior of the part.
  void add_tasks();
  void add_behaviors();

  /// The lists of tasks of which at most one runs, between the tasks or, if these are not drawn,
  /// between their behaviors.
  void add_exclusions(ExclusivityStyle style);

  /// `from` and `to` are nodes. Returns the edge, whose label has the sign of the mark, and which
  /// is faint beside something faint.
  Edge& add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, Mark mark = Mark::plain);

  [[nodiscard]] const CatalogGraph& graph() const { return graph_; }
  [[nodiscard]] const Part& part() const { return part_; }
  [[nodiscard]] Diagram& diagram() { return diagram_; }
  /// The node of a task, a behavior of the part.
  [[nodiscard]] std::uint32_t node_of_task(std::uint32_t task) const { return task_nodes_[task]; }
  [[nodiscard]] std::uint32_t node_of_behavior(std::uint32_t behavior) const {
    return behavior_nodes_[behavior];
  }

  /// Puts the nodes into clusters.
  void add_clusters(Clustering clustering);

 private:
  /// A task of a list of exclusive tasks: its node, or those of its behaviors.
  struct Member {
    std::vector<std::uint32_t> nodes;
    Mark mark = Mark::plain;
  };

  void add_node(Node node);
  [[nodiscard]] std::string unique_id(const std::string& id);
  [[nodiscard]] std::vector<std::uint32_t> nodes_of_exclusion(std::uint32_t task) const;
  [[nodiscard]] std::vector<Member> members_of(std::uint32_t list) const;
  void add_hub(std::uint32_t list, const std::vector<Member>& members);

  const CatalogGraph& graph_;
  const Part& part_;
  Diagram diagram_;
  std::vector<std::uint32_t> task_nodes_;      ///< by task; none: not drawn
  std::vector<std::uint32_t> behavior_nodes_;  ///< by behavior; the same
  std::map<std::string, std::uint32_t> uses_of_id_;
};

// The views; each fills an empty picture.
void draw_full_view(Builder& builder);
void draw_task_view(Builder& builder, bool reduce);
void draw_constraint_view(Builder& builder);
void draw_behavior_view(Builder& builder);

/// The nodes of each cluster, in their order.
[[nodiscard]] std::vector<std::vector<const Node*>> cluster_members(const Diagram& diagram);

/// That behaviors of one task require another one.
struct TaskRequirement {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t behaviors = 0;  ///< of `from` in the part; of two catalogs, of the newer one
  std::uint32_t requiring = 0;  ///< how many of these require `to`
  Millionths lowest = 0;        ///< of the minimum performances that they ask for; 0: none
  Millionths highest = 0;
  Mark mark = Mark::plain;
};

/// All of them between tasks of a part, by `from`, then by `to`.
[[nodiscard]] std::vector<TaskRequirement> task_requirements(const CatalogGraph& graph,
                                                             const Part& part);

}  // namespace cbc::draw
