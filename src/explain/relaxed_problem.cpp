#include "explain/relaxed_problem.h"

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
      in_closure_(end_task_ - first_task_, 0) {}

/// Depth first over what is left. As in Domains, a task that nothing needs can be left out, so a
/// subtree is solved when each needed task has one value; only to keep a performance low, something
/// that nothing needs may have to run.
Feasibility RelaxedProblem::solve(std::span<const Reason> reasons) {
  constexpr std::size_t most_nodes = 10'000;
  constexpr std::uint64_t most_effort = 50'000'000;
  const std::uint64_t effort_before = effort_;
  std::vector<Domains> open(1);
  if (!begin(open.back(), reasons)) return Feasibility::no;
  for (std::size_t nodes = 0; !open.empty(); ++nodes) {
    if (nodes == most_nodes || effort_ - effort_before > most_effort) return Feasibility::unknown;
    Domains now = std::move(open.back());
    open.pop_back();
    effort_ += now.values.size() / 8;  // they are copied, many at once
    if (!propagate(now, reasons)) continue;
    const TaskId task = choose(now);
    if (task == none) {
      // All that runs is decided, so the performance is exact.
      if (low_task_ == none || !may_reach(now, low_task_, low_minimum_)) return Feasibility::yes;
      const TaskId optional = optional_factor(now);
      if (optional == none) continue;
      Domains without = now;
      // One that is not needed can be closed, and one that is open can be needed.
      (void)close(without, optional);
      open.push_back(std::move(without));
      (void)need(now, optional);
      open.push_back(std::move(now));
      continue;
    }
    const std::uint32_t chosen = best(now, task);
    Domains without = now;
    if (remove(without, task, chosen)) open.push_back(std::move(without));
    for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
      // One value is left in the end, so no removal fails.
      if (place != chosen) (void)remove(now, task, place);
    }
    open.push_back(std::move(now));
  }
  return Feasibility::no;
}

bool RelaxedProblem::begin(Domains& domains, std::span<const Reason> reasons) {
  domains.values.assign(catalog_.values.begin[end_task_] - first_value_, 1);
  domains.needed.assign(end_task_ - first_task_, 0);
  effort_ += domains.values.size();
  for (TaskId task = first_task_; task < end_task_; ++task) {
    domains.counts.push_back(static_cast<std::uint32_t>(catalog_.values[task].size()));
  }
  for (const Demand& each : demands_) {
    if (!demand(domains, each)) return false;
  }
  if (low_task_ != none && !need(domains, low_task_)) return false;
  for (const Reason& reason : reasons) {
    switch (reason.kind) {
      case Reason::Kind::is_protected:
        if (!need(domains, reason.task)) return false;
        break;
      case Reason::Kind::on_request:
        if (!close(domains, reason.task)) return false;
        break;
      case Reason::Kind::unavailable:
      case Reason::Kind::faulty:
      case Reason::Kind::finished:
        for (const ValueId id : catalog_.performs[reason.behavior]) {
          const TaskId task = catalog_.task_of(id);
          const std::uint32_t place = id - catalog_.values.begin[task];
          const bool is_kept =
              reason.kind == Reason::Kind::unavailable && present_[task - first_task_] == place;
          if (!is_kept && !remove(domains, task, place)) return false;
        }
        break;
      default:
        break;
    }
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
  has_changed_ = true;
  return --domains.counts[task - first_task_] > 0 || !is_needed(domains, task);
}

bool RelaxedProblem::close(Domains& domains, TaskId task) {
  for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
    if (!remove(domains, task, place)) return false;
  }
  return !is_needed(domains, task);
}

bool RelaxedProblem::need(Domains& domains, TaskId task) {
  if (!is_needed(domains, task)) has_changed_ = true;
  domains.needed[task - first_task_] = 1;
  return domains.counts[task - first_task_] > 0;
}

bool RelaxedProblem::propagate(Domains& domains, std::span<const Reason> reasons) {
  do {
    has_changed_ = false;
    effort_ += reasons.size();
    for (const Reason& reason : reasons) {
      switch (reason.kind) {
        case Reason::Kind::exclusive:
          if (is_needed(domains, reason.task) && !close(domains, reason.other_task)) return false;
          if (is_needed(domains, reason.other_task) && !close(domains, reason.task)) return false;
          break;
        case Reason::Kind::requires_task:
          if (!apply_requirement(domains, reason)) return false;
          break;
        case Reason::Kind::performance:
          if (!may_perform(domains, reason)) return false;
          break;
        default:
          break;
      }
    }
  } while (has_changed_);
  return true;
}

bool RelaxedProblem::apply_requirement(Domains& domains, const Reason& reason) {
  effort_ += catalog_.performs[reason.behavior].size();
  for (const ValueId id : catalog_.performs[reason.behavior]) {
    const TaskId task = catalog_.task_of(id);
    const std::uint32_t place = id - catalog_.values.begin[task];
    if (domains.values[value(task, place)] == 0) continue;
    if (is_fixed(domains, task)) {
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
  const bool applies =
      reason.behavior == none ||
      std::any_of(catalog_.performs[reason.behavior].begin(),
                  catalog_.performs[reason.behavior].end(), [&](ValueId id) {
                    return fixed_behavior(domains, catalog_.task_of(id)) == reason.behavior;
                  });
  return !applies || may_reach(domains, reason.task, reason.minimum_performance);
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

TaskId RelaxedProblem::choose(const Domains& domains) const {
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (is_needed(domains, task) && domains.counts[task - first_task_] > 1) return task;
  }
  return none;
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
