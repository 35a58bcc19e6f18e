#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "draw/view.h"

namespace cbc::draw {
namespace {

class Legend {
 public:
  explicit Legend(Diagram& diagram) : diagram_(diagram) {
    for (const Node& node : diagram.nodes) {
      has_tasks_ |= node.kind == NodeKind::task;
      has_behaviors_ |= node.kind == NodeKind::behavior;
      has_hubs_ |= node.kind == NodeKind::hub;
      marks_.insert(node.mark);
    }
    for (const Edge& edge : diagram.edges) marks_.insert(edge.mark);
  }

  void add() {
    cluster_ = static_cast<std::uint32_t>(diagram_.clusters.size());
    diagram_.clusters.push_back({"cluster:legend#1", "legend"});
    if (has_tasks_) task_ = add_node(NodeKind::task, "task");
    if (has_behaviors_) behavior_ = add_node(NodeKind::behavior, "behavior");
    if (has_tasks_ && has_behaviors_) {
      add_edge(EdgeKind::performed_by, task_, behavior_, "performed by, suitability");
    }
    if (has(EdgeKind::requirement)) add_requirement();
    if (has(EdgeKind::same_behavior)) {
      add_edge(EdgeKind::same_behavior, task_,
               add_node(NodeKind::task, "task of the same behavior"), "");
    }
    if (has(EdgeKind::exclusion)) add_exclusion();
    for (const Mark mark : marks_) {
      std::string label = describe(mark);
      if (label.empty()) continue;
      // Only behaviors are unavailable.
      const bool is_task = has_tasks_ && mark != Mark::unavailable;
      diagram_.nodes[add_node(is_task ? NodeKind::task : NodeKind::behavior, std::move(label))]
          .mark = mark;
    }
  }

 private:
  [[nodiscard]] bool has(EdgeKind kind) const {
    return std::any_of(diagram_.edges.begin(), diagram_.edges.end(),
                       [kind](const Edge& edge) { return edge.kind == kind; });
  }

  void add_requirement() {
    const std::uint32_t from = has_behaviors_ ? behavior_ : task_;
    const NodeKind kind = has_tasks_ ? NodeKind::task : NodeKind::behavior;
    add_edge(EdgeKind::requirement, from, add_node(kind, "required " + name_of(kind)),
             "requires, minimum performance");
  }

  void add_exclusion() {
    const NodeKind kind = has_tasks_ ? NodeKind::task : NodeKind::behavior;
    const std::uint32_t from = has_tasks_ ? task_ : behavior_;
    const std::uint32_t excluded = add_node(kind, "excluded " + name_of(kind));
    add_edge(EdgeKind::exclusion, from, excluded, "not at the same time");
    if (!has_hubs_) return;
    const std::uint32_t hub = add_node(NodeKind::hub, "at most one of them");
    for (int i = 0; i < 2; ++i) {
      add_edge(EdgeKind::exclusion, hub, add_node(kind, "…"), "");
    }
  }

  /// Empty for what needs no word.
  [[nodiscard]] std::string describe(Mark mark) const {
    if (mark == Mark::unavailable) return "unavailable or faulty";
    if (mark == Mark::faint && diagram_.moment) return "inactive";
    return std::string(draw::name_of(mark));
  }

  static std::string name_of(NodeKind kind) { return kind == NodeKind::task ? "task" : "behavior"; }

  std::uint32_t add_node(NodeKind kind, std::string label) {
    Node node;
    node.kind = kind;
    node.id = "legend:" + std::to_string(++count_);
    node.label = std::move(label);
    node.cluster = cluster_;
    diagram_.nodes.push_back(std::move(node));
    return static_cast<std::uint32_t>(diagram_.nodes.size() - 1);
  }

  void add_edge(EdgeKind kind, std::uint32_t from, std::uint32_t to, std::string label) {
    Edge edge;
    edge.kind = kind;
    edge.from = from;
    edge.to = to;
    edge.label = std::move(label);
    diagram_.edges.push_back(std::move(edge));
  }

  Diagram& diagram_;
  bool has_tasks_ = false;
  bool has_behaviors_ = false;
  bool has_hubs_ = false;
  std::set<Mark> marks_;
  std::uint32_t cluster_ = 0;
  std::uint32_t task_ = 0;
  std::uint32_t behavior_ = 0;
  int count_ = 0;
};

}  // namespace

void add_legend(Diagram& diagram) {
  if (!diagram.nodes.empty()) Legend(diagram).add();
}

}  // namespace cbc::draw
