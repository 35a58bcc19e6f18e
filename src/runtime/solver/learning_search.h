#pragma once

#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/landmark_bound.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/objective_reasons.h"
#include "runtime/solver/performance_reasons.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/reason_trail.h"
#include "runtime/solver/restarts.h"
#include "runtime/solver/search_budget.h"

namespace cbc {

/// Finds the best solution of a hard problem by conflict-driven search: each failure is traced back
/// to the decisions it comes from, gives a no-good that rules out more than the failure itself, and
/// the search goes back to where this no-good first implies something.
///
/// The method is that of SAT solvers (J. P. Marques-Silva and K. A. Sakallah, "GRASP", IEEE
/// Transactions on Computers 48 (1999)), with propagators that explain themselves in place of
/// clauses for constraints and objectives (O. Ohrimenko, P. J. Stuckey and M. Codish, "Propagation
/// via lazy clause generation", Constraints 14 (2009)).
///
/// Its memory grows with the number of no-goods that it keeps, and is used again.
class LearningSearch {
 public:
  LearningSearch(const CompiledCatalog& catalog, Domains& domains, Objective& objective);

  /// Continues from the incumbent, if it exists, and improves it. The domains and the objective
  /// must be loaded. False if the budget ended the search.
  [[nodiscard]] bool search(const Problem& problem, Incumbent& best, bool any_solution,
                            SearchBudget& budget, SearchResult& result);

  /// After a search: leaves in the domains what holds in every solution better than the incumbent.
  void return_to_root() { backtrack_to(0); }
  /// After return_to_root: a lower bound on -log of f2 of every solution in the present domains.
  [[nodiscard]] std::int64_t bound_cost() { return bound_.bound_again(); }

 private:
  void load(const Problem& problem);
  [[nodiscard]] bool propagate(const Incumbent& best, const SearchBudget& budget);
  [[nodiscard]] bool learn();
  void backtrack_to(std::uint32_t level);
  void restart();
  [[nodiscard]] Literal decide(const Incumbent& best, const SearchBudget& budget);
  [[nodiscard]] std::uint32_t choose_task(const Incumbent& best) const;
  [[nodiscard]] std::uint32_t choose_value(std::uint32_t task, const Incumbent& best,
                                           const SearchBudget& budget);
  void save_values();

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Objective& objective_;
  ReasonTrail trail_;
  LandmarkBound bound_;
  PerformanceReasons performance_;
  ObjectiveReasons objectives_;
  const Problem* problem_ = nullptr;

  std::vector<std::uint32_t> saved_;  ///< by task: the value to try first, or none
  Activities activities_;
  Restarts restarts_;
  std::size_t most_nogoods_ = 0;
  ConflictAnalysis analysis_;
};

}  // namespace cbc
