#include "runtime/solver/performance_reasons.h"

#include "runtime/compiled/log_cost.h"

namespace cbc {

PerformanceReasons::PerformanceReasons(const CompiledCatalog& catalog, const Domains& domains,
                                       ReasonTrail& trail)
    : catalog_(catalog), domains_(domains), trail_(trail), performance_(catalog, domains) {}

void PerformanceReasons::load() {
  ruled_.clear();
  for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
    if (catalog_.tasks[domains_.first_task() + task].has_performance_rules) ruled_.push_back(task);
  }
}

bool PerformanceReasons::propagate(const SearchBudget& budget) {
  for (const std::uint32_t task : ruled_) {
    if (budget.is_out_of_time()) return true;
    if (domains_.needed(task) && !revise(task)) return false;
  }
  return true;
}

bool PerformanceReasons::revise(std::uint32_t task) {
  const CompiledTask& compiled = catalog_.tasks[domains_.first_task() + task];
  if (compiled.minimum_performance > 0 &&
      !enforce(task, compiled.minimum_performance, compiled.minimum_cost,
               ReasonTrail::runs(task))) {
    return false;
  }
  const auto values = domains_.values(task);
  for (std::uint32_t index = 0; index < values.size(); ++index) {
    for (const CompiledRequirement& rule : catalog_.requirements[values[index].behavior]) {
      if (!domains_.has(task, index)) break;
      if (rule.minimum_performance == 0) continue;
      const std::uint32_t target = rule.task - domains_.first_task();
      const Literal chosen = trail_.has_value(task, index);
      if (trail_.is_true(chosen)) {
        if (!enforce(target, rule.minimum_performance, rule.minimum_cost, chosen)) return false;
      } else if (performance_.is_below(performance_.bound(target), rule.minimum_performance,
                                       rule.minimum_cost)) {
        explain_bound();
        if (!remove(task, index)) return false;
      }
    }
  }
  return true;
}

/// `demand`: the literal that holds and asks for the minimum.
bool PerformanceReasons::enforce(std::uint32_t task, Millionths minimum, std::int64_t minimum_cost,
                                 Literal demand) {
  const PerformanceBound::Bound bound = performance_.bound(task);
  if (!performance_.is_below(bound, minimum, minimum_cost)) {
    return remove_low_values(bound, minimum_cost, demand);
  }
  explain_bound();
  reason_.push_back(demand);
  trail_.set_conflict(reason_);
  return false;
}

/// Removes values that push the product below the minimum, whatever else is chosen. A value that is
/// too close to tell stays: the exact test decides once it is chosen.
bool PerformanceReasons::remove_low_values(const PerformanceBound::Bound& bound,
                                           std::int64_t minimum_cost, Literal demand) {
  for (const std::uint32_t member : performance_.closure()) {
    if (domains_.count(member) == 1) continue;
    const auto values = domains_.values(member);
    for (std::uint32_t index = domains_.best(member) + 1; index < values.size(); ++index) {
      if (!domains_.has(member, index) || !is_too_low(bound, member, index, minimum_cost)) continue;
      explain_bound();
      reason_.push_back(demand);
      for (const CompiledRequirement& rule : catalog_.requirements[values[index].behavior]) {
        explain_best(rule.task - domains_.first_task());
      }
      if (!remove(member, index)) return false;
    }
  }
  return true;
}

bool PerformanceReasons::is_too_low(const PerformanceBound::Bound& bound, std::uint32_t task,
                                    std::uint32_t index, std::int64_t minimum_cost) const {
  const Value& value = domains_.value(task, index);
  if (value.suitability == 0) return true;
  std::int64_t cost = bound.cost - domains_.value(task, domains_.best(task)).cost + value.cost;
  std::uint32_t factors = bound.factors + 2;
  for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
    const std::uint32_t required = rule.task - domains_.first_task();
    if (performance_.in_closure(required) || domains_.count(required) == 0) continue;
    cost += domains_.value(required, domains_.best(required)).cost;
    ++factors;
  }
  return cost > minimum_cost + log_cost_error * factors;
}

bool PerformanceReasons::remove(std::uint32_t task, std::uint32_t index) {
  return trail_.imply(negate(trail_.has_value(task, index)), trail_.store(reason_));
}

/// The reason of the last bound: for each task of its closure the removals of better values, and of
/// those that do not require the tasks that count.
void PerformanceReasons::explain_bound() {
  reason_.clear();
  for (const std::uint32_t member : performance_.closure()) {
    const auto values = static_cast<std::uint32_t>(domains_.values(member).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      if (!domains_.has(member, index) && is_in_reason(member, index)) {
        reason_.push_back(negate(trail_.has_value(member, index)));
      }
    }
  }
}

bool PerformanceReasons::is_in_reason(std::uint32_t task, std::uint32_t index) const {
  if (domains_.count(task) == 0 || index < domains_.best(task)) return true;
  for (const Arc& arc : catalog_.arcs[domains_.first_task() + task]) {
    const std::uint64_t* const mask = &catalog_.masks[arc.mask];
    if (((mask[index / 64] >> (index % 64)) & 1) == 0 && domains_.all_within(task, mask)) {
      return true;
    }
  }
  return false;
}

/// The removals of the values that suit the task better than its best.
void PerformanceReasons::explain_best(std::uint32_t task) {
  if (domains_.count(task) == 0) return;
  for (std::uint32_t index = 0; index < domains_.best(task); ++index) {
    reason_.push_back(negate(trail_.has_value(task, index)));
  }
}

}  // namespace cbc
