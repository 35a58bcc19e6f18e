#include "explain/narrow.h"

#include <algorithm>
#include <bit>
#include <span>

namespace cbc {
namespace {

/// The domain words of a task among those of its group.
template <typename Words>
auto words_of(const CompiledCatalog& catalog, std::uint32_t group, Words& words, TaskId task) {
  const std::uint32_t first = catalog.words[catalog.group_tasks[group]];
  return std::span(words).subspan(catalog.words[task] - first,
                                  catalog.words[task + 1] - catalog.words[task]);
}

}  // namespace

void narrow(const CompiledCatalog& catalog, const Demand& demand, Problem& problem) {
  const auto words = words_of(catalog, problem.group, problem.domains, demand.task);
  std::uint8_t& may_stop = problem.may_stop[demand.task - catalog.group_tasks[problem.group]];
  const auto bit = [&] { return std::uint64_t{1} << (demand.place % 64); };
  switch (demand.kind) {
    case Demand::Kind::run:
      may_stop = 0;
      return;
    case Demand::Kind::stop:
      std::fill(words.begin(), words.end(), 0);
      return;
    case Demand::Kind::has: {
      may_stop = 0;
      const std::uint64_t kept = words[demand.place / 64] & bit();
      std::fill(words.begin(), words.end(), 0);
      words[demand.place / 64] = kept;
      return;
    }
    case Demand::Kind::has_not:
      words[demand.place / 64] &= ~bit();
      return;
  }
}

bool is_open(const CompiledCatalog& catalog, const Problem& problem, TaskId task) {
  std::uint32_t values = problem.may_stop[task - catalog.group_tasks[problem.group]];
  for (const std::uint64_t word : words_of(catalog, problem.group, problem.domains, task)) {
    values += static_cast<std::uint32_t>(std::popcount(word));
  }
  return values > 1;
}

}  // namespace cbc
