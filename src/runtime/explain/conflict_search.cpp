#include "explain/conflict_search.h"

#include <algorithm>
#include <utility>

namespace cbc {

RelaxedProblem::RelaxedProblem(const CompiledCatalog& catalog, std::uint32_t group,
                               const std::vector<std::uint32_t>& present, Demands demands)
    : catalog_(catalog),
      present_(present),
      demands_(std::move(demands)),
      first_task_(catalog.group_tasks[group]),
      end_task_(catalog.group_tasks[group + 1]),
      first_value_(catalog.values.begin[first_task_]),
      has_changed_(end_task_ - first_task_, 0),
      in_closure_(end_task_ - first_task_, 0) {}

/// Depth first over what is left. As in Domains, a task that nothing needs can be left out, so a
/// subtree is solved when each needed task has one value; only to keep a performance low, something
/// that nothing needs may have to run.
Feasibility RelaxedProblem::solve(std::span<const Reason> reasons) {
  constexpr std::size_t most_nodes = 10'000;
  constexpr std::uint64_t most_effort = 50'000'000;
  const std::uint64_t effort_before = effort_;
  is_used_.assign(reasons.size(), 0);
  culprits_.assign(1, 0);
  open_.clear();
  sort(reasons);
  forget_changes();
  Branch now;
  if (!begin(now.domains, reasons)) {
    blame(now.domains, reasons);
    return Feasibility::no;
  }
  for (std::size_t nodes = 0;; ++nodes) {
    if (nodes == most_nodes || effort_ - effort_before > most_effort) return Feasibility::unknown;
    effort_ += now.domains.values.size() / 8;  // they are copied, many at once
    if (!propagate(now.domains, reasons)) {
      blame(now.domains, reasons);
      if (!back_up(now)) return Feasibility::no;
      continue;
    }
    const TaskId task = choose(now.domains);
    if (task != none) {
      decide(now, task);
      continue;
    }
    // All that runs is decided, so the performance is exact.
    if (low_task_ == none || !may_reach(now.domains, low_task_, low_minimum_)) {
      return Feasibility::yes;
    }
    const TaskId optional = optional_factor(now.domains);
    if (optional != none) {
      decide_whether_to_run(now, optional);
      continue;
    }
    // Anything may be why there is nothing to lower it with.
    std::fill(is_used_.begin(), is_used_.end(), 1);
    std::fill(culprits_.begin(), culprits_.end(), 1);
    if (!back_up(now)) return Feasibility::no;
  }
}

/// Goes on with the most suitable value of a task; then without it.
void RelaxedProblem::decide(Branch& now, TaskId task) {
  Branch& other = branch(now, task);
  const std::uint32_t chosen = best(now.domains, task);
  // Another value is left in the one, and this value in the other, so no removal fails.
  (void)remove(other.domains, task, chosen);
  for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
    if (place != chosen) (void)remove(now.domains, task, place);
  }
}

void RelaxedProblem::decide_whether_to_run(Branch& now, TaskId task) {
  Branch& other = branch(now, task);
  // One that is not needed can be closed, and one that is open can be needed.
  (void)close(other.domains, task);
  (void)need(now.domains, task);
}

/// Leaves a copy for later. What is decided next, on the task, is the decision of the new level.
RelaxedProblem::Branch& RelaxedProblem::branch(Branch& now, TaskId task) {
  ++now.level;
  now.decided = task;
  cause_ = first_decision + now.level;
  culprits_.resize(std::max<std::size_t>(culprits_.size(), now.level + 1), 0);
  culprits_before_.resize(culprits_.size());
  open_.push_back(now);
  return open_.back();
}

/// Goes on with the other branch of the last decision that had a part in the failure, as those
/// after it change nothing. False if there is none: then there is no solution.
bool RelaxedProblem::back_up(Branch& now) {
  for (std::size_t level = culprits_.size() - 1; level > 0; --level) {
    if (culprits_[level] == 0) continue;
    culprits_[level] = 0;
    while (!open_.empty() && open_.back().level > level) open_.pop_back();
    if (!open_.empty() && open_.back().level == level) {
      now = std::move(open_.back());
      open_.pop_back();
      forget_changes();
      note_change(now.decided);
      culprits_before_[level] = std::exchange(culprits_, std::vector<std::uint8_t>(level + 1, 0));
      return true;
    }
    // Both branches have failed.
    const std::vector<std::uint8_t>& before = culprits_before_[level];
    for (std::size_t place = 0; place < level; ++place) culprits_[place] |= before[place];
  }
  return false;
}

bool RelaxedProblem::begin(Domains& domains, std::span<const Reason> reasons) {
  domains.values.assign(catalog_.values.begin[end_task_] - first_value_, 1);
  domains.needed.assign(end_task_ - first_task_, 0);
  domains.removed_by.assign(domains.values.size(), none);
  domains.needed_by.assign(domains.needed.size(), none);
  domains.needed_through.assign(domains.needed.size(), none);
  effort_ += domains.values.size();
  cause_ = none;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    note_change(task);  // everything is to be looked at once
    domains.counts.push_back(static_cast<std::uint32_t>(catalog_.values[task].size()));
  }
  for (const Demand& each : demands_) {
    if (!demand(domains, each)) return false;
  }
  if (low_task_ != none && !need(domains, low_task_)) return false;
  if (!follow_changes(domains, reasons)) return false;
  for (const std::uint32_t place : state_) {
    cause_ = place;
    if (!apply_state(domains, reasons[place]) || !follow_changes(domains, reasons)) return false;
  }
  return true;
}

bool RelaxedProblem::apply_state(Domains& domains, const Reason& reason) {
  if (reason.kind == Reason::Kind::is_protected) return need(domains, reason.task);
  if (reason.kind == Reason::Kind::on_request) return close(domains, reason.task);
  for (const ValueId id : catalog_.performs[reason.behavior]) {
    const TaskId task = catalog_.task_of(id);
    const std::uint32_t place = id - catalog_.values.begin[task];
    const bool is_kept =
        reason.kind == Reason::Kind::unavailable && present_[task - first_task_] == place;
    if (!is_kept && !remove(domains, task, place)) return false;
  }
  return true;
}

bool RelaxedProblem::demand(Domains& domains, const Demand& demand) {
  switch (demand.kind) {
    case Demand::Kind::run:
      return need(domains, demand.task);
    case Demand::Kind::stop:
      return close(domains, demand.task);
    case Demand::Kind::has:
      if (!need(domains, demand.task)) return false;
      for (std::uint32_t place = 0; place < catalog_.values[demand.task].size(); ++place) {
        if (place != demand.place && !remove(domains, demand.task, place)) return false;
      }
      return true;
    case Demand::Kind::has_not:
      return remove(domains, demand.task, demand.place);
  }
  return true;
}

bool RelaxedProblem::remove(Domains& domains, TaskId task, std::uint32_t place) {
  std::uint8_t& is_left = domains.values[value(task, place)];
  if (is_left == 0) return true;
  is_left = 0;
  domains.removed_by[value(task, place)] = cause_;
  note_change(task);
  dead_end_ = task;
  return --domains.counts[task - first_task_] > 0 || !is_needed(domains, task);
}

bool RelaxedProblem::close(Domains& domains, TaskId task) {
  for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
    if (!remove(domains, task, place)) return false;
  }
  dead_end_ = task;
  return !is_needed(domains, task);
}

bool RelaxedProblem::need(Domains& domains, TaskId task) {
  if (!is_needed(domains, task)) {
    note_change(task);
    domains.needed[task - first_task_] = 1;
    domains.needed_by[task - first_task_] = cause_;
    domains.needed_through[task - first_task_] = through_;
  }
  dead_end_ = task;
  return domains.counts[task - first_task_] > 0;
}

/// Sorts the reasons by what they have to be looked at after. Those of the state come last: where
/// the catalog alone, or with protected tasks, leaves no solution, they are no part of the proof.
void RelaxedProblem::sort(std::span<const Reason> reasons) {
  reasons_of_task_.resize(end_task_ - first_task_);
  for (std::vector<std::uint32_t>& places : reasons_of_task_) places.clear();
  performances_.clear();
  state_.clear();
  const auto add = [this](TaskId task, std::uint32_t place) {
    reasons_of_task_[task - first_task_].push_back(place);
  };
  for (std::uint32_t place = 0; place < reasons.size(); ++place) {
    const Reason& reason = reasons[place];
    switch (reason.kind) {
      case Reason::Kind::exclusive:
        add(reason.task, place);
        add(reason.other_task, place);
        break;
      case Reason::Kind::requires_task:
        add(reason.task, place);
        for (const ValueId id : catalog_.performs[reason.behavior]) {
          add(catalog_.task_of(id), place);
        }
        break;
      case Reason::Kind::performance:
        performances_.push_back(place);
        break;
      default:
        state_.push_back(place);
        break;
    }
  }
  std::stable_sort(state_.begin(), state_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return reasons[a].kind < reasons[b].kind;  // as they are declared
  });
  effort_ += reasons.size() + reasons_of_task_.size();
}

void RelaxedProblem::note_change(TaskId task) {
  if (std::exchange(has_changed_[task - first_task_], 1) == 0) changed_.push_back(task);
}

void RelaxedProblem::forget_changes() {
  for (const TaskId task : changed_) has_changed_[task - first_task_] = 0;
  changed_.clear();
}

bool RelaxedProblem::propagate(Domains& domains, std::span<const Reason> reasons) {
  if (!follow_changes(domains, reasons)) return false;
  effort_ += performances_.size();
  for (const std::uint32_t place : performances_) {
    cause_ = place;
    if (!may_perform(domains, reasons[place])) return false;
  }
  return true;
}

/// Applies exclusions and requirements until nothing changes any more.
bool RelaxedProblem::follow_changes(Domains& domains, std::span<const Reason> reasons) {
  // In the order of the changes: that makes short proofs.
  std::size_t next = 0;
  while (next < changed_.size()) {
    const TaskId task = changed_[next++];
    has_changed_[task - first_task_] = 0;
    const std::vector<std::uint32_t>& places = reasons_of_task_[task - first_task_];
    effort_ += places.size();
    for (const std::uint32_t place : places) {
      cause_ = place;
      if (!apply(domains, reasons[place])) return false;
    }
  }
  changed_.clear();
  return true;
}

/// An exclusion or a requirement.
bool RelaxedProblem::apply(Domains& domains, const Reason& reason) {
  if (reason.kind == Reason::Kind::requires_task) return apply_requirement(domains, reason);
  if (is_needed(domains, reason.task) && !close(domains, reason.other_task)) return false;
  return !is_needed(domains, reason.other_task) || close(domains, reason.task);
}

bool RelaxedProblem::apply_requirement(Domains& domains, const Reason& reason) {
  effort_ += catalog_.performs[reason.behavior].size();
  for (const ValueId id : catalog_.performs[reason.behavior]) {
    const TaskId task = catalog_.task_of(id);
    const std::uint32_t place = id - catalog_.values.begin[task];
    if (domains.values[value(task, place)] == 0) continue;
    if (is_fixed(domains, task)) {
      through_ = id;
      if (!need(domains, reason.task)) return false;
    } else if (domains.counts[reason.task - first_task_] == 0) {
      if (!remove(domains, task, place)) return false;
    }
  }
  return true;
}

/// Whether the performance can still reach the minimum: exact where all that it depends on is
/// fixed. Required tasks count if they run.
bool RelaxedProblem::may_perform(const Domains& domains, const Reason& reason) {
  if (!is_needed(domains, reason.task)) return true;
  through_ = none;
  if (reason.behavior != none) {
    const auto performed = catalog_.performs[reason.behavior];
    const auto found = std::find_if(performed.begin(), performed.end(), [&](ValueId id) {
      return fixed_behavior(domains, catalog_.task_of(id)) == reason.behavior;
    });
    if (found == performed.end()) return true;
    through_ = *found;
  }
  dead_end_ = none;
  return may_reach(domains, reason.task, reason.minimum_performance);
}

/// Whether the performance of a needed task may be `minimum` at least.
bool RelaxedProblem::may_reach(const Domains& domains, TaskId reached, Millionths minimum) {
  closure_.assign(1, reached);
  std::fill(in_closure_.begin(), in_closure_.end(), 0);
  in_closure_[reached - first_task_] = 1;
  product_.clear();
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const TaskId task = closure_[next];
    product_.multiply(catalog_.values[task][best(domains, task)].suitability);
    const BehaviorId behavior = fixed_behavior(domains, task);
    if (behavior == none) continue;
    effort_ += catalog_.requirements[behavior].size();
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      const TaskId target = requirement.task;
      if (!is_needed(domains, target) || in_closure_[target - first_task_] != 0) continue;
      in_closure_[target - first_task_] = 1;
      closure_.push_back(target);
    }
  }
  // A product grows with each factor.
  effort_ += in_closure_.size() / 8 + closure_.size() * closure_.size();
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) >= 0;
}

/// Marks the reasons and decisions that a failure of the propagation comes from: those of the facts
/// that make it, those of the facts that these come from, and so on.
void RelaxedProblem::blame(const Domains& domains, std::span<const Reason> reasons) {
  facts_.clear();
  is_known_fact_.assign(domains.values.size() + domains.needed.size(), 0);
  effort_ += is_known_fact_.size() / 8;
  if (dead_end_ != none) {
    blame_running(dead_end_);
    blame_removals(dead_end_, none);
  } else {
    blame_performance(domains);
  }
  std::size_t next = 0;
  while (next < facts_.size()) {
    const std::size_t fact = facts_[next++];
    const bool is_removal = fact < domains.values.size();
    const auto of_task = static_cast<TaskId>(fact - domains.values.size());
    const std::uint32_t cause = is_removal ? domains.removed_by[fact] : domains.needed_by[of_task];
    if (cause == none) continue;
    if (cause >= first_decision) {
      culprits_[cause - first_decision] = 1;
      continue;
    }
    is_used_[cause] = 1;
    const Reason& reason = reasons[cause];
    if (reason.kind == Reason::Kind::exclusive) {
      const TaskId removed = catalog_.task_of(first_value_ + static_cast<ValueId>(fact));
      blame_running(removed == reason.task ? reason.other_task : reason.task);
    } else if (reason.kind == Reason::Kind::requires_task && is_removal) {
      blame_removals(reason.task, none);
    } else if (reason.kind == Reason::Kind::requires_task) {
      blame_fixed(domains.needed_through[of_task]);
    }
  }
  effort_ += facts_.size();
}

/// The performance that was looked at last is too low: as a task runs with the behavior that
/// requires it, if one does, and as all that is in its closure runs, and with nothing better.
void RelaxedProblem::blame_performance(const Domains& domains) {
  is_used_[cause_] = 1;
  if (through_ != none) blame_fixed(through_);
  for (const TaskId task : closure_) {
    blame_running(task);
    const std::uint32_t best_left = best(domains, task);
    for (std::uint32_t place = 0; place < best_left; ++place) blame_fact(value(task, place));
    // What it requires is known only if no other behavior is left.
    if (is_fixed(domains, task)) blame_removals(task, best_left);
  }
}

/// A task runs with this value.
void RelaxedProblem::blame_fixed(ValueId id) {
  const TaskId task = catalog_.task_of(id);
  blame_running(task);
  blame_removals(task, id - catalog_.values.begin[task]);
}

void RelaxedProblem::blame_running(TaskId task) {
  blame_fact(catalog_.values.begin[end_task_] - first_value_ + (task - first_task_));
}

/// All values of a task are removed, but for one that may be kept.
void RelaxedProblem::blame_removals(TaskId task, std::uint32_t kept) {
  for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
    if (place != kept) blame_fact(value(task, place));
  }
}

void RelaxedProblem::blame_fact(std::size_t fact) {
  if (is_known_fact_[fact] != 0) return;
  is_known_fact_[fact] = 1;
  facts_.push_back(fact);
}

TaskId RelaxedProblem::choose(const Domains& domains) const {
  TaskId chosen = none;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    const std::uint32_t count = domains.counts[task - first_task_];
    if (!is_needed(domains, task) || count < 2) continue;
    if (chosen == none || count < domains.counts[chosen - first_task_]) chosen = task;
  }
  return chosen;
}

/// A task that could run, but need not, and would count in the performance that was looked at last.
TaskId RelaxedProblem::optional_factor(const Domains& domains) const {
  for (const TaskId task : closure_) {
    for (const CompiledRequirement& requirement :
         catalog_.requirements[fixed_behavior(domains, task)]) {
      const TaskId target = requirement.task;
      if (!is_needed(domains, target) && domains.counts[target - first_task_] > 0) return target;
    }
  }
  return none;
}

/// Place of the most suitable value that is left.
std::uint32_t RelaxedProblem::best(const Domains& domains, TaskId task) const {
  std::uint32_t place = 0;
  while (domains.values[value(task, place)] == 0) ++place;
  return place;
}

BehaviorId RelaxedProblem::fixed_behavior(const Domains& domains, TaskId task) const {
  return is_fixed(domains, task) ? catalog_.values[task][best(domains, task)].behavior : none;
}

}  // namespace cbc
