#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "solver/cost_bound.h"
#include "solver/domains.h"
#include "solver/objective.h"
#include "solver/objective_reasons.h"
#include "solver/performance_reasons.h"
#include "solver/problem.h"
#include "solver/reason_trail.h"
#include "solver/search_budget.h"

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
  LearningSearch(const CompiledCatalog& catalog, Domains& domains, Objective& objective,
                 CostBound& cost_bound);

  /// Continues from the incumbent, if it exists, and improves it. The domains and the objective
  /// must be loaded. False if the budget ended the search.
  [[nodiscard]] bool search(const Problem& problem, Incumbent& best, bool any_solution,
                            SearchBudget& budget, SearchResult& result);

 private:
  void load(const Problem& problem);
  [[nodiscard]] bool propagate(const Incumbent& best);
  [[nodiscard]] bool learn();
  void trace_conflict();
  void note(Literal literal);
  void drop_implied_literals();
  [[nodiscard]] std::uint32_t count_levels();
  void restart();
  [[nodiscard]] Literal decide(const Incumbent& best);
  [[nodiscard]] std::uint32_t choose_task() const;
  [[nodiscard]] std::uint32_t choose_value(std::uint32_t task, const Incumbent& best);
  void save_values();

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Objective& objective_;
  CostBound& cost_bound_;
  ReasonTrail trail_;
  PerformanceReasons performance_;
  ObjectiveReasons objectives_;
  const Problem* problem_ = nullptr;

  std::vector<std::uint32_t> saved_;  ///< by task: the value to try first, or none
  std::vector<double> activities_;    ///< by task
  double increment_ = 1;

  std::uint64_t conflicts_ = 0;
  std::uint64_t restarts_ = 0;
  std::uint64_t next_restart_ = 0;
  std::size_t most_nogoods_ = 0;

  std::uint32_t conflict_level_ = 0;
  std::vector<Literal> learned_;        ///< a clause; the literal that it implies comes first
  std::vector<std::uint8_t> is_noted_;  ///< by variable: seen in the present analysis
  std::vector<std::uint32_t> noted_;
  std::uint32_t open_ = 0;  ///< noted literals of the conflict level, not yet resolved
  std::vector<Literal> reason_;
  std::vector<std::uint64_t> counted_;  ///< by level
  std::uint64_t count_number_ = 0;
};

}  // namespace cbc
