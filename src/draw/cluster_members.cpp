#include "draw/cluster_members.h"

namespace cbc::draw {

std::vector<std::vector<const Node*>> cluster_members(const Diagram& diagram) {
  std::vector<std::vector<const Node*>> members(diagram.clusters.size());
  for (const Node& node : diagram.nodes) {
    if (node.cluster != none) members[node.cluster].push_back(&node);
  }
  return members;
}

}  // namespace cbc::draw
