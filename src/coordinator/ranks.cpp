#include "coordinator/ranks.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace cbc {

std::vector<std::uint32_t> draw_ranks(const CompiledCatalog& catalog, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint32_t> ranks(catalog.values.items.size());
  std::vector<std::uint64_t> lots;
  std::vector<std::uint32_t> order;
  for (const TaskId task : catalog.task_ids) {
    const auto values = catalog.values[task];
    lots.resize(values.size());
    std::generate(lots.begin(), lots.end(), std::ref(random));
    order.resize(values.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (values[a].suitability != values[b].suitability) {
        return values[a].suitability > values[b].suitability;
      }
      return lots[a] != lots[b] ? lots[a] < lots[b] : a < b;
    });
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
      ranks[catalog.values.begin[task] + order[rank]] = rank;
    }
  }
  return ranks;
}

}  // namespace cbc
