#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "draw/catalog_graph.h"
#include "draw/diagram.h"
#include "draw/mark.h"
#include "draw/part.h"
#include "draw/view.h"

namespace cbc::draw {

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

}  // namespace cbc::draw
