#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "lint/assignment_search.h"

namespace cbc {

/// Which values, behaviors and tasks occur in no assignment that satisfies all constraints.
class Liveness {
 public:
  enum class State : std::uint8_t { live, dead, undecided };

  /// Searches. Dead values are ruled out in `search` from then on.
  explicit Liveness(AssignmentSearch& search);

  [[nodiscard]] State of_value(ValueId value) const { return values_[value]; }
  /// Dead if it is dead as a value of all its tasks.
  [[nodiscard]] State of_behavior(BehaviorId behavior) const;
  /// Dead if all its behaviors are dead as its values; a task without behaviors is dead.
  [[nodiscard]] State of_task(TaskId task) const;

 private:
  const CompiledCatalog& catalog_;
  std::vector<State> values_;
};

}  // namespace cbc
