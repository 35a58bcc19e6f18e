#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/cost_bound.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/landmark_bound.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/propagation.h"
#include "runtime/solver/trail.h"

namespace cbc {

/// Propagates "better than the incumbent" with reasons: the requests that it serves, the bound on
/// its f2, and then the exact comparison of all objectives.
class ObjectiveReasons final : public LazyReasons {
 public:
  ObjectiveReasons(const Domains& domains, Objective& objective, LandmarkBound& bound,
                   Trail& trail);

  void load(const Problem& problem) { problem_ = &problem; }
  /// To be called at a fixpoint of the trail; there may be more to propagate afterwards, or if the
  /// budget has no time left. False: see the trail's conflict.
  [[nodiscard]] bool propagate(const Incumbent& incumbent, const SearchBudget& budget = {});

  /// Of a removed value: that it costs too much.
  void append_reason(Literal literal, std::uint32_t data,
                     std::vector<Literal>& reason) const override;

 private:
  [[nodiscard]] bool may_serve_more(const Incumbent& incumbent) const;
  [[nodiscard]] bool serve_open_requests();
  [[nodiscard]] bool bound_costs(const CostBound::Cost& limits, bool is_final,
                                 const SearchBudget& budget);
  void append_lost_requests(std::size_t end, std::vector<Literal>& reason) const;
  void explain_requests();
  void explain_comparison(const Incumbent& incumbent, Objective::Decider decider);
  void append_needed_tasks(Objective::Decider decider);
  void append_activations();
  void append_order(const Incumbent& incumbent);

  const Domains& domains_;
  Objective& objective_;
  LandmarkBound& bound_;
  Trail& trail_;
  const Problem* problem_ = nullptr;
  std::vector<Literal> reason_;
};

/// Finds the best solution of a hard problem by conflict-driven search. Its memory grows with the
/// number of no-goods that it keeps, and is used again.
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
  [[nodiscard]] LocalTask choose_task(const Incumbent& best) const;
  [[nodiscard]] std::uint32_t choose_value(LocalTask task, const Incumbent& best,
                                           const SearchBudget& budget);
  void save_values();

  const CompiledCatalog& catalog_;
  Domains& domains_;
  Objective& objective_;
  CatalogTrail trail_;
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
