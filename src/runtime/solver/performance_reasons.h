#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/performance_bound.h"
#include "runtime/solver/reason_trail.h"
#include "runtime/solver/search_budget.h"

namespace cbc {

/// Propagates minimum performances by the same bounds as the propagator, with reasons: the removals
/// that lowered the best suitabilities, and those that left only values that require a task.
class PerformanceReasons {
 public:
  PerformanceReasons(const CompiledCatalog& catalog, const Domains& domains, ReasonTrail& trail);

  void load();
  /// To be called at a fixpoint of the trail; there may be more to propagate afterwards, or if no
  /// time is left. False: see the trail's conflict.
  [[nodiscard]] bool propagate(const SearchBudget& budget = {});

 private:
  [[nodiscard]] bool revise(std::uint32_t task);
  [[nodiscard]] bool enforce(std::uint32_t task, Millionths minimum, std::int64_t minimum_cost,
                             Literal demand);
  [[nodiscard]] bool remove_low_values(const PerformanceBound::Bound& bound,
                                       std::int64_t minimum_cost, Literal demand);
  [[nodiscard]] bool is_too_low(const PerformanceBound::Bound& bound, std::uint32_t task,
                                std::uint32_t index, std::int64_t minimum_cost) const;
  [[nodiscard]] bool remove(std::uint32_t task, std::uint32_t index);
  void explain_bound();
  [[nodiscard]] bool is_in_reason(std::uint32_t task, std::uint32_t index) const;
  void explain_best(std::uint32_t task);

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  ReasonTrail& trail_;
  PerformanceBound performance_;
  std::vector<std::uint32_t> ruled_;  ///< tasks with a minimum, or a behavior that requires one
  std::vector<Literal> reason_;
};

}  // namespace cbc
