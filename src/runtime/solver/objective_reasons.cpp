#include "solver/objective_reasons.h"

namespace cbc {

ObjectiveReasons::ObjectiveReasons(const Domains& domains, Objective& objective,
                                   CostBound& cost_bound, ReasonTrail& trail)
    : domains_(domains), objective_(objective), cost_bound_(cost_bound), trail_(trail) {}

bool ObjectiveReasons::propagate(const Incumbent& incumbent) {
  switch (compare_requests(incumbent)) {
    case Requests::worse:
      explain_requests();
      trail_.set_conflict(reason_);
      return false;
    case Requests::more:
      return true;
    case Requests::as_many:
      break;
  }
  const std::size_t before = trail_.literals().size();
  if (!serve_open_requests()) return false;
  if (trail_.literals().size() > before || !objective_.ties_on_requests(incumbent)) return true;
  if (!bound_costs(pruning_threshold(incumbent, domains_.task_count()))) return false;
  if (trail_.literals().size() > before || objective_.may_beat(incumbent, 0)) return true;
  explain_all();
  trail_.set_conflict(reason_);
  return false;
}

/// How many requests may be served, against the incumbent; where as many, which of them.
ObjectiveReasons::Requests ObjectiveReasons::compare_requests(const Incumbent& incumbent) const {
  std::uint32_t possible = 0;
  bool is_decided = false;
  bool is_worse = false;
  for (const std::uint32_t task : problem_->requests) {
    const bool ours = !trail_.is_false(ReasonTrail::runs(task));
    if (ours) ++possible;
    if (is_decided || ours == (incumbent.assignment[task] != none)) continue;
    is_decided = true;
    is_worse = !ours;
  }
  if (possible != incumbent.satisfied) {
    return possible < incumbent.satisfied ? Requests::worse : Requests::more;
  }
  return is_worse ? Requests::worse : Requests::as_many;
}

/// To leave out one more request would be worse.
bool ObjectiveReasons::serve_open_requests() {
  bool is_stored = false;
  ReasonTrail::Reason reason;
  for (const std::uint32_t task : problem_->requests) {
    const Literal runs = ReasonTrail::runs(task);
    if (trail_.is_true(runs) || trail_.is_false(runs)) continue;
    if (!is_stored) {
      explain_requests();
      reason = trail_.store(reason_);
      is_stored = true;
    }
    if (!trail_.imply(runs, reason)) return false;
  }
  return true;
}

void ObjectiveReasons::bound_if_stale() {
  if (bounded_at_ == trail_.version()) return;
  static_cast<void>(cost_bound_.bound({INT64_MAX, INT64_MAX}, CostBound::Roots::in_component));
  bounded_at_ = trail_.version();
}

/// Refutes the subtree, or removes the values that cost too much.
bool ObjectiveReasons::bound_costs(const CostBound::Cost& threshold) {
  if (threshold.log == INT64_MAX) return true;
  const CostBound::Cost bound = cost_bound_.bound_with_grounds(threshold);
  bounded_at_ = trail_.version();
  if (bound > threshold) {
    explain_grounds();
    trail_.set_conflict(reason_);
    return false;
  }
  bool is_stored = false;
  ReasonTrail::Reason reason;
  for (const std::uint32_t task : cost_bound_.grounds().opened) {
    const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      const Literal value = trail_.has_value(task, index);
      if (trail_.is_true(value) || trail_.is_false(value)) continue;
      CostBound::Cost with_value = bound;
      with_value += cost_bound_.least_increase(task, index);
      if (with_value <= threshold) continue;
      if (!is_stored) {
        explain_grounds();
        reason = trail_.store(reason_);
        is_stored = true;
      }
      if (!trail_.imply(negate(value), reason)) return false;
    }
  }
  return true;
}

/// No more requests can be served than the ones that are not ruled out.
void ObjectiveReasons::explain_requests() {
  reason_.clear();
  for (const std::uint32_t task : problem_->requests) {
    const Literal stops = negate(ReasonTrail::runs(task));
    if (trail_.is_true(stops)) reason_.push_back(stops);
  }
}

void ObjectiveReasons::explain_grounds() {
  explain_requests();
  for (const std::uint32_t task : cost_bound_.grounds().needed) {
    reason_.push_back(ReasonTrail::runs(task));
  }
  for (const auto& [task, index] : cost_bound_.grounds().removed) {
    reason_.push_back(negate(trail_.has_value(task, index)));
  }
}

/// The comparison of f3, f4 and ranks looks at all that is left for the needed tasks. Others do not
/// run where f1 to f3 are those of the incumbent.
void ObjectiveReasons::explain_all() {
  explain_requests();
  for (const std::uint32_t task : domains_.needed_tasks()) {
    reason_.push_back(ReasonTrail::runs(task));
    const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      if (!domains_.has(task, index)) reason_.push_back(negate(trail_.has_value(task, index)));
    }
  }
}

}  // namespace cbc
