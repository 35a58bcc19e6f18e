#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "draw/builder.h"
#include "draw/names.h"

namespace cbc::draw {
namespace {

/// Lists of so many tasks are drawn as pairs where nothing else is asked for.
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

/// A task that was asked for is shown to have exclusions, even if none of the others is drawn.
bool has_named_task(const CatalogGraph& graph, const Part& part, std::uint32_t list) {
  const auto tasks = graph.exclusions[list];
  return std::any_of(tasks.begin(), tasks.end(),
                     [&](std::uint32_t task) { return part.is_named[task]; });
}

}  // namespace

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

void Builder::add_hub(std::uint32_t list, const std::vector<Nodes>& members) {
  const auto tasks = graph_.exclusions[list];
  Node hub;
  hub.kind = NodeKind::hub;
  hub.id = id_of("exclusivity", graph_.tasks[tasks.front()].name);
  hub.group = graph_.tasks[tasks.front()].group;
  hub.left_out = static_cast<std::uint32_t>(tasks.size() - members.size());
  if (hub.left_out > 0) hub.label = "and " + std::to_string(hub.left_out) + " more";
  if (graph_.exclusion_is_faulty[list]) hub.mark = Mark::faulty;
  const Mark mark = hub.mark;
  const auto node = static_cast<std::uint32_t>(diagram_.nodes.size());
  add_node(std::move(hub));
  for (const Nodes& member : members) {
    for (const std::uint32_t one : member) {
      Edge& edge = add_edge(EdgeKind::exclusion, node, one);
      if (mark == Mark::faulty) edge.mark = mark;
    }
  }
}

void Builder::add_exclusions(ExclusivityStyle style) {
  if (style == ExclusivityStyle::hidden) return;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> pairs;  // and whether it is faulty
  std::vector<std::pair<std::uint32_t, std::vector<Nodes>>> hubs;
  for (const std::uint32_t list : lists_of(graph_, part_)) {
    std::vector<Nodes> members;
    for (const std::uint32_t task : graph_.exclusions[list]) {
      if (Nodes nodes = nodes_of_exclusion(task); !nodes.empty()) {
        members.push_back(std::move(nodes));
      }
    }
    if (members.size() < 2 && !has_named_task(graph_, part_, list)) continue;
    const std::size_t most = style == ExclusivityStyle::readable ? most_for_pairs : 2;
    if (members.size() == 1 || (style != ExclusivityStyle::pairs && members.size() > most)) {
      hubs.emplace_back(list, std::move(members));
      continue;
    }
    for (std::size_t a = 0; a < members.size(); ++a) {
      for (std::size_t b = a + 1; b < members.size(); ++b) {
        for (const std::uint32_t from : members[a]) {
          for (const std::uint32_t to : members[b]) {
            if (from != to) pairs[std::minmax(from, to)] |= graph_.exclusion_is_faulty[list];
          }
        }
      }
    }
  }
  for (const auto& [pair, is_faulty] : pairs) {
    Edge& edge = add_edge(EdgeKind::exclusion, pair.first, pair.second);
    if (is_faulty) edge.mark = Mark::faulty;
  }
  for (const auto& [list, members] : hubs) add_hub(list, members);
}

}  // namespace cbc::draw
