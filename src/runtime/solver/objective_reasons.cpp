#include "solver/objective_reasons.h"

#include <algorithm>

namespace cbc {

ObjectiveReasons::ObjectiveReasons(const Domains& domains, Objective& objective,
                                   LandmarkBound& bound, ReasonTrail& trail)
    : domains_(domains), objective_(objective), bound_(bound), trail_(trail) {}

bool ObjectiveReasons::propagate(const Incumbent& incumbent) {
  if (objective_.compare_requests(incumbent) > 0) {
    explain_requests();
    trail_.set_conflict(reason_);
    return false;
  }
  if (may_serve_more(incumbent)) return true;
  const std::size_t before = trail_.literals().size();
  if (!serve_open_requests()) return false;
  if (trail_.literals().size() > before || !objective_.ties_on_requests(incumbent)) return true;
  const CostBound::Cost limits = pruning_threshold(incumbent, domains_.task_count());
  if (!bound_costs(limits, false)) return false;
  if (trail_.literals().size() > before || objective_.may_beat(incumbent, 0)) return true;
  // The bound has better reasons.
  if (!bound_costs(limits, true)) return false;
  if (trail_.literals().size() > before) return true;
  explain_all();
  trail_.set_conflict(reason_);
  return false;
}

bool ObjectiveReasons::may_serve_more(const Incumbent& incumbent) const {
  const auto possible = std::count_if(
      problem_->requests.begin(), problem_->requests.end(),
      [this](std::uint32_t task) { return !trail_.is_false(ReasonTrail::runs(task)); });
  return static_cast<std::uint32_t>(possible) > incumbent.satisfied;
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

/// Refutes the subtree, or removes the values that cost too much.
bool ObjectiveReasons::bound_costs(const CostBound::Cost& limits, bool is_final) {
  if (limits.log == INT64_MAX) return true;
  const bool is_idle = limits.idle != INT64_MAX;
  bound_.set_measure(is_idle ? LandmarkBound::Measure::idle : LandmarkBound::Measure::log);
  const std::int64_t threshold = is_idle ? limits.idle : limits.log;
  // Not at every level: the bound grows little with one decision, and takes most of the time.
  constexpr std::uint32_t levels_between_bounds = 2;
  const std::uint32_t last = bound_.level();
  if (!is_final && last != none && trail_.level() > last &&
      trail_.level() < last + levels_between_bounds) {
    return true;
  }
  const std::int64_t bound = bound_.raise(threshold);
  if (bound > threshold) {
    explain_requests();
    bound_.append_grounds(bound - threshold - 1, reason_);
    trail_.set_conflict(reason_);
    return false;
  }
  if (bound + bound_.highest_cost() <= threshold) return true;
  for (const std::uint32_t task : bound_.relevant_tasks()) {
    const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      const std::int64_t with_value = bound + bound_.residual(task, index);
      if (with_value <= threshold || !domains_.has(task, index)) continue;
      const Literal value = trail_.has_value(task, index);
      if (trail_.is_true(value)) continue;
      const ReasonTrail::Reason reason{ReasonTrail::Reason::Kind::lazy,
                                       bound_.save_grounds(with_value - threshold - 1)};
      if (!trail_.imply(negate(value), reason)) return false;
    }
  }
  return true;
}

void ObjectiveReasons::append_reason(Literal literal, std::uint32_t data,
                                     std::vector<Literal>& reason) const {
  append_lost_requests(trail_.place_of(literal), reason);
  bound_.append_saved_grounds(data, reason);
}

/// No more requests can be served than the ones that are not ruled out.
void ObjectiveReasons::explain_requests() {
  reason_.clear();
  append_lost_requests(trail_.literals().size(), reason_);
}

/// Appends the requests that were ruled out before the place `end` of the trail.
void ObjectiveReasons::append_lost_requests(std::size_t end, std::vector<Literal>& reason) const {
  for (const std::uint32_t task : problem_->requests) {
    const Literal stops = negate(ReasonTrail::runs(task));
    if (trail_.is_true(stops) && trail_.place_of(stops) < end) reason.push_back(stops);
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
