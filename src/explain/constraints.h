#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/reason.h"

namespace cbc {

/// The tasks of one group that some tasks may come to need, directly or through what they require.
/// All others can stay not running, so constraints on them are no reason for anything.
class RelevantTasks {
 public:
  RelevantTasks(const CompiledCatalog& catalog, std::uint32_t group);

  void add(TaskId task);
  /// Adds all that the tasks so far may require; in TaskId order from then on. False if that are
  /// more than `most` tasks, and not all of them were added.
  bool close(std::size_t most = SIZE_MAX);

  [[nodiscard]] bool contains(TaskId task) const { return is_relevant_[task - first_task_] != 0; }
  [[nodiscard]] const std::vector<TaskId>& tasks() const { return tasks_; }
  /// The behaviors that perform them, in BehaviorId order.
  [[nodiscard]] std::vector<BehaviorId> behaviors() const;

 private:
  const CompiledCatalog& catalog_;
  TaskId first_task_;
  std::vector<std::uint8_t> is_relevant_;  ///< by task of the group
  std::vector<TaskId> tasks_;
};

/// Appends the exclusions of a task with later relevant tasks; stops at `most` reasons in all.
void add_exclusions(const CompiledCatalog& catalog, TaskId task, const RelevantTasks& relevant,
                    std::size_t most, std::vector<Reason>& reasons);

/// Appends the minimum performance of a task, if it has one.
void add_minimum(const CompiledCatalog& catalog, TaskId task, std::vector<Reason>& reasons);

/// Appends the requirements of a behavior, those of performance apart.
void add_requirements(const CompiledCatalog& catalog, BehaviorId behavior,
                      std::vector<Reason>& reasons);

}  // namespace cbc
