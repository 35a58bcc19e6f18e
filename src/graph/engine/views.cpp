// The views of a catalog: how a diagram is made of a part of it.
#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/support/graph.h"
#include "graph/engine/diagram.h"
#include "runtime/base/text.h"

namespace cbc::draw {
namespace {

/// Makes the nodes of a picture; the views connect them.
class Builder {
 public:
  Builder(const CatalogGraph& graph, const Part& part, const ViewOptions& options);

  /// A node for each task, or each behavior, of the part.
  void add_tasks();
  void add_behaviors();

  /// Exclusivity lists, between tasks or, if these are not drawn, between their behaviors.
  void add_exclusions(ExclusivityStyle style);

  /// `from` and `to` are nodes. The label of the edge has the sign of its mark; an edge at a faint
  /// node is faint.
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
  /// A task of an exclusivity list: its node, or those of its behaviors.
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

std::string cluster_name(const Node& node, Clustering clustering) {
  if (clustering == Clustering::packages) return std::string(node.package);
  return node.group == none ? std::string() : "group " + std::to_string(node.group);
}

/// Empty if the behaviors of a task are of several packages.
std::string_view package_of(const CatalogGraph& graph, std::uint32_t task) {
  const auto links = graph.performances_of_task[task];
  const auto package = [&](std::uint32_t link) {
    return graph.behaviors[graph.performances[link].behavior].package;
  };
  if (links.empty()) return {};
  const bool is_shared = std::any_of(links.begin(), links.end(), [&](std::uint32_t link) {
    return package(link) != package(links.front());
  });
  return is_shared ? std::string_view() : package(links.front());
}

Builder::Builder(const CatalogGraph& graph, const Part& part, const ViewOptions& options)
    : graph_(graph),
      part_(part),
      task_nodes_(graph.tasks.size(), none),
      behavior_nodes_(graph.behaviors.size(), none) {
  diagram_.view = options.view;
  diagram_.file = graph.file;
}

std::string Builder::unique_id(const std::string& id) {
  const std::uint32_t uses = ++uses_of_id_[id];
  return uses == 1 ? id : id + "#" + std::to_string(uses);
}

void Builder::add_node(Node node) {
  node.id = unique_id(node.id);
  diagram_.nodes.push_back(std::move(node));
}

void Builder::add_tasks() {
  for (const std::uint32_t task : part_.tasks) {
    const CatalogGraph::Task& from = graph_.tasks[task];
    task_nodes_[task] = static_cast<std::uint32_t>(diagram_.nodes.size());
    Node node;
    node.kind = NodeKind::task;
    node.id = id_of("task", from.name);
    node.name = from.name;
    node.package = package_of(graph_, task);
    node.group = from.group;
    node.minimum_performance = from.minimum_performance;
    node.priority = from.priority;
    node.label = label_of(from.name);
    node.mark = from.mark == Mark::plain && part_.is_beside[task] ? Mark::faint : from.mark;
    if (from.minimum_performance > 0) node.notes.push_back(at_least(from.minimum_performance));
    if (!from.is_defined) node.notes.emplace_back("not defined");
    node.notes.insert(node.notes.end(), from.notes.begin(), from.notes.end());
    node.is_defined = from.is_defined;
    add_node(std::move(node));
  }
}

void Builder::add_behaviors() {
  for (const std::uint32_t behavior : part_.behaviors) {
    const CatalogGraph::Behavior& from = graph_.behaviors[behavior];
    behavior_nodes_[behavior] = static_cast<std::uint32_t>(diagram_.nodes.size());
    Node node;
    node.kind = NodeKind::behavior;
    node.id = id_of("behavior", from.name);
    node.name = from.name;
    node.package = from.package;
    node.group = from.group;
    node.label = from.name.empty() ? "a behavior without a name" : label_of(from.name);
    node.situation = from.situation;
    node.mark = from.mark;
    for (const NamedCondition& condition : from.situation) {
      node.notes.push_back(describe(condition));
    }
    node.notes.insert(node.notes.end(), from.notes.begin(), from.notes.end());
    add_node(std::move(node));
  }
}

Edge& Builder::add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, Mark mark) {
  Edge& edge = diagram_.edges.emplace_back();
  edge.kind = kind;
  edge.from = from;
  edge.to = to;
  const auto is_faint = [&](std::uint32_t node) {
    const Mark of_node = diagram_.nodes[node].mark;
    return of_node == Mark::faint || of_node == Mark::unavailable;
  };
  edge.label = with_sign(mark, {});
  edge.mark = mark == Mark::plain && (is_faint(from) || is_faint(to)) ? Mark::faint : mark;
  return edge;
}

void Builder::add_clusters(Clustering clustering) {
  if (clustering == Clustering::nothing) return;
  const std::size_t fewest = clustering == Clustering::groups ? 2 : 1;
  std::map<std::string, std::size_t> sizes;
  for (const Node& node : diagram_.nodes) ++sizes[cluster_name(node, clustering)];
  std::map<std::string, std::uint32_t> places;
  for (Node& node : diagram_.nodes) {
    const std::string name = cluster_name(node, clustering);
    if (name.empty() || sizes[name] < fewest) continue;
    const auto place = static_cast<std::uint32_t>(diagram_.clusters.size());
    const auto [entry, is_new] = places.try_emplace(name, place);
    if (is_new) diagram_.clusters.push_back({id_of("cluster", name), label_of(name)});
    node.cluster = entry->second;
  }
  if (!places.empty()) diagram_.clustering = clustering;
}

/// Lists of up to this many tasks are drawn as pairs unless something else is asked for.
constexpr std::size_t most_for_pairs = 3;
using Nodes = std::vector<std::uint32_t>;

/// The lists that have a task of the part, in the order of their tasks.
std::vector<std::uint32_t> lists_of(const CatalogGraph& graph, const Part& part) {
  std::vector<std::uint32_t> lists;
  for (const std::uint32_t task : part.tasks) {
    const auto of_task = graph.exclusions_of_task[task];
    lists.insert(lists.end(), of_task.begin(), of_task.end());
  }
  std::sort(lists.begin(), lists.end());
  lists.erase(std::unique(lists.begin(), lists.end()), lists.end());
  std::sort(lists.begin(), lists.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto first = graph.exclusions[a];
    const auto second = graph.exclusions[b];
    return std::lexicographical_compare(first.begin(), first.end(), second.begin(), second.end());
  });
  return lists;
}

/// Whether a list has a task that was asked for. Then it is drawn even if no other task of it is.
bool has_named_task(const CatalogGraph& graph, const Part& part, std::uint32_t list) {
  const auto tasks = graph.exclusions[list];
  return std::any_of(tasks.begin(), tasks.end(),
                     [&](std::uint32_t task) { return part.is_named[task]; });
}

Nodes Builder::nodes_of_exclusion(std::uint32_t task) const {
  if (!part_.has_task[task]) return {};
  if (task_nodes_[task] != none) return {task_nodes_[task]};
  Nodes nodes;
  for (const std::uint32_t link : graph_.performances_of_task[task]) {
    const std::uint32_t node = behavior_nodes_[graph_.performances[link].behavior];
    if (node != none) nodes.push_back(node);
  }
  return nodes;
}

std::vector<Builder::Member> Builder::members_of(std::uint32_t list) const {
  const auto tasks = graph_.exclusions[list];
  const auto marks = graph_.exclusion_marks[list];
  std::vector<Member> members;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    Nodes nodes = nodes_of_exclusion(tasks[i]);
    if (!nodes.empty()) members.push_back({std::move(nodes), marks[i]});
  }
  return members;
}

void Builder::add_hub(std::uint32_t list, const std::vector<Member>& members) {
  const auto tasks = graph_.exclusions[list];
  Node hub;
  hub.kind = NodeKind::hub;
  hub.id = id_of("exclusivity", graph_.tasks[tasks.front()].name);
  hub.group = graph_.tasks[tasks.front()].group;
  hub.left_out = static_cast<std::uint32_t>(tasks.size() - members.size());
  hub.at_most = graph_.at_most[list];
  if (hub.at_most > 1) hub.label = "at most " + std::to_string(hub.at_most);
  if (hub.left_out > 0) {
    hub.label += (hub.label.empty() ? "and " : ", and ") + std::to_string(hub.left_out) + " more";
  }
  hub.mark = members.front().mark;
  for (const Member& member : members) {
    if (member.mark != hub.mark) hub.mark = Mark::plain;
  }
  const auto node = static_cast<std::uint32_t>(diagram_.nodes.size());
  add_node(std::move(hub));
  for (const Member& member : members) {
    for (const std::uint32_t one : member.nodes) {
      add_edge(EdgeKind::exclusion, node, one, member.mark);
    }
  }
}

void Builder::add_exclusions(ExclusivityStyle style) {
  if (style == ExclusivityStyle::hidden) return;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Mark> pairs;
  std::vector<std::pair<std::uint32_t, std::vector<Member>>> hubs;
  for (const std::uint32_t list : lists_of(graph_, part_)) {
    std::vector<Member> members = members_of(list);
    if (members.size() < 2 && !has_named_task(graph_, part_, list)) continue;
    const std::size_t most = style == ExclusivityStyle::readable ? most_for_pairs : 2;
    const bool are_pairs = style == ExclusivityStyle::pairs || members.size() <= most;
    if (members.size() == 1 || !are_pairs || graph_.at_most[list] > 1) {
      hubs.emplace_back(list, std::move(members));
      continue;
    }
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = a + 1; b < members.size(); ++b) {
        const auto mark = join(members[a].mark, members[b].mark);
        if (!mark) continue;
        for (const std::uint32_t from : members[a].nodes) {
          for (const std::uint32_t to : members[b].nodes) {
            if (from == to) continue;
            Mark& known = pairs.try_emplace(std::minmax(from, to), *mark).first->second;
            // A list in which both tasks are plain prevails over others.
            const bool is_certain = *mark == Mark::plain && known != Mark::faulty;
            if (is_certain || *mark == Mark::faulty) known = *mark;
          }
        }
      }
    }
  }
  for (const auto& [pair, mark] : pairs) {
    add_edge(EdgeKind::exclusion, pair.first, pair.second, mark);
  }
  for (const auto& [list, members] : hubs) add_hub(list, members);
}

/// What the behaviors of one task require of another task.
struct TaskRequirement {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t behaviors = 0;  ///< of `from` in the part; of two catalogs, of the newer one
  std::uint32_t requiring = 0;  ///< how many of these require `to`
  Millionths lowest = 0;        ///< of their minimum performances; 0: none
  Millionths highest = 0;
  Mark mark = Mark::plain;
};

/// What a task requires of another one now, and what it required only in the older catalog.
struct Sums {
  TaskRequirement present;
  TaskRequirement removed;
};

void count(Mark mark, Millionths minimum, TaskRequirement& sum) {
  const bool is_first = sum.requiring == 0;
  sum.lowest = is_first ? minimum : std::min(sum.lowest, minimum);
  sum.highest = std::max(sum.highest, minimum);
  sum.mark = is_first ? mark : combine(sum.mark, mark);
  ++sum.requiring;
}

TaskRequirement total(const Sums& sums) {
  if (sums.present.requiring == 0) return sums.removed;
  TaskRequirement total = sums.present;
  if (sums.removed.requiring > 0) total.mark = combine(total.mark, Mark::removed);
  return total;
}

/// All of them between tasks of a part, by `from`, then by `to`.
std::vector<TaskRequirement> task_requirements(const CatalogGraph& graph, const Part& part) {
  std::vector<TaskRequirement> all;
  for (const std::uint32_t task : part.tasks) {
    std::uint32_t behaviors = 0;
    std::map<std::uint32_t, Sums> by_target;
    for (const std::uint32_t link : graph.performances_of_task[task]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      if (!part.has_behavior[performance.behavior]) continue;
      if (performance.mark != Mark::removed) ++behaviors;
      const Mark mark = use_of(performance.mark);
      for (const std::uint32_t place : graph.requirements_of_behavior[performance.behavior]) {
        const CatalogGraph::Requirement& requirement = graph.requirements[place];
        if (!part.has_task[requirement.task]) continue;
        const std::optional<Mark> joined = join(mark, requirement.mark);
        if (!joined) continue;
        Sums& sums = by_target[requirement.task];
        count(*joined, requirement.minimum_performance,
              joined == Mark::removed ? sums.removed : sums.present);
      }
    }
    for (const auto& [target, sums] : by_target) {
      TaskRequirement& sum = all.emplace_back(total(sums));
      sum.from = task;
      sum.to = target;
      sum.behaviors = behaviors;
    }
  }
  return all;
}

using Requirements = std::vector<CatalogGraph::Requirement>;

/// What a behavior requires of other behaviors that may fulfil it, by node.
std::map<std::uint32_t, Requirements> required_behaviors(const Builder& builder,
                                                         std::uint32_t behavior) {
  const CatalogGraph& graph = builder.graph();
  std::map<std::uint32_t, Requirements> required;
  for (const std::uint32_t place : graph.requirements_of_behavior[behavior]) {
    const CatalogGraph::Requirement& requirement = graph.requirements[place];
    for (const std::uint32_t link : graph.performances_of_task[requirement.task]) {
      const std::uint32_t node = builder.node_of_behavior(graph.performances[link].behavior);
      if (node == none) continue;
      const auto mark = join(requirement.mark, use_of(graph.performances[link].mark));
      // A performance is never higher than the suitability.
      const bool is_possible = mark == Mark::removed || graph.performances[link].suitability >=
                                                            requirement.minimum_performance;
      if (mark && is_possible) required[node].emplace_back(requirement).mark = *mark;
    }
  }
  return required;
}

/// All of them as one, with the highest minimum performance of those that are not removed.
CatalogGraph::Requirement combine(const Requirements& requirements) {
  CatalogGraph::Requirement all = requirements.front();
  for (const CatalogGraph::Requirement& one : requirements) {
    const bool is_higher = one.minimum_performance > all.minimum_performance;
    const bool is_there = one.mark != Mark::removed;
    const bool was_there = all.mark != Mark::removed;
    if (is_there && (is_higher || !was_there)) all.minimum_performance = one.minimum_performance;
    all.mark = combine(all.mark, one.mark);
  }
  if (requirements.size() > 1) all.before.reset();
  return all;
}

void draw_behavior_view(Builder& builder) {
  builder.add_behaviors();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    for (const auto& [node, requirements] : required_behaviors(builder, behavior)) {
      const CatalogGraph::Requirement requirement = combine(requirements);
      Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_behavior(behavior), node,
                                    requirement.mark);
      if (requirement.minimum_performance > 0) edge.degree = requirement.minimum_performance;
      edge.label = label_of(requirement);
    }
  }
}

/// Joins the tasks of each behavior by a chain, since they are of one group. What only one of two
/// catalogs has is joined to what both have.
void connect_tasks_of_behaviors(Builder& builder) {
  const CatalogGraph& graph = builder.graph();
  for (const std::uint32_t behavior : builder.part().behaviors) {
    std::vector<std::pair<std::uint32_t, Mark>> tasks;  // their nodes
    for (const std::uint32_t link : graph.performances_of_behavior[behavior]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      const std::uint32_t node = builder.node_of_task(performance.task);
      if (node != none) tasks.emplace_back(node, presence_of(performance.mark));
    }
    std::stable_partition(tasks.begin(), tasks.end(),
                          [](const auto& task) { return task.second == Mark::plain; });
    std::size_t before = 0;
    for (std::size_t i = 1; i < tasks.size(); ++i) {
      if (const auto mark = join(tasks[before].second, tasks[i].second)) {
        builder.add_edge(EdgeKind::same_behavior, tasks[before].first, tasks[i].first, *mark);
      }
      if (tasks[i].second == Mark::plain) before = i;
    }
  }
}

/// One color for each group, except for tasks that are alone in theirs or have none.
void color_groups(std::vector<Node>& tasks) {
  std::map<std::uint32_t, std::uint32_t> sizes;
  for (const Node& task : tasks) ++sizes[task.group];
  std::map<std::uint32_t, std::uint32_t> colors;
  for (Node& task : tasks) {
    if (task.group == none || sizes[task.group] < 2) continue;
    const auto next = static_cast<std::uint32_t>(colors.size());
    task.color = colors.try_emplace(task.group, next).first->second;
  }
}

void draw_constraint_view(Builder& builder) {
  builder.add_tasks();
  color_groups(builder.diagram().nodes);
  for (const TaskRequirement& requirement : task_requirements(builder.graph(), builder.part())) {
    builder.add_edge(EdgeKind::requirement, builder.node_of_task(requirement.from),
                     builder.node_of_task(requirement.to), requirement.mark);
  }
  connect_tasks_of_behaviors(builder);
}

void draw_full_view(Builder& builder) {
  const CatalogGraph& graph = builder.graph();
  const Part& part = builder.part();
  builder.add_tasks();
  builder.add_behaviors();
  for (const std::uint32_t task : part.tasks) {
    for (const std::uint32_t link : graph.performances_of_task[task]) {
      const CatalogGraph::Performance& performance = graph.performances[link];
      if (!part.has_behavior[performance.behavior]) continue;
      Edge& edge =
          builder.add_edge(EdgeKind::performed_by, builder.node_of_task(task),
                           builder.node_of_behavior(performance.behavior), performance.mark);
      edge.degree = performance.suitability;
      edge.label = label_of(performance);
    }
  }
  for (const std::uint32_t behavior : part.behaviors) {
    for (const std::uint32_t link : graph.requirements_of_behavior[behavior]) {
      const CatalogGraph::Requirement& requirement = graph.requirements[link];
      if (!part.has_task[requirement.task]) continue;
      Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_behavior(behavior),
                                    builder.node_of_task(requirement.task), requirement.mark);
      if (requirement.minimum_performance > 0) edge.degree = requirement.minimum_performance;
      edge.label = label_of(requirement);
    }
  }
}

/// "1 of 2, ≥ 60 %": how many of the behaviors require the task, and the minimum they ask for.
std::string label_of(const TaskRequirement& requirement) {
  std::string label;
  if (requirement.requiring < requirement.behaviors && requirement.mark != Mark::removed) {
    label = std::to_string(requirement.requiring) + " of " + std::to_string(requirement.behaviors);
  }
  if (requirement.highest == 0) return label;
  if (!label.empty()) label += ", ";
  if (requirement.lowest == requirement.highest) return label + at_least(requirement.highest);
  return label + "≥ " + format_decimal(requirement.lowest, 4) + "–" +
         format_percent(requirement.highest);
}

/// Which of them follow from others. What stands out is never left out.
std::vector<bool> implied(const Builder& builder,
                          const std::vector<TaskRequirement>& requirements) {
  Edges edges;
  for (const TaskRequirement& requirement : requirements) {
    edges.emplace_back(builder.node_of_task(requirement.from),
                       builder.node_of_task(requirement.to));
  }
  std::vector<bool> result = transitive_edges(builder.part().tasks.size(), edges);
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    const Mark mark = requirements[i].mark;
    if (mark != Mark::plain && mark != Mark::faint) result[i] = false;
  }
  return result;
}

void draw_task_view(Builder& builder, bool reduce) {
  builder.add_tasks();
  const std::vector<TaskRequirement> requirements =
      task_requirements(builder.graph(), builder.part());
  std::vector<bool> is_left_out(requirements.size());
  if (reduce) is_left_out = implied(builder, requirements);
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    if (is_left_out[i]) continue;
    const TaskRequirement& requirement = requirements[i];
    Edge& edge = builder.add_edge(EdgeKind::requirement, builder.node_of_task(requirement.from),
                                  builder.node_of_task(requirement.to), requirement.mark);
    if (requirement.highest > 0) edge.degree = requirement.highest;
    edge.label = with_sign(requirement.mark, label_of(requirement));
  }
}

ExclusivityStyle default_style(View view) {
  const bool has_exclusivity = view == View::full || view == View::constraints;
  return has_exclusivity ? ExclusivityStyle::readable : ExclusivityStyle::hidden;
}

Clustering default_clustering(View view) {
  return view == View::constraints ? Clustering::groups : Clustering::nothing;
}

}  // namespace

Diagram make_diagram(const CatalogGraph& graph, const Part& part, const ViewOptions& options) {
  Builder builder(graph, part, options);
  switch (options.view) {
    case View::full:
      draw_full_view(builder);
      break;
    case View::tasks:
      draw_task_view(builder, options.reduce);
      break;
    case View::constraints:
      draw_constraint_view(builder);
      break;
    case View::behaviors:
      draw_behavior_view(builder);
      break;
  }
  builder.add_exclusions(options.exclusivity.value_or(default_style(options.view)));
  builder.add_clusters(options.clustering.value_or(default_clustering(options.view)));
  return std::move(builder.diagram());
}

}  // namespace cbc::draw
