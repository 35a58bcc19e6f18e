#include "solver/canonical_order.h"

#include <bit>

namespace cbc {
namespace {

bool has(const std::uint64_t* words, std::uint32_t place) {
  return ((words[place / 64] >> (place % 64)) & 1) != 0;
}

/// Place of the most suitable behavior; there is one.
std::uint32_t first_place(const std::uint64_t* words) {
  std::uint32_t word = 0;
  while (words[word] == 0) ++word;
  return word * 64 + static_cast<std::uint32_t>(std::countr_zero(words[word]));
}

}  // namespace

CanonicalOrder::CanonicalOrder(const CompiledCatalog& catalog,
                               const std::vector<std::uint32_t>& ranks)
    : catalog_(catalog), ranks_(ranks) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  empty_first_.reserve(tasks);
  kept_first_.reserve(tasks);
}

void CanonicalOrder::load(const Problem& problem) {
  const Problem& whole = problem.part_of != nullptr ? *problem.part_of : problem;
  first_task_ = catalog_.group_tasks[whole.group];
  const auto tasks = static_cast<std::uint32_t>(whole.present.size());
  empty_first_.resize(tasks);
  kept_first_.resize(tasks);
  for (std::uint32_t task = 0; task < tasks; ++task) {
    const TaskId id = first_task_ + task;
    const std::uint64_t* const words =
        whole.domains.data() + (catalog_.words[id] - catalog_.words[first_task_]);
    const std::uint32_t present = whole.present[task];
    empty_first_[task] = present == none && whole.may_stop[task] != 0;
    const bool is_best = present != none && has(words, present) &&
                         catalog_.values[id][present].suitability ==
                             catalog_.values[id][first_place(words)].suitability;
    kept_first_[task] = is_best ? present : none;
  }
}

}  // namespace cbc
