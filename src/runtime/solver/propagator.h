#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/domains.h"
#include "solver/objective.h"

namespace cbc {

/// Removes values that no solution has, to a fixed point: exclusivity as cliques, requirements by
/// support on the arcs of the requirement graph, performance by the best product that is left.
class Propagator {
 public:
  Propagator(const CompiledCatalog& catalog, Domains& domains);

  void load(const Problem& problem);

  /// False: there is no solution in this subtree. Where every needed task has one behavior left,
  /// true means that these behaviors, all other tasks not running, are a solution.
  [[nodiscard]] bool propagate();

  /// Tasks looked at since the last load, each time that one is.
  [[nodiscard]] std::uint64_t propagations() const { return propagations_; }

 private:
  /// The most that the performance of a task can be: product of the best suitabilities of the
  /// task and of what it surely requires (its closure).
  struct Bound {
    bool reachable = true;  ///< false: something it requires cannot run
    bool zero = false;
    std::int64_t cost = 0;
    std::uint32_t factors = 0;
  };

  [[nodiscard]] bool revise(std::uint32_t task);
  [[nodiscard]] bool close_dependents(std::uint32_t task);
  [[nodiscard]] bool close_rivals(std::uint32_t task);
  [[nodiscard]] bool need_requirements(std::uint32_t task);

  [[nodiscard]] bool revise_performance();
  [[nodiscard]] bool revise_performance_of(std::uint32_t task);
  [[nodiscard]] Bound bound_performance(std::uint32_t task);
  [[nodiscard]] bool is_below(const Bound& bound, Millionths minimum, std::int64_t minimum_cost);
  [[nodiscard]] bool enforce(std::uint32_t task, Millionths minimum, std::int64_t minimum_cost);

  const CompiledCatalog& catalog_;
  Domains& domains_;
  TaskId first_task_ = 0;
  bool has_performance_rules_ = false;
  std::uint64_t propagations_ = 0;
  std::vector<std::uint8_t> has_rules_;  ///< by group

  std::vector<std::uint32_t> closure_;
  std::vector<std::uint64_t> in_closure_;  ///< by task: number of the last closure it was in
  std::uint64_t closure_number_ = 0;
  ExactProduct product_;
  ExactProduct minimum_;
};

}  // namespace cbc
