#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// The tasks that some tasks may need: themselves, what a behavior of them requires, and so on,
/// whatever is chosen.
class MayNeed {
 public:
  explicit MayNeed(const CompiledCatalog& catalog)
      : catalog_(catalog), seen_(catalog.tasks.size(), 0) {
    open_.reserve(most_in_a_group(catalog.group_tasks));
  }

  void clear() { ++number_; }
  void add(TaskId task) {
    push(task);
    while (!open_.empty()) {
      const TaskId next = open_.back();
      open_.pop_back();
      for (const Arc& arc : catalog_.arcs[next]) push(arc.target);
    }
  }
  [[nodiscard]] bool has(TaskId task) const { return seen_[task] == number_; }

 private:
  void push(TaskId task) {
    if (has(task)) return;
    seen_[task] = number_;
    open_.push_back(task);
  }

  const CompiledCatalog& catalog_;
  std::vector<std::uint64_t> seen_;  ///< by task: the last number for which it was added
  std::uint64_t number_ = 1;
  std::vector<TaskId> open_;
};

}  // namespace cbc
