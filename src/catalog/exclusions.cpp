#include "catalog/exclusions.h"

#include <algorithm>
#include <utility>

namespace cbc {
namespace {

std::optional<std::size_t> search(const std::vector<std::size_t>& few,
                                  const std::vector<std::size_t>& many) {
  for (const std::size_t list : few) {
    if (std::binary_search(many.begin(), many.end(), list)) return list;
  }
  return std::nullopt;
}

}  // namespace

Exclusions::Exclusions(const Catalog& catalog) : lists_(catalog.tasks.size()) {
  for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
    for (const TaskIndex task : catalog.exclusivity[list].tasks) {
      auto& of_task = lists_[task];
      if (of_task.empty() || of_task.back() != list) of_task.push_back(list);
    }
  }
}

std::optional<std::size_t> Exclusions::find(TaskIndex a, TaskIndex b) {
  if (lists_[a].size() > lists_[b].size()) std::swap(a, b);
  if (lists_[a].empty()) return std::nullopt;
  const std::uint64_t pair = (std::uint64_t{a} << 32U) | b;
  const auto [entry, is_new] = known_.try_emplace(pair);
  if (is_new) entry->second = search(lists_[a], lists_[b]);
  return entry->second;
}

std::optional<std::size_t> Exclusions::find_for_all(const Behavior& behavior, TaskIndex task) {
  std::optional<std::size_t> first;
  for (const Performance& performance : behavior.performs) {
    // What a behavior requires of itself is a cycle.
    if (performance.task == task) return std::nullopt;
    const auto list = find(performance.task, task);
    if (!list) return std::nullopt;
    if (!first) first = list;
  }
  return first;
}

}  // namespace cbc
