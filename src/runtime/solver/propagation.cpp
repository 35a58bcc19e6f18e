// Propagation to a fixed point: a constraint is looked at again when a task that it is about has
// changed (AC-3: A. K. Mackworth, "Consistency in networks of relations", Artificial Intelligence 8
// (1977)). An exclusivity list stays one clique, and what the behaviors of one task require of
// another is one arc with a bit set of these behaviors, so that neither is taken apart into pairs
// of values.
//
// These constraints become arc consistent. Minimum performances do not: what counts in a
// performance depends on the choices themselves, so whether it can reach a minimum takes a search.
// It is bounded from above instead, which is exact once all that it depends on is fixed. The rules
// are written once, and applied in two ways: to the domains alone, which is all that most searches
// need, and with a reason for each inference, for searches that learn.
#include "runtime/solver/propagation.h"

#include <algorithm>

#include "runtime/compiled/derive.h"

namespace cbc {
namespace {

// The constraints of a catalog. How they are applied differs: on domains alone, or on literals with
// reasons. `domains`: with the group of the task.

/// A task that runs closes its rivals.
template <typename Close>
bool close_rivals(const CompiledCatalog& catalog, const Domains& domains, LocalTask task,
                  const Close& close) {
  for (const std::uint32_t clique : catalog.task_cliques[domains.first_task() + task]) {
    for (const TaskId member : catalog.cliques[clique]) {
      const LocalTask rival = member - domains.first_task();
      if (rival != task && !close(rival)) return false;
    }
  }
  return true;
}

/// A task that runs needs the targets of the arcs that all of its behaviors require.
template <typename Need>
bool need_requirements(const CompiledCatalog& catalog, const Domains& domains, LocalTask task,
                       const Need& need) {
  for (const Arc& arc : catalog.arcs[domains.first_task() + task]) {
    if (domains.all_within(task, &catalog.masks[arc.mask]) &&
        !need(arc, arc.target - domains.first_task())) {
      return false;
    }
  }
  return true;
}

/// A task that cannot run removes the behaviors, in a mask, of each task that requires it.
template <typename Remove>
bool remove_dependents(const CompiledCatalog& catalog, const Domains& domains, LocalTask task,
                       const Remove& remove) {
  for (const std::uint32_t number : catalog.incoming[domains.first_task() + task]) {
    const Arc& arc = catalog.arcs.items[number];
    if (!remove(arc.source - domains.first_task(), &catalog.masks[arc.mask])) return false;
  }
  return true;
}

/// What minimum performances change where nobody asks for reasons.
struct PlainChanges {
  using Demand = PerformanceBound::Demand;

  Domains& domains;

  [[nodiscard]] bool is_chosen(LocalTask task, std::uint32_t /*index*/) const {
    return domains.count(task) == 1;
  }
  [[nodiscard]] bool refuse(const Demand& /*demand*/) const { return false; }
  [[nodiscard]] bool remove(LocalTask task, std::uint32_t index, const Demand& /*demand*/) const {
    return domains.remove(task, index);
  }
};

}  // namespace

PerformanceBound::PerformanceBound(const CompiledCatalog& catalog, const Domains& domains)
    : catalog_(catalog), domains_(domains) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  closure_.reserve(most_tasks);
  in_closure_.resize(most_tasks, 0);
  product_.reserve(most_tasks);
  minimum_.reserve(most_tasks);
}

template <typename Changes>
bool PerformanceBound::revise(LocalTask task, Changes& changes) {
  const CompiledTask& compiled = catalog_.tasks[domains_.first_task() + task];
  if (compiled.minimum_performance > 0 &&
      !enforce(task, compiled.minimum_performance, compiled.minimum_cost, {task, none}, changes)) {
    return false;
  }
  for (const std::uint32_t index : domains_.indices(task)) {
    for (const CompiledRequirement& rule :
         catalog_.requirements[domains_.value(task, index).behavior]) {
      if (rule.minimum_performance == 0) continue;
      const LocalTask target = rule.task - domains_.first_task();
      if (changes.is_chosen(task, index)) {
        if (!enforce(target, rule.minimum_performance, rule.minimum_cost, {task, index}, changes)) {
          return false;
        }
      } else if (is_below(bound(target), rule.minimum_performance, rule.minimum_cost)) {
        if (!changes.remove(task, index, {})) return false;
        break;
      }
    }
  }
  return true;
}

/// Removes values that push the product below the minimum, whatever else is chosen. A value that is
/// too close to tell stays: the exact test decides once it is chosen.
template <typename Changes>
bool PerformanceBound::enforce(LocalTask task, Millionths minimum, std::int64_t minimum_cost,
                               Demand demand, Changes& changes) {
  const Bound bound = this->bound(task);
  if (is_below(bound, minimum, minimum_cost)) return changes.refuse(demand);
  for (const LocalTask member : closure_) {
    if (domains_.count(member) == 1) continue;
    const auto values = static_cast<std::uint32_t>(domains_.values(member).size());
    for (std::uint32_t index = domains_.best(member) + 1; index < values; ++index) {
      if (domains_.has(member, index) && is_too_low(bound, member, index, minimum_cost) &&
          !changes.remove(member, index, demand)) {
        return false;
      }
    }
  }
  return true;
}

PerformanceBound::Bound PerformanceBound::bound(LocalTask task) {
  ++closure_number_;
  closure_.clear();
  closure_.push_back(task);
  in_closure_[task] = closure_number_;
  Bound bound;
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const LocalTask member = closure_[next];
    ++effort_;
    if (domains_.count(member) == 0) {
      bound.reachable = false;
      closure_.resize(next + 1);
      return bound;
    }
    const Value& best = domains_.value(member, domains_.best(member));
    bound.cost += best.cost;
    if (best.suitability == 0) bound.zero = true;
    if (best.suitability != one_million) ++bound.factors;
    for (const Arc& arc : catalog_.arcs[domains_.first_task() + member]) {
      const LocalTask target = arc.target - domains_.first_task();
      if (in_closure_[target] == closure_number_) continue;
      if (!domains_.all_within(member, &catalog_.masks[arc.mask])) continue;
      in_closure_[target] = closure_number_;
      closure_.push_back(target);
    }
  }
  return bound;
}

/// Whether the last bound is below a minimum, exactly.
bool PerformanceBound::is_below(const Bound& bound, Millionths minimum, std::int64_t minimum_cost) {
  if (!bound.reachable || bound.zero) return true;
  const std::int64_t slack = log_cost_error * (bound.factors + 1);
  if (bound.cost > minimum_cost + slack) return true;
  if (bound.cost < minimum_cost - slack) return false;
  product_.clear();
  for (const LocalTask member : closure_) {
    const Millionths best = domains_.value(member, domains_.best(member)).suitability;
    if (best != one_million) product_.multiply(best);
  }
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) < 0;
}

/// Whether the minimum of the last bound is out of reach with this value of a task of the closure.
bool PerformanceBound::is_too_low(const Bound& bound, LocalTask task, std::uint32_t index,
                                  std::int64_t minimum_cost) const {
  const Value& value = domains_.value(task, index);
  if (value.suitability == 0) return true;
  std::int64_t cost = bound.cost - domains_.value(task, domains_.best(task)).cost + value.cost;
  std::uint32_t factors = bound.factors + 2;
  for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
    const LocalTask required = rule.task - domains_.first_task();
    if (in_closure_[required] == closure_number_ || domains_.count(required) == 0) continue;
    cost += domains_.value(required, domains_.best(required)).cost;
    ++factors;
  }
  return cost > minimum_cost + log_cost_error * factors;
}

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

bool Propagator::revise(LocalTask task) {
  ++propagations_;
  if (domains_.count(task) == 0) {
    return remove_dependents(catalog_, domains_, task,
                             [this](LocalTask source, const std::uint64_t* mask) {
                               return domains_.remove_all(source, mask);
                             });
  }
  const auto limits = catalog_.limits_of(domains_.first_task() + task);
  return close_rivals(catalog_, domains_, task,
                      [this](LocalTask rival) { return domains_.close(rival); }) &&
         std::all_of(limits.begin(), limits.end(),
                     [this](std::uint32_t limit) { return close_limited(limit); }) &&
         need_requirements(catalog_, domains_, task, [this](const Arc& /*arc*/, LocalTask target) {
           return domains_.need(target);
         });
}

/// Where as many tasks of a limit run as may, no other one does.
bool Propagator::close_limited(std::uint32_t limit) {
  const auto members = catalog_.limited[limit];
  const auto is_needed = [this](TaskId member) {
    return domains_.needed(member - domains_.first_task());
  };
  const auto running =
      static_cast<std::uint32_t>(std::count_if(members.begin(), members.end(), is_needed));
  const std::uint32_t most = catalog_.limits[limit].most;
  if (running != most) return running < most;
  return std::all_of(members.begin(), members.end(), [&](TaskId member) {
    return is_needed(member) || domains_.close(member - domains_.first_task());
  });
}

bool Propagator::revise_performance() {
  PlainChanges changes{domains_};
  // The list does not grow in this loop: only revise() finds further needed tasks.
  for (const LocalTask task : domains_.needed_tasks()) {
    if (!catalog_.tasks[domains_.first_task() + task].has_performance_rules) continue;
    ++propagations_;
    if (!performance_.revise(task, changes)) return false;
  }
  return true;
}

bool CatalogTrail::load(const Problem& problem) {
  clear();
  requests_ = problem.requests;
  for (LocalTask task(0); task < task_count_; ++task) {
    const auto values = static_cast<std::uint32_t>(domains_.values(task).size());
    for (std::uint32_t index = 0; index < values; ++index) {
      if (!domains_.has(task, index) && !imply(negate(has_value(task, index)), {})) return false;
    }
    if (values == 0 && !imply(negate(runs(task)), {})) return false;
    if (problem.may_stop[task] == 0 && !imply(runs(task), {})) return false;
  }
  return propagate();
}

bool CatalogTrail::follow_running(LocalTask task) {
  const auto close_rival = [&](LocalTask rival) {
    return imply(negate(runs(rival)), {Cause::Kind::literal, runs(task)});
  };
  const auto limits = catalog_.limits_of(first_task_ + task);
  return close_rivals(catalog_, domains_, task, close_rival) &&
         std::all_of(limits.begin(), limits.end(),
                     [this](std::uint32_t limit) { return close_limited(limit); });
}

bool CatalogTrail::follow_not_running(LocalTask task) {
  const Cause cause{Cause::Kind::literal, negate(runs(task))};
  const auto remove = [&](LocalTask source, const std::uint64_t* mask) {
    const auto values = static_cast<std::uint32_t>(domains_.values(source).size());
    for (const std::uint32_t index : Bits(mask, values)) {
      if (!imply(negate(has_value(source, index)), cause)) return false;
    }
    return true;
  };
  return remove_dependents(catalog_, domains_, task, remove);
}

/// What the one value requires; its arcs would give longer reasons.
bool CatalogTrail::follow_value(LocalTask /*task*/, ValueId value) {
  const Cause cause{Cause::Kind::literal, has_value(value)};
  for (const CompiledRequirement& requirement :
       catalog_.requirements[catalog_.values.items[value].behavior]) {
    if (!imply(runs(requirement.task - first_task_), cause)) return false;
  }
  return true;
}

bool CatalogTrail::follow_choice(LocalTask task) {
  return need_requirements(catalog_, domains_, task, [this](const Arc& arc, LocalTask target) {
    const auto number = static_cast<std::uint32_t>(&arc - catalog_.arcs.items.data());
    return imply(runs(target), {Cause::Kind::requirement, number});
  });
}

PerformanceReasons::PerformanceReasons(const CompiledCatalog& catalog, const Domains& domains,
                                       Trail& trail)
    : catalog_(catalog), domains_(domains), trail_(trail), performance_(catalog, domains) {}

void PerformanceReasons::load() {
  ruled_.clear();
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    if (catalog_.tasks[domains_.first_task() + task].has_performance_rules) ruled_.push_back(task);
  }
}

bool PerformanceReasons::propagate(const SearchBudget& budget) {
  for (const LocalTask task : ruled_) {
    if (budget.is_out_of_time()) return true;
    if (domains_.needed(task) && !performance_.revise(task, *this)) return false;
  }
  return true;
}

bool PerformanceReasons::refuse(const Demand& demand) {
  explain_bound(demand);
  trail_.set_conflict(reason_, {});
  return false;
}

/// Where the value is too low for the demand, what it requires counts with its best suitability.
bool PerformanceReasons::remove(LocalTask task, std::uint32_t index, const Demand& demand) {
  explain_bound(demand);
  for (const CompiledRequirement& rule :
       catalog_.requirements[domains_.value(task, index).behavior]) {
    const LocalTask required = rule.task - domains_.first_task();
    if (demand.task == none || domains_.count(required) == 0) continue;
    const std::uint32_t best = domains_.best(required);
    trail_.append_removals(
        required, [best](std::uint32_t each) { return each < best; }, reason_);
  }
  return trail_.imply(negate(trail_.has_value(task, index)), trail_.store(reason_));
}

/// The reason of the last bound: for each task of its closure the removals of better values, and of
/// those that do not require the tasks that count.
void PerformanceReasons::explain_bound(const Demand& demand) {
  reason_.clear();
  for (const LocalTask member : performance_.closure()) {
    trail_.append_removals(
        member, [&](std::uint32_t index) { return is_in_reason(member, index); }, reason_);
  }
  if (demand.task == none) return;
  reason_.push_back(demand.index == none ? Trail::runs(demand.task)
                                         : trail_.has_value(demand.task, demand.index));
}

bool PerformanceReasons::is_in_reason(LocalTask task, std::uint32_t index) const {
  if (domains_.count(task) == 0 || index < domains_.best(task)) return true;
  for (const Arc& arc : catalog_.arcs[domains_.first_task() + task]) {
    const std::uint64_t* const mask = &catalog_.masks[arc.mask];
    if (!has_bit(mask, index) && domains_.all_within(task, mask)) return true;
  }
  return false;
}

}  // namespace cbc
