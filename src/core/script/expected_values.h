#pragma once

#include <cstdint>
#include <vector>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"
#include "runtime/explain/reasons.h"

namespace cbc {

/// What an expectation that does not hold demands of one group of tasks.
struct ExpectedValues {
  std::uint32_t group = 0;
  std::vector<TaskId> tasks;  ///< those that are not as expected, in catalog order
  /// The expectation holds in the group if all demands of one of these hold. More than one where
  /// an active behavior may perform several tasks.
  std::vector<Demands> ways;
};

/// The groups in which the expectation does not hold, in catalog order. Left out are those in which
/// it can never hold, and those with more ways than anybody would list.
[[nodiscard]] std::vector<ExpectedValues> find_expected_values(const Expectation& expectation,
                                                               const CompiledCatalog& catalog,
                                                               const State& state);

}  // namespace cbc
