// Conflict-driven search: each failure is traced back to the decisions that it comes from, and
// gives a no-good that rules out more than the failure itself; the search goes back to where this
// no-good first implies something. That is the method of SAT solvers (J. P. Marques-Silva and K. A.
// Sakallah, "GRASP", IEEE Transactions on Computers 48 (1999)), with propagators that explain
// themselves in place of clauses for constraints and objectives (O. Ohrimenko, P. J. Stuckey and
// M. Codish, "Propagation via lazy clause generation", Constraints 14 (2009)).
//
// Branch and bound with a stronger bound would refute the same few choices again and again, under
// each combination of decisions that have no part in the failure. And a SAT solver as it is would
// need clauses for sums of logarithms, that is, for f2: far more of them than the catalog has
// constraints, and still not exact.
#include "runtime/solver/learning_search.h"

#include <algorithm>

namespace cbc {

LearningSearch::LearningSearch(const CompiledCatalog& catalog, Domains& domains,
                               Objective& objective)
    : catalog_(catalog),
      domains_(domains),
      objective_(objective),
      trail_(catalog, domains),
      bound_(catalog, domains, trail_),
      performance_(catalog, domains, trail_),
      objectives_(domains, objective, bound_, trail_) {
  trail_.set_lazy_reasons(objectives_);
}

void LearningSearch::load(const Problem& problem) {
  problem_ = &problem;
  performance_.load();
  objectives_.load(problem);
  saved_.assign(problem.present.begin(), problem.present.end());
  activities_.clear(domains_.task_count());
  restarts_.clear();
  most_nogoods_ = 2000;
}

bool LearningSearch::search(const Problem& problem, Incumbent& best, bool any_solution,
                            SearchBudget& budget, SearchResult& result) {
  load(problem);
  const std::uint64_t propagations_before = result.propagations - trail_.propagations();
  bool is_consistent = trail_.load(problem);
  bound_.load();
  analysis_.resize(trail_.variable_count());
  for (;;) {
    is_consistent = is_consistent && propagate(best, budget);
    result.propagations = propagations_before + trail_.propagations();
    if (budget.is_out_of_time()) return false;
    if (!is_consistent) {
      if (!learn()) return true;
      is_consistent = true;
      if (budget.is_spent(result.nodes)) return false;
      continue;
    }
    if (restarts_.is_due()) {
      restart();
      continue;
    }
    const Literal decision = decide(best, budget);
    if (decision == none) {
      ++result.solutions;
      objective_.record(best);
      save_values();
      if (any_solution) return true;
      continue;
    }
    if (budget.is_spent(result.nodes)) return false;
    ++result.nodes;
    bound_.begin_level();
    trail_.decide(decision);
  }
}

/// False if there is a conflict. Without time left there may be more to propagate.
bool LearningSearch::propagate(const Incumbent& best, const SearchBudget& budget) {
  for (;;) {
    if (budget.is_out_of_time()) return true;
    if (!trail_.propagate()) return false;
    const std::size_t before = trail_.literals().size();
    if (!performance_.propagate(budget)) return false;
    if (trail_.literals().size() > before) continue;
    if (best.exists && !objectives_.propagate(best, budget)) return false;
    if (trail_.literals().size() == before) return true;
  }
}

/// Learns from the conflict and goes back. False if the conflict rests on no decision: nothing
/// better is left.
bool LearningSearch::learn() {
  restarts_.note_conflict();
  const std::uint32_t level = ConflictAnalysis::level_of(trail_.conflict(), trail_);
  if (level == 0) return false;
  save_values();
  backtrack_to(level);
  analysis_.analyze(trail_.conflict(), trail_);
  for (const Literal literal : analysis_.resolved()) trail_.note_use_of_reason(literal);
  activities_.note_conflict(analysis_.variables(), trail_);
  trail_.nogoods().age();
  backtrack_to(analysis_.back_level());
  return trail_.learn(analysis_.learned(), analysis_.level_count());
}

void LearningSearch::backtrack_to(std::uint32_t level) {
  trail_.backtrack_to(level);
  bound_.backtrack_to(level);
}

void LearningSearch::restart() {
  backtrack_to(0);
  restarts_.restart();
  if (trail_.nogoods().size() <= most_nogoods_) return;
  trail_.nogoods().forget_half();
  most_nogoods_ += most_nogoods_ / 8;
}

/// The next literal to decide; none if all is decided that a best solution may contain. Requests
/// come first, the most important one first.
Literal LearningSearch::decide(const Incumbent& best, const SearchBudget& budget) {
  for (const LocalTask task : problem_->requests) {
    const Literal runs = Trail::runs(task);
    if (!trail_.is_true(runs) && !trail_.is_false(runs)) return runs;
  }
  const LocalTask task = choose_task(best);
  return task == none ? none : trail_.has_value(task, choose_value(task, best, budget));
}

/// Before the first solution: the undecided needed task that has taken part in most of the recent
/// conflicts. After it: one of the highest level, since what a task requires hardly costs anything
/// in the bound until it is known.
LocalTask LearningSearch::choose_task(const Incumbent& best) const {
  LocalTask chosen = none;
  const auto level_of = [this](LocalTask task) {
    return catalog_.tasks[domains_.first_task() + task].level;
  };
  const auto is_better = [&](LocalTask task) {
    const bool is_more_active = activities_[task] > activities_[chosen];
    if (level_of(task) == level_of(chosen)) return is_more_active;
    const bool is_higher = level_of(task) > level_of(chosen);
    if (best.exists || activities_[task] == activities_[chosen]) return is_higher;
    return is_more_active;
  };
  for (const LocalTask task : domains_.needed_tasks()) {
    if (domains_.count(task) > 1 && (chosen == none || is_better(task))) chosen = task;
  }
  return chosen;
}

/// The value of the least estimated cost; before the first solution rather the one saved.
std::uint32_t LearningSearch::choose_value(LocalTask task, const Incumbent& best,
                                           const SearchBudget& budget) {
  const std::uint32_t saved = saved_[task];
  if (!best.exists && saved != none && domains_.has(task, saved)) return saved;
  if (bound_.level() == none) static_cast<void>(bound_.raise(INT64_MAX, budget));
  std::uint32_t chosen = none;
  std::int64_t least = 0;
  for (const std::uint32_t index : domains_.indices(task)) {
    const std::int64_t cost = bound_.estimate(task, index);
    if (chosen == none || cost < least || (cost == least && index == saved)) {
      chosen = index;
      least = cost;
    }
  }
  return chosen;
}

/// Saves the values of the tasks that have one, to try them first next time.
void LearningSearch::save_values() {
  for (const LocalTask task : domains_.needed_tasks()) {
    if (domains_.count(task) == 1) saved_[task] = domains_.best(task);
  }
}

ObjectiveReasons::ObjectiveReasons(const Domains& domains, Objective& objective,
                                   LandmarkBound& bound, Trail& trail)
    : domains_(domains), objective_(objective), bound_(bound), trail_(trail) {}

bool ObjectiveReasons::propagate(const Incumbent& incumbent, const SearchBudget& budget) {
  if (objective_.compare_requests(incumbent) > 0) {
    explain_requests();
    trail_.set_conflict(reason_, {});
    return false;
  }
  if (may_serve_more(incumbent)) return true;
  const std::size_t before = trail_.literals().size();
  if (!serve_open_requests()) return false;
  if (trail_.literals().size() > before || !objective_.ties_before_suitability(incumbent))
    return true;
  const CostBound::Cost limits = pruning_threshold(incumbent, domains_.task_count());
  if (!bound_costs(limits, false, budget)) return false;
  if (trail_.literals().size() > before) return true;
  const Objective::Comparison comparison = objective_.compare(incumbent, 0);
  if (comparison.order < 0) return true;
  // The bound has better reasons.
  if (!bound_costs(limits, true, budget)) return false;
  if (trail_.literals().size() > before) return true;
  explain_comparison(incumbent, comparison.decider);
  trail_.set_conflict(reason_, {});
  return false;
}

bool ObjectiveReasons::may_serve_more(const Incumbent& incumbent) const {
  const auto counted = problem_->counted_requests();
  const auto possible = std::count_if(counted.begin(), counted.end(), [this](LocalTask task) {
    return !trail_.is_false(Trail::runs(task));
  });
  return static_cast<std::uint32_t>(possible) > incumbent.satisfied;
}

/// To leave out one more request would be worse.
bool ObjectiveReasons::serve_open_requests() {
  bool is_stored = false;
  Trail::Cause reason;
  for (const LocalTask task : problem_->counted_requests()) {
    const Literal runs = Trail::runs(task);
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
    trail_.set_conflict(reason_, {});
    return false;
  }
  if (bound + bound_.highest_cost() <= threshold) return true;
  for (const LocalTask task : bound_.relevant_tasks()) {
    for (const std::uint32_t index : domains_.indices(task)) {
      const std::int64_t with_value = bound + bound_.residual(task, index);
      if (with_value <= threshold) continue;
      const Literal value = trail_.has_value(task, index);
      if (trail_.is_true(value)) continue;
      const Trail::Cause reason{Trail::Cause::Kind::lazy,
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
  for (const LocalTask task : problem_->requests) {
    const Literal stops = negate(Trail::runs(task));
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
  if (decider == Objective::Decider::order) append_order(incumbent);
}

/// f2 and f3: the tasks that have to run, and that they cannot do better.
void ObjectiveReasons::append_needed_tasks(Objective::Decider decider) {
  for (const LocalTask task : domains_.needed_tasks()) {
    const std::uint32_t best = domains_.best(task);
    const bool is_perfect = domains_.value(task, best).suitability == one_million;
    if (is_perfect && decider == Objective::Decider::suitability) continue;
    if (!objective_.is_request(task)) reason_.push_back(Trail::runs(task));
    if (is_perfect) continue;
    trail_.append_removals(
        task, [best](std::uint32_t index) { return index < best; }, reason_);
  }
}

/// f4: the values with which tasks might have shared an activation, or needed none. Those of active
/// behaviors are among them, so that no behavior can stay that cannot stay now.
void ObjectiveReasons::append_activations() {
  for (const LocalTask task : domains_.needed_tasks()) {
    trail_.append_removals(
        task, [&](std::uint32_t index) { return objective_.is_free(task, index); }, reason_);
    const std::uint32_t best = domains_.best(task);
    if (domains_.count(task) == 1 && objective_.is_free(task, best)) {
      reason_.push_back(trail_.has_value(task, best));
    }
  }
}

/// The canonical order: up to the task that decides, no value comes before that of the incumbent;
/// of that task not even the same.
void ObjectiveReasons::append_order(const Incumbent& incumbent) {
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    const std::uint32_t theirs = incumbent.assignment[task];
    const bool may_run = objective_.may_run(task);
    if (may_run) {
      const std::uint32_t key = objective_.key(task, theirs);
      trail_.append_removals(
          task, [&](std::uint32_t index) { return objective_.key(task, index) <= key; }, reason_);
    }
    const bool may_be_equal = theirs == none ? !may_run : may_run && domains_.has(task, theirs);
    if (!may_be_equal) return;
  }
}

}  // namespace cbc
