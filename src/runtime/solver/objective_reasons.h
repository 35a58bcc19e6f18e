#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/solver/cost_bound.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/landmark_bound.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/reason_trail.h"
#include "runtime/solver/search_budget.h"

namespace cbc {

/// Propagates "better than the incumbent" with reasons: the requests that it serves, the bound on
/// its f2, and then the exact comparison of all objectives.
class ObjectiveReasons final : public LazyReasons {
 public:
  ObjectiveReasons(const CompiledCatalog& catalog, const Domains& domains, Objective& objective,
                   LandmarkBound& bound, ReasonTrail& trail);

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
  void append_deactivations();
  void append_order(const Incumbent& incumbent);
  template <typename Matters>
  void append_removed_values(std::uint32_t task, Matters matters);

  const CompiledCatalog& catalog_;
  const Domains& domains_;
  Objective& objective_;
  LandmarkBound& bound_;
  ReasonTrail& trail_;
  const Problem* problem_ = nullptr;
  std::vector<Literal> reason_;
};

}  // namespace cbc
