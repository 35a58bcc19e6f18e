#pragma once

#include <cstdint>
#include <vector>

#include "ask/assignment_search.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// All tasks from the lowest level up, so that what is required is decided before what requires it.
[[nodiscard]] std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog);

class DirectAssignment;

/// Which values, behaviors and tasks occur in no assignment that satisfies all constraints: dead
/// ones are reported, and other proofs need not try them.
class Liveness {
 public:
  enum class State : std::uint8_t { live, dead, undecided };

  /// Searches. Dead values are ruled out in `search` from then on.
  explicit Liveness(AssignmentSearch& search);

  [[nodiscard]] State of_value(ValueId value) const {
    if (is_live_[value]) return State::live;
    return is_dead_[value] ? State::dead : State::undecided;
  }
  /// Dead if the behavior is dead as a value of each of its tasks.
  [[nodiscard]] State of_behavior(BehaviorId behavior) const;
  /// Dead if all its values are dead, so also if it has none.
  [[nodiscard]] State of_task(TaskId task) const;

 private:
  [[nodiscard]] bool requires_dead_task(ValueId value) const;
  void decide(ValueId value, DirectAssignment& direct, AssignmentSearch& search);

  const CompiledCatalog& catalog_;
  std::vector<bool> is_live_;  ///< by value
  std::vector<bool> is_dead_;
  Assignment solution_;
};

}  // namespace cbc
