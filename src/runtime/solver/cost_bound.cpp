// Dual ascent on cuts, as in R. T. Wong, "A dual ascent approach for Steiner tree problems on a
// directed graph", Mathematical Programming 28 (1984), and in LM-cut (M. Helmert and C. Domshlak,
// "Landmarks, critical paths and abstractions: what's the difference anyway?", ICAPS 2009). A cut
// is any set of tasks with a needed one in it. Every solution runs some task of the cut with a
// behavior that requires no task of the cut: follow the requirements inside the cut, from the
// needed task down; they end, as the catalog is acyclic. These behaviors are the arcs of the cut,
// and the least cost among them is a lower bound. It is subtracted from all of them, and the next
// cut is one whose arcs still have a residual cost, until each needed task can run at no residual
// cost. A choice may require several others at once, as in planning; but a cut is found by a search
// from the needed task down, without the h^max values of LM-cut.
//
// The best suitability of each needed task alone would be a bound, too, and is the one of easy
// searches; but it misses all that these tasks will require. The linear program over all cuts, of
// which the ascent finds a dual solution, would give a bound that is at least as high, but would
// have to be solved exactly, and at each decision.
#include "runtime/solver/cost_bound.h"

#include <algorithm>

#include "runtime/compiled/derive.h"

namespace cbc {

CostBound::Cost& CostBound::Cost::operator+=(const Cost& other) {
  log = std::min(prohibitive_cost, log + other.log);
  idle += other.idle;
  return *this;
}

CostBound::Cost& CostBound::Cost::operator-=(const Cost& other) {
  log -= other.log;
  idle -= other.idle;
  return *this;
}

CostBound::Cost pruning_threshold(const Incumbent& incumbent, std::uint32_t tasks) {
  if (!incumbent.exists || incumbent.sums.zeros > 0) return {INT64_MAX, INT64_MAX};
  // Costs are exact, so that f3 may decide, only where all are 0.
  if (incumbent.sums.factors == 0) return {0, incumbent.sums.idle};
  const std::int64_t factors = std::int64_t{incumbent.sums.factors} + tasks;
  return {incumbent.sums.cost + log_cost_error * factors, INT64_MAX};
}

CostBound::CostBound(const CompiledCatalog& catalog, const Domains& domains,
                     const Components& components)
    : catalog_(catalog), domains_(domains), components_(components) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  residual_.resize(most_values_in_a_group(catalog));
  opened_.resize(most_tasks, 0);
  settled_.resize(most_tasks, 0);
  in_cut_.resize(most_tasks, 0);
  cut_.reserve(most_tasks);
  visits_.reserve(most_tasks);
}

CostBound::Cost CostBound::bound(const Cost& threshold, Roots roots) {
  constexpr std::uint64_t most_steps = 10'000'000;  // tasks of cuts
  ++bound_number_;
  Cost total;
  std::uint64_t steps = 0;
  for (const LocalTask task : domains_.needed_tasks()) {
    if (!is_root(task, roots)) continue;
    while (collect_cut(task)) {
      steps += cut_.size();
      if (steps > most_steps) return total;
      total += subtract_cut_minimum();
      if (total > threshold) return total;
    }
  }
  return total;
}

CostBound::Cost& CostBound::residual(LocalTask task, std::uint32_t index) {
  const TaskId first = domains_.first_task();
  return residual_[catalog_.values.begin[first + task] - catalog_.values.begin[first] + index];
}

CostBound::Cost CostBound::reduced_cost(LocalTask task, std::uint32_t index) {
  open(task);
  Cost cost = residual(task, index);
  for (const CompiledRequirement& requirement :
       catalog_.requirements[domains_.value(task, index).behavior]) {
    const LocalTask target = requirement.task - domains_.first_task();
    if (domains_.needed(target) || is_settled(target)) continue;
    open(target);
    cost += least_residual(target);
  }
  return cost;
}

bool CostBound::is_root(LocalTask task, Roots roots) const {
  const std::uint32_t depth = components_.depth();
  if (roots == Roots::in_component) return components_.contains(task, depth);
  return components_.contains(task, depth - 1) && !components_.contains(task, depth);
}

CostBound::Cost CostBound::least_residual(LocalTask task) {
  Cost cheapest{prohibitive_cost, 0};
  for (const std::uint32_t index : domains_.indices(task)) {
    cheapest = std::min(cheapest, residual(task, index));
  }
  return cheapest;
}

void CostBound::open(LocalTask task) {
  if (opened_[task] == bound_number_) return;
  opened_[task] = bound_number_;
  const std::int64_t idle = catalog_.tasks[domains_.first_task() + task].start_on_request ? 0 : 1;
  const auto values = domains_.values(task);
  for (std::uint32_t index = 0; index < values.size(); ++index) {
    residual(task, index) = {values[index].suitability == 0 ? prohibitive_cost : values[index].cost,
                             idle};
  }
}

bool CostBound::is_settled(LocalTask task) const { return settled_[task] == bound_number_; }

/// Collects the tasks that keep the root from running at no residual cost: each of their values
/// has a residual cost or a requirement in the cut. False, and no cut, if the root is settled.
bool CostBound::collect_cut(LocalTask root) {
  if (is_settled(root)) return false;
  ++cut_number_;
  cut_.clear();
  visits_.clear();
  begin_visit(root);
  while (!visits_.empty()) {
    const LocalTask task = visits_.back().task;
    LocalTask target = none;
    switch (advance(visits_.back(), target)) {
      case Step::descend:
        begin_visit(target);
        break;
      case Step::settled:
        settled_[task] = bound_number_;
        in_cut_[task] = 0;
        visits_.pop_back();
        break;
      case Step::cut:
        cut_.push_back(task);
        visits_.pop_back();
        break;
    }
  }
  return !is_settled(root);
}

void CostBound::begin_visit(LocalTask task) {
  open(task);
  in_cut_[task] = cut_number_;
  visits_.push_back({task, 0, 0});
}

/// Looks for a value of no residual cost whose requirements are all settled. Stops at the first
/// requirement not yet visited in this cut, the `target`.
CostBound::Step CostBound::advance(Visit& visit, LocalTask& target) {
  const auto values = domains_.values(visit.task);
  for (; visit.index < values.size(); ++visit.index, visit.requirement = 0) {
    if (!domains_.has(visit.task, visit.index) || residual(visit.task, visit.index) > Cost{})
      continue;
    const auto requirements = catalog_.requirements[values[visit.index].behavior];
    for (; visit.requirement < requirements.size(); ++visit.requirement) {
      target = requirements[visit.requirement].task - domains_.first_task();
      if (domains_.needed(target) || is_settled(target)) continue;
      if (in_cut_[target] != cut_number_) return Step::descend;
      break;
    }
    if (visit.requirement == requirements.size()) return Step::settled;
  }
  return Step::cut;
}

bool CostBound::requires_cut(const Value& value) const {
  for (const CompiledRequirement& requirement : catalog_.requirements[value.behavior]) {
    if (in_cut_[requirement.task - domains_.first_task()] == cut_number_) return true;
  }
  return false;
}

/// Subtracts the cut's minimum from its arcs, and returns it.
CostBound::Cost CostBound::subtract_cut_minimum() {
  Cost cheapest{INT64_MAX, 0};
  for (const LocalTask task : cut_) {
    for (const std::uint32_t index : domains_.indices(task)) {
      const Cost& cost = residual(task, index);
      if (cost < cheapest && !requires_cut(domains_.value(task, index))) cheapest = cost;
    }
  }
  for (const LocalTask task : cut_) {
    for (const std::uint32_t index : domains_.indices(task)) {
      if (!requires_cut(domains_.value(task, index))) residual(task, index) -= cheapest;
    }
  }
  return cheapest;
}

}  // namespace cbc
