#include "runtime/solver/propagator.h"

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/log_cost.h"

namespace cbc {

Propagator::Propagator(const CompiledCatalog& catalog, Domains& domains)
    : catalog_(catalog),
      domains_(domains),
      has_rules_(catalog.group_count(), 0),
      performance_(catalog, domains) {
  for (const CompiledTask& task : catalog.tasks) {
    if (task.has_performance_rules) has_rules_[task.group] = 1;
  }
}

void Propagator::load(const Problem& problem) {
  first_task_ = catalog_.group_tasks[problem.group];
  has_performance_rules_ = has_rules_[problem.group] != 0;
  propagations_ = 0;
  effort_before_ = performance_.effort();
}

bool Propagator::propagate() {
  do {
    while (domains_.has_changed()) {
      if (!revise(domains_.next_changed())) return false;
    }
    if (has_performance_rules_ && !revise_performance()) return false;
  } while (domains_.has_changed());
  return true;
}

bool Propagator::revise(std::uint32_t task) {
  ++propagations_;
  if (domains_.count(task) == 0) return close_dependents(task);
  return close_rivals(task) && need_requirements(task);
}

bool Propagator::close_dependents(std::uint32_t task) {
  for (const std::uint32_t number : catalog_.incoming[first_task_ + task]) {
    const Arc& arc = catalog_.arcs.items[number];
    if (!domains_.remove_all(arc.source - first_task_, &catalog_.masks[arc.mask])) return false;
  }
  return true;
}

bool Propagator::close_rivals(std::uint32_t task) {
  for (const std::uint32_t clique : catalog_.task_cliques[first_task_ + task]) {
    for (const TaskId member : catalog_.cliques[clique]) {
      const std::uint32_t rival = member - first_task_;
      if (rival != task && !domains_.close(rival)) return false;
    }
  }
  return true;
}

bool Propagator::need_requirements(std::uint32_t task) {
  for (const Arc& arc : catalog_.arcs[first_task_ + task]) {
    if (domains_.all_within(task, &catalog_.masks[arc.mask]) &&
        !domains_.need(arc.target - first_task_)) {
      return false;
    }
  }
  return true;
}

bool Propagator::revise_performance() {
  // The list does not grow in this loop: only revise() finds further needed tasks.
  for (const std::uint32_t task : domains_.needed_tasks()) {
    if (catalog_.tasks[first_task_ + task].has_performance_rules && !revise_performance_of(task)) {
      return false;
    }
  }
  return true;
}

bool Propagator::revise_performance_of(std::uint32_t task) {
  ++propagations_;
  const CompiledTask& compiled = catalog_.tasks[first_task_ + task];
  if (compiled.minimum_performance > 0 &&
      !enforce(task, compiled.minimum_performance, compiled.minimum_cost)) {
    return false;
  }
  const auto values = domains_.values(task);
  for (std::uint32_t index = 0; index < values.size(); ++index) {
    if (!domains_.has(task, index)) continue;
    for (const CompiledRequirement& rule : catalog_.requirements[values[index].behavior]) {
      if (rule.minimum_performance == 0) continue;
      const std::uint32_t target = rule.task - first_task_;
      if (domains_.count(task) == 1) {
        if (!enforce(target, rule.minimum_performance, rule.minimum_cost)) return false;
      } else if (performance_.is_below(performance_.bound(target), rule.minimum_performance,
                                       rule.minimum_cost)) {
        if (!domains_.remove(task, index)) return false;
        break;
      }
    }
  }
  return true;
}

bool Propagator::enforce(std::uint32_t task, Millionths minimum, std::int64_t minimum_cost) {
  const PerformanceBound::Bound bound = performance_.bound(task);
  if (performance_.is_below(bound, minimum, minimum_cost)) return false;
  // Removes values that push the product below the minimum, whatever else is chosen. A value that
  // is too close to tell stays: the exact test above decides once it is chosen.
  for (const std::uint32_t member : performance_.closure()) {
    if (domains_.count(member) == 1) continue;
    const std::int64_t best_cost = domains_.value(member, domains_.best(member)).cost;
    const auto values = domains_.values(member);
    for (std::uint32_t index = domains_.best(member) + 1; index < values.size(); ++index) {
      if (!domains_.has(member, index)) continue;
      std::int64_t cost = bound.cost - best_cost + values[index].cost;
      std::uint32_t factors = bound.factors + 2;
      for (const CompiledRequirement& rule : catalog_.requirements[values[index].behavior]) {
        const std::uint32_t required = rule.task - first_task_;
        if (performance_.in_closure(required) || domains_.count(required) == 0) continue;
        cost += domains_.value(required, domains_.best(required)).cost;
        ++factors;
      }
      const bool is_too_little =
          values[index].suitability == 0 || cost > minimum_cost + log_cost_error * factors;
      if (is_too_little && !domains_.remove(member, index)) return false;
    }
  }
  return true;
}

}  // namespace cbc
