#include <algorithm>
#include <cstddef>
#include <numeric>

#include "draw/catalog_graph.h"
#include "graph/graph.h"

namespace cbc::draw {
namespace {

/// The places of `items` by key, which is less than `keys`; in order.
template <typename Items, typename Key>
GrowingRows<std::uint32_t> places_by(const Items& items, std::size_t keys, const Key& key) {
  GrowingRows<std::uint32_t> rows;
  rows.begin.assign(keys + 1, 0);
  for (const auto& item : items) ++rows.begin[key(item) + 1];
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  rows.items.resize(items.size());
  std::vector<std::uint32_t> next = rows.begin;
  std::uint32_t place = 0;
  for (const auto& item : items) rows.items[next[key(item)]++] = place++;
  return rows;
}

}  // namespace

std::vector<std::uint32_t> components_of(const CatalogGraph& graph) {
  const auto tasks = static_cast<std::uint32_t>(graph.tasks.size());
  Edges edges;
  const auto add = [&](const auto& links) {
    for (const auto& link : links) edges.emplace_back(tasks + link.behavior, link.task);
  };
  add(graph.performances);
  add(graph.requirements);
  for (std::size_t list = 0; list < graph.exclusions.size(); ++list) {
    for (const std::uint32_t task : graph.exclusions[list]) {
      edges.emplace_back(graph.exclusions[list].front(), task);
    }
  }
  return connected_components(tasks + graph.behaviors.size(), edges);
}

void connect(CatalogGraph& graph) {
  const auto task_of = [](const auto& link) { return link.task; };
  const auto behavior_of = [](const auto& link) { return link.behavior; };
  const std::size_t tasks = graph.tasks.size();
  const std::size_t behaviors = graph.behaviors.size();
  graph.performances_of_task = places_by(graph.performances, tasks, task_of);
  graph.performances_of_behavior = places_by(graph.performances, behaviors, behavior_of);
  graph.requirements_of_task = places_by(graph.requirements, tasks, task_of);
  graph.requirements_of_behavior = places_by(graph.requirements, behaviors, behavior_of);
  graph.exclusions_of_task =
      places_by(graph.exclusions.items, tasks, [](std::uint32_t task) { return task; });
  // From the places of the names to those of the lists that have them.
  for (std::uint32_t& place : graph.exclusions_of_task.items) {
    const auto& begin = graph.exclusions.begin;
    place = static_cast<std::uint32_t>(std::upper_bound(begin.begin(), begin.end(), place) -
                                       begin.begin() - 1);
  }
}

}  // namespace cbc::draw
