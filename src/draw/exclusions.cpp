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
  if (hub.left_out > 0) hub.label = "and " + std::to_string(hub.left_out) + " more";
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
    if (members.size() == 1 || (style != ExclusivityStyle::pairs && members.size() > most)) {
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
            // What one list says counts, whatever others no longer or newly say.
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

}  // namespace cbc::draw
