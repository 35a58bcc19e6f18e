#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "lint/assignment_search.h"
#include "lint/direct_assignment.h"

namespace cbc {

/// All tasks, those that require little first, so that what is dead is known where it is required.
[[nodiscard]] std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog);

/// Which values, behaviors and tasks occur in no assignment that satisfies all constraints.
class Liveness {
 public:
  enum class State : std::uint8_t { live, dead, undecided };

  /// Searches. Dead values are ruled out in `search` from then on.
  explicit Liveness(AssignmentSearch& search);

  [[nodiscard]] State of_value(ValueId value) const {
    if (is_live_[value]) return State::live;
    return is_dead_[value] ? State::dead : State::undecided;
  }
  /// Dead if it is dead as a value of all its tasks.
  [[nodiscard]] State of_behavior(BehaviorId behavior) const;
  /// Dead if all its behaviors are dead as its values; a task without behaviors is dead.
  [[nodiscard]] State of_task(TaskId task) const;

 private:
  void decide(ValueId value, AssignmentSearch& search);

  const CompiledCatalog& catalog_;
  std::vector<bool> is_live_;  ///< by value
  std::vector<bool> is_dead_;
  DirectAssignment direct_;
  Assignment solution_;
};

}  // namespace cbc
