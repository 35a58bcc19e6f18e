#include "runtime/explain/conflict_search.h"

#include <algorithm>
#include <utility>

namespace cbc {

ConflictSearch::ConflictSearch(const CompiledCatalog& catalog, std::uint32_t group,
                               const std::vector<std::uint32_t>& present, Demands demands)
    : catalog_(catalog),
      present_(present),
      demands_(std::move(demands)),
      first_task_(catalog.group_tasks[group]),
      end_task_(catalog.group_tasks[group + 1]),
      trail_(catalog, group),
      saved_(end_task_ - first_task_, none),
      is_known_fact_(trail_.variable_count(), 0),
      in_closure_(end_task_ - first_task_, 0) {
  activities_.clear(end_task_ - first_task_);
  analysis_.resize(trail_.variable_count());
}

/// As in Domains, tasks that nothing needs can be left out, so a problem is solved when each needed
/// task has one value; only to keep a performance low, a task that nothing needs may have to run.
Feasibility ConflictSearch::solve(std::span<const Reason> reasons, std::uint64_t most_effort,
                                  const Deadline& deadline) {
  const std::uint64_t effort_before = effort();
  restarts_.clear();
  is_used_.assign(reasons.size(), 0);
  used_.clear();
  sort(reasons);
  trail_.load(reasons);
  bool is_consistent = begin(reasons);
  for (;;) {
    is_consistent = is_consistent && propagate(reasons);
    if (effort() - effort_before > most_effort) return Feasibility::unknown;
    if (deadline && std::chrono::steady_clock::now() >= *deadline) return Feasibility::unknown;
    if (!is_consistent) {
      if (!learn()) return Feasibility::no;
      is_consistent = true;
      continue;
    }
    if (restarts_.is_due()) {
      restart();
      continue;
    }
    const TaskId task = choose_task();
    effort_ += (end_task_ - first_task_) / 8;
    if (task != none) {
      trail_.decide(trail_.has_value(task, choose_value(task)));
      continue;
    }
    // All needed tasks are decided, so the performance is exact.
    if (low_task_ == none || !may_reach(low_task_, low_minimum_)) return Feasibility::yes;
    const TaskId optional = optional_factor();
    if (optional != none) {
      trail_.decide(trail_.runs(optional));
    } else if (!leave_dead_end()) {
      return Feasibility::no;
    }
  }
}

std::vector<ValueId> ConflictSearch::values_of(TaskId task) {
  std::vector<ValueId> values;
  if (!trail_.is_true(trail_.runs(task))) return values;
  static_cast<void>(may_reach(task, 0));
  for (const TaskId each : closure_) {
    values.push_back(catalog_.values.begin[each] + trail_.best(each));
  }
  return values;
}

/// The demands come first: where they and the catalog alone, or with protected tasks, leave no
/// solution, the other reasons of the state are no part of the proof.
bool ConflictSearch::begin(std::span<const Reason> reasons) {
  for (const Demand& each : demands_) {
    if (!demand(each)) return false;
  }
  if (low_task_ != none && !trail_.imply(trail_.runs(low_task_), {})) return false;
  if (!trail_.propagate()) return false;
  return std::all_of(state_.begin(), state_.end(), [&](std::uint32_t index) {
    return apply(reasons[index], index) && trail_.propagate();
  });
}

bool ConflictSearch::demand(const Demand& demand) {
  switch (demand.kind) {
    case Demand::Kind::run:
      return trail_.imply(trail_.runs(demand.task), {});
    case Demand::Kind::stop:
      return trail_.imply(negate(trail_.runs(demand.task)), {});
    case Demand::Kind::has:
      return trail_.imply(trail_.has_value(demand.task, demand.value_index), {});
    case Demand::Kind::has_not:
      return trail_.imply(negate(trail_.has_value(demand.task, demand.value_index)), {});
  }
  return true;
}

/// Sorts out the reasons that the trail does not propagate.
void ConflictSearch::sort(std::span<const Reason> reasons) {
  performances_.clear();
  state_.clear();
  for (std::uint32_t index = 0; index < reasons.size(); ++index) {
    switch (reasons[index].kind) {
      case Reason::Kind::exclusive:
      case Reason::Kind::requires_task:
        break;
      case Reason::Kind::performance:
        performances_.push_back(index);
        break;
      default:
        state_.push_back(index);
        break;
    }
  }
  std::stable_sort(state_.begin(), state_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return reasons[a].kind < reasons[b].kind;  // as they are declared
  });
}

/// A reason that follows from the state.
bool ConflictSearch::apply(const Reason& reason, std::uint32_t index) {
  const RelaxedTrail::Cause cause{RelaxedTrail::Cause::Kind::given, 0, index};
  const Literal runs = reason.task == none ? 0 : trail_.runs(reason.task);
  if (reason.kind == Reason::Kind::is_protected) return trail_.imply(runs, cause);
  if (reason.kind == Reason::Kind::on_request) return trail_.imply(negate(runs), cause);
  const auto values = catalog_.performs[reason.behavior];
  return std::all_of(values.begin(), values.end(), [&](ValueId value) {
    const TaskId task = catalog_.task_of(value);
    const bool is_kept = reason.kind == Reason::Kind::unavailable &&
                         present_[task - first_task_] == value - catalog_.values.begin[task];
    return is_kept || trail_.imply(negate(trail_.has_value(value)), cause);
  });
}

bool ConflictSearch::propagate(std::span<const Reason> reasons) {
  if (!trail_.propagate()) return false;
  effort_ += performances_.size();
  return std::all_of(performances_.begin(), performances_.end(),
                     [&](std::uint32_t index) { return may_perform(reasons[index], index); });
}

/// Whether the performance can still reach the minimum. Exact where all that it depends on is
/// fixed. A required task counts only if it is needed.
bool ConflictSearch::may_perform(const Reason& reason, std::uint32_t index) {
  if (!trail_.is_true(trail_.runs(reason.task))) return true;
  literals_.clear();
  if (reason.behavior != none) {
    const auto values = catalog_.performs[reason.behavior];
    const auto found = std::find_if(values.begin(), values.end(), [this](ValueId value) {
      return trail_.is_true(trail_.has_value(value));
    });
    if (found == values.end()) return true;
    literals_.push_back(trail_.has_value(*found));
  }
  if (may_reach(reason.task, reason.minimum_performance)) return true;
  explain_performance({RelaxedTrail::Cause::Kind::given, 0, index});
  return false;
}

/// Whether the performance of a needed task may be at least `minimum`.
bool ConflictSearch::may_reach(TaskId reached, Millionths minimum) {
  closure_.assign(1, reached);
  std::fill(in_closure_.begin(), in_closure_.end(), 0);
  in_closure_[reached - first_task_] = 1;
  product_.clear();
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const TaskId task = closure_[next];
    product_.multiply(catalog_.values[task][trail_.best(task)].suitability);
    const BehaviorId behavior = trail_.fixed_behavior(task);
    if (behavior == none) continue;
    effort_ += catalog_.requirements[behavior].size();
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      const TaskId target = requirement.task;
      if (in_closure_[target - first_task_] != 0) continue;
      if (!trail_.is_true(trail_.runs(target))) continue;
      in_closure_[target - first_task_] = 1;
      closure_.push_back(target);
    }
  }
  // The cost of a multiplication grows with the number of factors.
  effort_ += in_closure_.size() / 8 + closure_.size() * closure_.size();
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) >= 0;
}

/// Makes the conflict out of what keeps the performance tested last too low: the behavior that
/// requires it, if there is one, runs (already in literals_), and all tasks of the closure run with
/// nothing more suitable.
void ConflictSearch::explain_performance(const RelaxedTrail::Cause& cause) {
  for (const TaskId task : closure_) {
    literals_.push_back(trail_.runs(task));
    const std::uint32_t best = trail_.best(task);
    // Its requirements are in the closure only because no other behavior is left.
    const std::uint32_t end = trail_.count(task) == 1 ? trail_.value_count(task) : best;
    for (std::uint32_t index = 0; index < end; ++index) {
      if (index != best) literals_.push_back(negate(trail_.has_value(task, index)));
    }
  }
  trail_.set_conflict(literals_, cause);
}

/// Learns from the conflict and goes back. False if the conflict rests on no decision: there is no
/// solution. is_used_ then says what that follows from.
bool ConflictSearch::learn() {
  const bool is_final = ConflictAnalysis::level_of(trail_.conflict(), trail_) == 0;
  begin_derivation();
  add_cause(trail_.conflict_cause());
  if (is_final) {
    trace_facts(trail_.conflict());
    return false;
  }
  analysis_.analyze(trail_.conflict(), trail_);
  for (const Literal literal : analysis_.resolved()) add_cause(trail_.cause_of(literal));
  trace_facts(analysis_.facts());
  effort_ += trail_.conflict().size() + analysis_.variables().size() + used_.size();
  note_activity();
  restarts_.note_conflict();
  trail_.backtrack_to(analysis_.back_level());
  // The literal is undecided at that level.
  static_cast<void>(trail_.learn(analysis_.learned(), analysis_.level_count(), used_));
  return true;
}

/// Learns that not all decisions can hold, where a performance is not low enough. Any reason may
/// have removed what could lower it.
bool ConflictSearch::leave_dead_end() {
  begin_derivation();
  for (std::uint32_t reason = 0; reason < is_used_.size(); ++reason) add_reason(reason);
  if (trail_.level() == 0) return false;
  literals_.clear();
  for (std::uint32_t level = trail_.level(); level > 0; --level) {
    literals_.push_back(negate(trail_.decision(level)));
  }
  effort_ += literals_.size() + used_.size();
  restarts_.note_conflict();
  trail_.backtrack_to(trail_.level() - 1);
  static_cast<void>(trail_.learn(literals_, static_cast<std::uint32_t>(literals_.size()), used_));
  return true;
}

void ConflictSearch::note_activity() {
  for (const std::uint32_t variable : analysis_.variables()) {
    activities_.note(trail_.task_of(variable) - first_task_);
  }
  activities_.age();
}

void ConflictSearch::restart() {
  trail_.backtrack_to(0);
  restarts_.restart();
}

void ConflictSearch::begin_derivation() {
  for (const std::uint32_t reason : used_) is_used_[reason] = 0;
  used_.clear();
}

void ConflictSearch::add_cause(const RelaxedTrail::Cause& cause) {
  if (cause.reason != none) add_reason(cause.reason);
  if (cause.origin == none) return;
  const std::span<const std::uint32_t> reasons = trail_.reasons_of(cause.origin);
  effort_ += reasons.size();
  for (const std::uint32_t reason : reasons) add_reason(reason);
}

void ConflictSearch::add_reason(std::uint32_t reason) {
  if (std::exchange(is_used_[reason], 1) == 0) used_.push_back(reason);
}

/// Adds the reasons that literals of level 0 follow from.
void ConflictSearch::trace_facts(std::span<const Literal> facts) {
  facts_.assign(facts.begin(), facts.end());
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < facts_.size(); ++next) {
    const Literal fact = facts_[next];
    if (std::exchange(is_known_fact_[variable_of(fact)], 1) != 0) continue;
    known_facts_.push_back(variable_of(fact));
    add_cause(trail_.cause_of(fact));
    trail_.append_reason(fact, facts_);
  }
  effort_ += facts_.size();
  for (const std::uint32_t variable : known_facts_) is_known_fact_[variable] = 0;
  known_facts_.clear();
}

/// The undecided needed task that has taken part in most of the recent conflicts; of several the
/// one with the fewest values.
TaskId ConflictSearch::choose_task() const {
  TaskId chosen = none;
  const auto is_better = [this](TaskId a, TaskId b) {
    const double activity_a = activities_[a - first_task_];
    const double activity_b = activities_[b - first_task_];
    return activity_a == activity_b ? trail_.count(a) < trail_.count(b) : activity_a > activity_b;
  };
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (!trail_.is_true(trail_.runs(task)) || trail_.count(task) < 2) continue;
    if (chosen == none || is_better(task, chosen)) chosen = task;
  }
  return chosen;
}

/// The value chosen last, or else the most suitable one.
std::uint32_t ConflictSearch::choose_value(TaskId task) {
  std::uint32_t& saved = saved_[task - first_task_];
  if (saved == none || trail_.is_false(trail_.has_value(task, saved))) saved = trail_.best(task);
  return saved;
}

/// A task that is not needed, may run, and would count in the performance tested last.
TaskId ConflictSearch::optional_factor() const {
  for (const TaskId task : closure_) {
    for (const CompiledRequirement& requirement :
         catalog_.requirements[trail_.fixed_behavior(task)]) {
      const TaskId target = requirement.task;
      if (!trail_.is_true(trail_.runs(target)) && trail_.count(target) > 0) return target;
    }
  }
  return none;
}

}  // namespace cbc
