#include "draw/builder.h"

#include <utility>

#include "draw/labels.h"
#include "draw/names.h"

namespace cbc::draw {
namespace {

std::string cluster_name(const Node& node, Clustering clustering) {
  if (clustering == Clustering::packages) return std::string(node.package);
  return node.group == none ? std::string() : "group " + std::to_string(node.group);
}

}  // namespace

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
    node.mark = from.mark;
    node.notes = from.notes;
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
}

}  // namespace cbc::draw
