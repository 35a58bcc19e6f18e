#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "catalog/catalog.h"

namespace cbc {

/// Finds exclusivity lists that two tasks share. Each pair is looked up once, in the lists of the
/// task that has fewer, so that no catalog makes it quadratic.
class Exclusions {
 public:
  explicit Exclusions(const Catalog& catalog);

  /// Places in Catalog::exclusivity of the lists that have a task, ascending.
  [[nodiscard]] const std::vector<std::size_t>& lists_of(TaskIndex task) const {
    return lists_[task];
  }

  /// Place in Catalog::exclusivity of the first list that has both tasks.
  [[nodiscard]] std::optional<std::size_t> find(TaskIndex a, TaskIndex b);

  /// A list that excludes `task` from the first of the behavior's tasks, if there are such lists
  /// for all of them; so a behavior that requires the task is never active.
  [[nodiscard]] std::optional<std::size_t> find_for_all(const Behavior& behavior, TaskIndex task);

 private:
  std::vector<std::vector<std::size_t>> lists_;  // of each task, ascending
  std::unordered_map<std::uint64_t, std::optional<std::size_t>> known_;
};

}  // namespace cbc
