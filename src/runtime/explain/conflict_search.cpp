#include "explain/conflict_search.h"

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
      first_value_(catalog.values.begin[first_task_]),
      has_changed_(end_task_ - first_task_, 0),
      in_closure_(end_task_ - first_task_, 0) {}

/// Depth first. As in cbc::Domains, tasks that nothing needs can be left out, so a subtree is
/// solved when each needed task has one value; only to keep a performance low, a task that nothing
/// needs may have to run.
Feasibility ConflictSearch::solve(std::span<const Reason> reasons) {
  constexpr std::size_t most_nodes = 10'000;
  constexpr std::uint64_t most_effort = 50'000'000;
  const std::uint64_t effort_before = effort_;
  is_used_.assign(reasons.size(), 0);
  conflict_set_.assign(1, 0);
  open_.clear();
  sort(reasons);
  forget_changes();
  Branch now;
  if (!begin(now.domains, reasons)) {
    analyze_conflict(now.domains, reasons);
    return Feasibility::no;
  }
  for (std::size_t nodes = 0;; ++nodes) {
    if (nodes == most_nodes || effort_ - effort_before > most_effort) return Feasibility::unknown;
    effort_ += now.domains.values.size() / 8;  // copying is fast
    if (!propagate(now.domains, reasons)) {
      analyze_conflict(now.domains, reasons);
      if (!backjump(now)) return Feasibility::no;
      continue;
    }
    const TaskId task = choose(now.domains);
    if (task != none) {
      decide(now, task);
      continue;
    }
    // All needed tasks are decided, so the performance is exact.
    if (low_task_ == none || !may_reach(now.domains, low_task_, low_minimum_)) {
      return Feasibility::yes;
    }
    const TaskId optional = optional_factor(now.domains);
    if (optional != none) {
      decide_whether_to_run(now, optional);
      continue;
    }
    // Any reason and decision may have removed what could lower the performance.
    std::fill(is_used_.begin(), is_used_.end(), 1);
    std::fill(conflict_set_.begin(), conflict_set_.end(), 1);
    if (!backjump(now)) return Feasibility::no;
  }
}

/// Tries the most suitable value of a task; the second branch is without it.
void ConflictSearch::decide(Branch& now, TaskId task) {
  Branch& other = branch(now, task);
  const std::uint32_t chosen = best(now.domains, task);
  // Each branch keeps a value of the task, so no removal fails.
  (void)remove(other.domains, task, chosen);
  for (std::uint32_t index = 0; index < catalog_.values[task].size(); ++index) {
    if (index != chosen) (void)remove(now.domains, task, index);
  }
}

void ConflictSearch::decide_whether_to_run(Branch& now, TaskId task) {
  Branch& other = branch(now, task);
  // The task is not needed and has values, so neither call fails.
  (void)close(other.domains, task);
  (void)need(now.domains, task);
}

/// Opens a level for a decision on the task, and keeps a copy as its second branch.
ConflictSearch::Branch& ConflictSearch::branch(Branch& now, TaskId task) {
  ++now.level;
  now.decided = task;
  cause_ = first_decision + now.level;
  conflict_set_.resize(std::max<std::size_t>(conflict_set_.size(), now.level + 1), 0);
  conflict_sets_before_.resize(conflict_set_.size());
  open_.push_back(now);
  return open_.back();
}

/// Goes on with the second branch of the last decision in the conflict set; later decisions have no
/// part in the failure. False if there is none: then there is no solution.
bool ConflictSearch::backjump(Branch& now) {
  for (std::size_t level = conflict_set_.size() - 1; level > 0; --level) {
    if (conflict_set_[level] == 0) continue;
    conflict_set_[level] = 0;
    while (!open_.empty() && open_.back().level > level) open_.pop_back();
    if (!open_.empty() && open_.back().level == level) {
      now = std::move(open_.back());
      open_.pop_back();
      forget_changes();
      note_change(now.decided);
      conflict_sets_before_[level] =
          std::exchange(conflict_set_, std::vector<std::uint8_t>(level + 1, 0));
      return true;
    }
    // Both branches failed: the conflict set of the node is the union of theirs.
    const std::vector<std::uint8_t>& before = conflict_sets_before_[level];
    for (std::size_t lower = 0; lower < level; ++lower) conflict_set_[lower] |= before[lower];
  }
  return false;
}

bool ConflictSearch::begin(Domains& domains, std::span<const Reason> reasons) {
  domains.values.assign(catalog_.values.begin[end_task_] - first_value_, 1);
  domains.needed.assign(end_task_ - first_task_, 0);
  domains.removed_by.assign(domains.values.size(), none);
  domains.needed_by.assign(domains.needed.size(), none);
  domains.needed_through.assign(domains.needed.size(), none);
  effort_ += domains.values.size();
  cause_ = none;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    note_change(task);  // applies every reason once
    domains.counts.push_back(static_cast<std::uint32_t>(catalog_.values[task].size()));
  }
  for (const Demand& each : demands_) {
    if (!demand(domains, each)) return false;
  }
  if (low_task_ != none && !need(domains, low_task_)) return false;
  if (!follow_changes(domains, reasons)) return false;
  for (const std::uint32_t index : state_) {
    cause_ = index;
    if (!apply_state(domains, reasons[index]) || !follow_changes(domains, reasons)) return false;
  }
  return true;
}

bool ConflictSearch::apply_state(Domains& domains, const Reason& reason) {
  if (reason.kind == Reason::Kind::is_protected) return need(domains, reason.task);
  if (reason.kind == Reason::Kind::on_request) return close(domains, reason.task);
  for (const ValueId id : catalog_.performs[reason.behavior]) {
    const TaskId task = catalog_.task_of(id);
    const std::uint32_t index = id - catalog_.values.begin[task];
    const bool is_kept =
        reason.kind == Reason::Kind::unavailable && present_[task - first_task_] == index;
    if (!is_kept && !remove(domains, task, index)) return false;
  }
  return true;
}

bool ConflictSearch::demand(Domains& domains, const Demand& demand) {
  switch (demand.kind) {
    case Demand::Kind::run:
      return need(domains, demand.task);
    case Demand::Kind::stop:
      return close(domains, demand.task);
    case Demand::Kind::has:
      if (!need(domains, demand.task)) return false;
      for (std::uint32_t index = 0; index < catalog_.values[demand.task].size(); ++index) {
        if (index != demand.value_index && !remove(domains, demand.task, index)) return false;
      }
      return true;
    case Demand::Kind::has_not:
      return remove(domains, demand.task, demand.value_index);
  }
  return true;
}

bool ConflictSearch::remove(Domains& domains, TaskId task, std::uint32_t index) {
  std::uint8_t& is_left = domains.values[value(task, index)];
  if (is_left == 0) return true;
  is_left = 0;
  domains.removed_by[value(task, index)] = cause_;
  note_change(task);
  dead_end_ = task;
  return --domains.counts[task - first_task_] > 0 || !is_needed(domains, task);
}

bool ConflictSearch::close(Domains& domains, TaskId task) {
  for (std::uint32_t index = 0; index < catalog_.values[task].size(); ++index) {
    if (!remove(domains, task, index)) return false;
  }
  dead_end_ = task;
  return !is_needed(domains, task);
}

bool ConflictSearch::need(Domains& domains, TaskId task) {
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
void ConflictSearch::sort(std::span<const Reason> reasons) {
  reasons_of_task_.resize(end_task_ - first_task_);
  for (std::vector<std::uint32_t>& indices : reasons_of_task_) indices.clear();
  performances_.clear();
  state_.clear();
  const auto add = [this](TaskId task, std::uint32_t index) {
    reasons_of_task_[task - first_task_].push_back(index);
  };
  for (std::uint32_t index = 0; index < reasons.size(); ++index) {
    const Reason& reason = reasons[index];
    switch (reason.kind) {
      case Reason::Kind::exclusive:
        add(reason.task, index);
        add(reason.other_task, index);
        break;
      case Reason::Kind::requires_task:
        add(reason.task, index);
        for (const ValueId id : catalog_.performs[reason.behavior]) {
          add(catalog_.task_of(id), index);
        }
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
  effort_ += reasons.size() + reasons_of_task_.size();
}

void ConflictSearch::note_change(TaskId task) {
  if (std::exchange(has_changed_[task - first_task_], 1) == 0) changed_.push_back(task);
}

void ConflictSearch::forget_changes() {
  for (const TaskId task : changed_) has_changed_[task - first_task_] = 0;
  changed_.clear();
}

bool ConflictSearch::propagate(Domains& domains, std::span<const Reason> reasons) {
  if (!follow_changes(domains, reasons)) return false;
  effort_ += performances_.size();
  for (const std::uint32_t index : performances_) {
    cause_ = index;
    if (!may_perform(domains, reasons[index])) return false;
  }
  return true;
}

/// Applies exclusions and requirements until nothing changes any more.
bool ConflictSearch::follow_changes(Domains& domains, std::span<const Reason> reasons) {
  // In the order of the changes, which makes short proofs.
  std::size_t next = 0;
  while (next < changed_.size()) {
    const TaskId task = changed_[next++];
    has_changed_[task - first_task_] = 0;
    const std::vector<std::uint32_t>& indices = reasons_of_task_[task - first_task_];
    effort_ += indices.size();
    for (const std::uint32_t index : indices) {
      cause_ = index;
      if (!apply(domains, reasons[index])) return false;
    }
  }
  changed_.clear();
  return true;
}

/// An exclusion or a requirement.
bool ConflictSearch::apply(Domains& domains, const Reason& reason) {
  if (reason.kind == Reason::Kind::requires_task) return apply_requirement(domains, reason);
  if (is_needed(domains, reason.task) && !close(domains, reason.other_task)) return false;
  return !is_needed(domains, reason.other_task) || close(domains, reason.task);
}

bool ConflictSearch::apply_requirement(Domains& domains, const Reason& reason) {
  effort_ += catalog_.performs[reason.behavior].size();
  for (const ValueId id : catalog_.performs[reason.behavior]) {
    const TaskId task = catalog_.task_of(id);
    const std::uint32_t index = id - catalog_.values.begin[task];
    if (domains.values[value(task, index)] == 0) continue;
    if (is_fixed(domains, task)) {
      through_ = id;
      if (!need(domains, reason.task)) return false;
    } else if (domains.counts[reason.task - first_task_] == 0) {
      if (!remove(domains, task, index)) return false;
    }
  }
  return true;
}

/// Whether the performance can still reach the minimum. Exact where all that it depends on is
/// fixed. A required task counts only if it is needed.
bool ConflictSearch::may_perform(const Domains& domains, const Reason& reason) {
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

/// Whether the performance of a needed task may be at least `minimum`.
bool ConflictSearch::may_reach(const Domains& domains, TaskId reached, Millionths minimum) {
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
  // The cost of a multiplication grows with the number of factors.
  effort_ += in_closure_.size() / 8 + closure_.size() * closure_.size();
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) >= 0;
}

/// Marks the reasons that a failure of the propagation comes from, and adds its decisions to the
/// conflict set: from the facts that make the failure back through their causes.
void ConflictSearch::analyze_conflict(const Domains& domains, std::span<const Reason> reasons) {
  facts_.clear();
  is_known_fact_.assign(domains.values.size() + domains.needed.size(), 0);
  effort_ += is_known_fact_.size() / 8;
  if (dead_end_ != none) {
    explain_running(dead_end_);
    explain_removals(dead_end_, none);
  } else {
    explain_performance(domains);
  }
  std::size_t next = 0;
  while (next < facts_.size()) {
    const std::size_t fact = facts_[next++];
    const bool is_removal = fact < domains.values.size();
    const auto of_task = static_cast<TaskId>(fact - domains.values.size());
    const std::uint32_t cause = is_removal ? domains.removed_by[fact] : domains.needed_by[of_task];
    if (cause == none) continue;
    if (cause >= first_decision) {
      conflict_set_[cause - first_decision] = 1;
      continue;
    }
    is_used_[cause] = 1;
    const Reason& reason = reasons[cause];
    if (reason.kind == Reason::Kind::exclusive) {
      const TaskId removed = catalog_.task_of(first_value_ + static_cast<ValueId>(fact));
      explain_running(removed == reason.task ? reason.other_task : reason.task);
    } else if (reason.kind == Reason::Kind::requires_task && is_removal) {
      explain_removals(reason.task, none);
    } else if (reason.kind == Reason::Kind::requires_task) {
      explain_value(domains.needed_through[of_task]);
    }
  }
  effort_ += facts_.size();
}

/// Adds the facts that make the performance tested last too low: the behavior that requires it, if
/// there is one, runs, and all tasks of the closure run with nothing more suitable.
void ConflictSearch::explain_performance(const Domains& domains) {
  is_used_[cause_] = 1;
  if (through_ != none) explain_value(through_);
  for (const TaskId task : closure_) {
    explain_running(task);
    const std::uint32_t best_left = best(domains, task);
    for (std::uint32_t index = 0; index < best_left; ++index) add_fact(value(task, index));
    // Its requirements are in the closure only because no other behavior is left.
    if (is_fixed(domains, task)) explain_removals(task, best_left);
  }
}

/// Adds the facts by which a task runs with this value.
void ConflictSearch::explain_value(ValueId id) {
  const TaskId task = catalog_.task_of(id);
  explain_running(task);
  explain_removals(task, id - catalog_.values.begin[task]);
}

void ConflictSearch::explain_running(TaskId task) {
  add_fact(catalog_.values.begin[end_task_] - first_value_ + (task - first_task_));
}

/// Adds the removals of all values of a task, except for `kept`.
void ConflictSearch::explain_removals(TaskId task, std::uint32_t kept) {
  for (std::uint32_t index = 0; index < catalog_.values[task].size(); ++index) {
    if (index != kept) add_fact(value(task, index));
  }
}

void ConflictSearch::add_fact(std::size_t fact) {
  if (is_known_fact_[fact] != 0) return;
  is_known_fact_[fact] = 1;
  facts_.push_back(fact);
}

TaskId ConflictSearch::choose(const Domains& domains) const {
  TaskId chosen = none;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    const std::uint32_t count = domains.counts[task - first_task_];
    if (!is_needed(domains, task) || count < 2) continue;
    if (chosen == none || count < domains.counts[chosen - first_task_]) chosen = task;
  }
  return chosen;
}

/// A task that is not needed, may run, and would count in the performance tested last.
TaskId ConflictSearch::optional_factor(const Domains& domains) const {
  for (const TaskId task : closure_) {
    for (const CompiledRequirement& requirement :
         catalog_.requirements[fixed_behavior(domains, task)]) {
      const TaskId target = requirement.task;
      if (!is_needed(domains, target) && domains.counts[target - first_task_] > 0) return target;
    }
  }
  return none;
}

/// Index of the most suitable value in the domain.
std::uint32_t ConflictSearch::best(const Domains& domains, TaskId task) const {
  std::uint32_t index = 0;
  while (domains.values[value(task, index)] == 0) ++index;
  return index;
}

BehaviorId ConflictSearch::fixed_behavior(const Domains& domains, TaskId task) const {
  return is_fixed(domains, task) ? catalog_.values[task][best(domains, task)].behavior : none;
}

}  // namespace cbc
