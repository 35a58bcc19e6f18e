#include "runtime/solver/performance_bound.h"

#include "runtime/compiled/log_cost.h"

namespace cbc {

PerformanceBound::PerformanceBound(const CompiledCatalog& catalog, const Domains& domains)
    : catalog_(catalog), domains_(domains) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  closure_.reserve(most_tasks);
  in_closure_.resize(most_tasks, 0);
  product_.reserve(most_tasks);
  minimum_.reserve(most_tasks);
}

PerformanceBound::Bound PerformanceBound::bound(std::uint32_t task) {
  ++closure_number_;
  closure_.clear();
  closure_.push_back(task);
  in_closure_[task] = closure_number_;
  Bound bound;
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const std::uint32_t member = closure_[next];
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
      const std::uint32_t target = arc.target - domains_.first_task();
      if (in_closure_[target] == closure_number_) continue;
      if (!domains_.all_within(member, &catalog_.masks[arc.mask])) continue;
      in_closure_[target] = closure_number_;
      closure_.push_back(target);
    }
  }
  return bound;
}

bool PerformanceBound::is_below(const Bound& bound, Millionths minimum, std::int64_t minimum_cost) {
  if (!bound.reachable || bound.zero) return true;
  const std::int64_t slack = log_cost_error * (bound.factors + 1);
  if (bound.cost > minimum_cost + slack) return true;
  if (bound.cost < minimum_cost - slack) return false;
  product_.clear();
  for (const std::uint32_t member : closure_) {
    const Millionths best = domains_.value(member, domains_.best(member)).suitability;
    if (best != one_million) product_.multiply(best);
  }
  minimum_.clear();
  minimum_.multiply(minimum);
  return ExactProduct::compare(product_, minimum_) < 0;
}

}  // namespace cbc
