#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "graph/engine/diagram.h"

namespace cbc::draw {
namespace {

class Legend {
 public:
  explicit Legend(Diagram& diagram) : diagram_(diagram) {}

  void add() {
    add_nodes();
    add_lines();
    add_texts();
    add_marks();
  }

 private:
  template <typename Sample>
  void explain(bool is_there, Sample&& sample, std::string meaning) {
    if (is_there) diagram_.legend.push_back({std::forward<Sample>(sample), std::move(meaning)});
  }

  template <typename Test>
  [[nodiscard]] bool has_node(const Test& test) const {
    return std::any_of(diagram_.nodes.begin(), diagram_.nodes.end(), test);
  }

  template <typename Test>
  [[nodiscard]] bool has_edge(const Test& test) const {
    return std::any_of(diagram_.edges.begin(), diagram_.edges.end(), test);
  }

  [[nodiscard]] bool has(NodeKind kind) const {
    return has_node([kind](const Node& node) { return node.kind == kind; });
  }

  [[nodiscard]] bool has(EdgeKind kind) const {
    return has_edge([kind](const Edge& edge) { return edge.kind == kind; });
  }

  void add_nodes() {
    using Frame = LegendEntry::Frame;
    const bool has_tasks = has(NodeKind::task);
    add_shape(NodeKind::task, "round", "task");
    add_shape(NodeKind::behavior, "angular", "behavior");
    explain(diagram_.clustering == Clustering::packages, Frame::package,
            has_tasks ? "package, with the tasks that it alone performs" : "package");
  }

  /// A word stands for the shape where no node has the color of its kind.
  void add_shape(NodeKind kind, std::string word, std::string meaning) {
    const bool has_color = has_node([kind](const Node& node) {
      return node.kind == kind && node.mark == Mark::plain && node.color == none;
    });
    explain(has_color, kind, meaning);
    explain(!has_color && has(kind), std::move(word), std::move(meaning));
  }

  void add_lines() {
    explain(has(EdgeKind::performed_by), EdgeKind::performed_by, "performs the task");
    explain(has(EdgeKind::requirement), EdgeKind::requirement, "requires");
    explain(has(EdgeKind::same_behavior), EdgeKind::same_behavior, "have a behavior in common");
    explain(has_edge([this](const Edge& edge) {
              return edge.kind == EdgeKind::exclusion &&
                     diagram_.nodes[edge.from].kind != NodeKind::hub;
            }),
            EdgeKind::exclusion, "not at the same time");
    explain(has(NodeKind::hub), NodeKind::hub, "at most one of them at a time");
  }

  void add_texts() {
    const auto has_suitability = [](const Edge& edge) {
      return edge.kind == EdgeKind::performed_by && edge.label.find('%') != std::string::npos;
    };
    const auto has_minimum = [](const auto& drawn) {
      return drawn.label.find("≥") != std::string::npos;
    };
    const auto has_count = [](const Edge& edge) {
      return edge.label.find(" of ") != std::string::npos;
    };
    explain(has_edge(has_suitability), "%", "suitability, if it is not 100 %");
    explain(has_edge(has_minimum) ||
                has_node([](const Node& node) { return node.minimum_performance > 0; }),
            "≥", "minimum performance");
    explain(has_edge(has_count), "1 of 2", "one of the two behaviors requires it");
    explain(has_node([](const Node& node) { return !node.situation.empty(); }), "X: y",
            "fits only in this situation");
  }

  void add_marks() {
    constexpr std::array all = {Mark::active,      Mark::started, Mark::stopped,
                                Mark::unavailable, Mark::added,   Mark::removed,
                                Mark::changed,     Mark::faulty,  Mark::faint};
    for (const Mark mark : all) {
      const auto is_marked = [mark](const auto& drawn) { return drawn.mark == mark; };
      explain(has_node(is_marked) || has_edge(is_marked), mark, describe(mark));
    }
  }

  [[nodiscard]] std::string describe(Mark mark) const {
    if (mark == Mark::unavailable) return "cannot be activated";
    if (mark == Mark::faulty) return "has an error";
    if (mark == Mark::faint) return diagram_.moment ? "inactive" : "only a neighbor";
    return std::string(name_of(mark));
  }

  Diagram& diagram_;
};

}  // namespace

void add_legend(Diagram& diagram) { Legend(diagram).add(); }

}  // namespace cbc::draw
