#pragma once

#include <cstddef>
#include <vector>

#include "catalog/catalog.h"

namespace cbc {

/// A behavior that performs `task`, and one of its requirements.
struct CycleStep {
  TaskIndex task = 0;
  BehaviorIndex behavior = 0;
  std::size_t requirement = 0;  ///< place in Behavior::requirements
};

/// Tasks that require themselves in the end: each step's requirement is the task of the next step,
/// and that of the last step the task of the first.
using Cycle = std::vector<CycleStep>;

/// A shortest cycle for each set of tasks that require one another, in catalog order of its first
/// task. In sets so large that the search for the shortest takes too long it is a short one.
[[nodiscard]] std::vector<Cycle> find_requirement_cycles(const Catalog& catalog);

}  // namespace cbc
