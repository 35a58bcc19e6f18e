#include "runtime/solver/objective_reasons.h"

#include <algorithm>

namespace cbc {

ObjectiveReasons::ObjectiveReasons(const CompiledCatalog& catalog, const Domains& domains,
                                   Objective& objective, LandmarkBound& bound, ReasonTrail& trail)
    : catalog_(catalog), domains_(domains), objective_(objective), bound_(bound), trail_(trail) {}

bool ObjectiveReasons::propagate(const Incumbent& incumbent, const SearchBudget& budget) {
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
  if (!bound_costs(limits, false, budget)) return false;
  if (trail_.literals().size() > before) return true;
  const Objective::Comparison comparison = objective_.compare(incumbent, 0);
  if (comparison.order < 0) return true;
  // The bound has better reasons.
  if (!bound_costs(limits, true, budget)) return false;
  if (trail_.literals().size() > before) return true;
  explain_comparison(incumbent, comparison.decider);
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
bool ObjectiveReasons::bound_costs(const CostBound::Cost& limits, bool is_final,
                                   const SearchBudget& budget) {
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
  const std::int64_t bound = bound_.raise(threshold, budget);
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

/// What the comparison rests on, up to the objective that decides: each of them is at least as bad
/// in any solution with the same facts. A solution that leaves out one more request is worse, so
/// each other request counts as running.
void ObjectiveReasons::explain_comparison(const Incumbent& incumbent, Objective::Decider decider) {
  explain_requests();
  append_needed_tasks(decider);
  if (decider < Objective::Decider::changes) return;
  // With f1 to f3 of the incumbent nothing runs but the needed tasks.
  append_activations();
  append_deactivations();
  if (decider == Objective::Decider::order) append_order(incumbent);
}

/// f2 and f3: the tasks that have to run, and that they cannot do better.
void ObjectiveReasons::append_needed_tasks(Objective::Decider decider) {
  for (const std::uint32_t task : domains_.needed_tasks()) {
    const std::uint32_t best = domains_.best(task);
    const bool is_perfect = domains_.value(task, best).suitability == one_million;
    if (is_perfect && decider == Objective::Decider::suitability) continue;
    if (!objective_.is_request(task)) reason_.push_back(ReasonTrail::runs(task));
    if (is_perfect) continue;
    append_removed_values(task, [best](std::uint32_t index) { return index < best; });
  }
}

/// f4: the values with which tasks might have shared an activation, or needed none.
void ObjectiveReasons::append_activations() {
  for (const std::uint32_t task : domains_.needed_tasks()) {
    append_removed_values(task,
                          [&](std::uint32_t index) { return objective_.is_free(task, index); });
    const std::uint32_t best = domains_.best(task);
    if (domains_.count(task) == 1 && objective_.is_free(task, best)) {
      reason_.push_back(trail_.has_value(task, best));
    }
  }
}

/// f4: the behaviors that cannot stay active.
void ObjectiveReasons::append_deactivations() {
  for (const BehaviorId behavior : problem_->active) {
    if (objective_.may_stay(behavior)) continue;
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId id = catalog_.task_of(value);
      const std::uint32_t task = id - domains_.first_task();
      if (!objective_.may_run(task)) continue;
      reason_.push_back(negate(trail_.has_value(task, value - catalog_.values.begin[id])));
    }
  }
}

/// The canonical order: up to the task that decides, no value comes before that of the incumbent;
/// of that task not even the same.
void ObjectiveReasons::append_order(const Incumbent& incumbent) {
  for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
    const std::uint32_t theirs = incumbent.assignment[task];
    const bool may_run = objective_.may_run(task);
    if (may_run) {
      const std::uint32_t key = objective_.key(task, theirs);
      append_removed_values(
          task, [&](std::uint32_t index) { return objective_.key(task, index) <= key; });
    }
    const bool may_be_equal = theirs == none ? !may_run : may_run && domains_.has(task, theirs);
    if (!may_be_equal) return;
  }
}

/// Appends that the task does not have any of the removed values that matter.
template <typename Matters>
void ObjectiveReasons::append_removed_values(std::uint32_t task, Matters matters) {
  const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
  for (std::uint32_t index = 0; index < values; ++index) {
    if (domains_.has(task, index) || !matters(index)) continue;
    reason_.push_back(negate(trail_.has_value(task, index)));
  }
}

}  // namespace cbc
