#pragma once

#include <cstdint>
#include <vector>

#include "solver/cost_bound.h"
#include "solver/domains.h"
#include "solver/objective.h"
#include "solver/problem.h"
#include "solver/reason_trail.h"

namespace cbc {

/// Propagates "better than the incumbent" with reasons: the requests that it serves, the bound on
/// its f2, and then the exact comparison of all objectives.
class ObjectiveReasons {
 public:
  ObjectiveReasons(const Domains& domains, Objective& objective, CostBound& cost_bound,
                   ReasonTrail& trail);

  void load(const Problem& problem) { problem_ = &problem; }
  /// To be called at a fixpoint of the trail; there may be more to propagate afterwards. False: see
  /// the trail's conflict.
  [[nodiscard]] bool propagate(const Incumbent& incumbent);
  /// Computes the cost bound of the present subtree, if that is not done.
  void bound_if_stale();

 private:
  enum class Requests : std::uint8_t { worse, as_many, more };

  [[nodiscard]] Requests compare_requests(const Incumbent& incumbent) const;
  [[nodiscard]] bool serve_open_requests();
  [[nodiscard]] bool bound_costs(const CostBound::Cost& threshold);
  void explain_requests();
  void explain_grounds();
  void explain_all();

  const Domains& domains_;
  Objective& objective_;
  CostBound& cost_bound_;
  ReasonTrail& trail_;
  const Problem* problem_ = nullptr;
  std::uint64_t bounded_at_ = 0;  ///< the state of the trail at the last bound
  std::vector<Literal> reason_;
};

}  // namespace cbc
