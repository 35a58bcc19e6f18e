#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/performance_bound.h"

namespace cbc {

/// Removes values that no solution has, to a fixed point.
///
/// Exclusivity lists are cliques, and requirements are arcs between domains: a needed task closes
/// its rivals, and needs what all of its behaviors require; a task without behaviors removes those
/// that require it. That makes each of these constraints arc consistent (GAC). A minimum
/// performance is propagated by bounds: the product of the best suitabilities that are left.
class Propagator {
 public:
  Propagator(const CompiledCatalog& catalog, Domains& domains);

  void load(const Problem& problem);

  /// False: there is no solution in this subtree. True where every needed task has one behavior
  /// left: these behaviors, with all other tasks not running, are a solution.
  [[nodiscard]] bool propagate();

  /// Revisions of tasks since the last load.
  [[nodiscard]] std::uint64_t propagations() const { return propagations_; }
  [[nodiscard]] std::uint64_t performance_effort() const {
    return performance_.effort() - effort_before_;
  }

 private:
  [[nodiscard]] bool revise(std::uint32_t task);
  [[nodiscard]] bool close_dependents(std::uint32_t task);
  [[nodiscard]] bool close_rivals(std::uint32_t task);
  [[nodiscard]] bool need_requirements(std::uint32_t task);

  [[nodiscard]] bool revise_performance();
  [[nodiscard]] bool revise_performance_of(std::uint32_t task);
  [[nodiscard]] bool enforce(std::uint32_t task, Millionths minimum, std::int64_t minimum_cost);

  const CompiledCatalog& catalog_;
  Domains& domains_;
  TaskId first_task_ = 0;
  bool has_performance_rules_ = false;
  std::uint64_t propagations_ = 0;
  std::uint64_t effort_before_ = 0;      ///< of performance_, in earlier problems
  std::vector<std::uint8_t> has_rules_;  ///< by group
  PerformanceBound performance_;
};

}  // namespace cbc
