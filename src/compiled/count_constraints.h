#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// Number of constraints, as the paper counts them.
struct ConstraintCount {
  std::uint64_t exclusive_pairs = 0;  ///< distinct unordered pairs of different tasks
  std::uint64_t requirements = 0;     ///< distinct (behavior, task)
  std::uint64_t task_minimums = 0;

  [[nodiscard]] std::uint64_t total() const {
    return exclusive_pairs + requirements + task_minimums;
  }
};

/// Counts the constraints of each group.
[[nodiscard]] std::vector<ConstraintCount> count_constraints(const CompiledCatalog& catalog);

}  // namespace cbc
