#include "lint/direct_assignment.h"

namespace cbc {
namespace {

/// Values that may be taken in all.
constexpr std::uint64_t most_effort = 200'000'000;

}  // namespace

DirectAssignment::DirectAssignment(const CompiledCatalog& catalog)
    : catalog_(catalog),
      running_(catalog.tasks.size(), 0),
      used_(catalog.cliques.size(), 0),
      effort_left_(most_effort) {}

const std::vector<ValueId>& DirectAssignment::find(ValueId value, const std::vector<bool>& is_dead,
                                                   const std::vector<bool>& is_live) {
  values_.clear();
  ++number_;
  bool is_good = take(value);
  for (std::size_t next = 0; is_good && next < values_.size(); ++next) {
    const BehaviorId behavior = catalog_.values.items[values_[next]].behavior;
    for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
      // Minimums are left to the search.
      is_good = requirement.minimum_performance == 0;
      if (is_good && running_[requirement.task] != number_) {
        const ValueId chosen = choose(requirement.task, is_dead, is_live);
        is_good = chosen != none && take(chosen);
      }
      if (!is_good) break;
    }
  }
  if (!is_good) values_.clear();
  return values_;
}

bool DirectAssignment::take(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  if (effort_left_ == 0 || catalog_.tasks[task].minimum_performance > 0) return false;
  --effort_left_;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    if (used_[clique] == number_) return false;
    used_[clique] = number_;
  }
  running_[task] = number_;
  values_.push_back(value);
  return true;
}

/// A value that is known to be live, or else one that may be.
ValueId DirectAssignment::choose(TaskId task, const std::vector<bool>& is_dead,
                                 const std::vector<bool>& is_live) const {
  ValueId chosen = none;
  for (ValueId value = catalog_.values.begin[task]; value < catalog_.values.begin[task + 1];
       ++value) {
    if (is_live[value]) return value;
    if (chosen == none && !is_dead[value]) chosen = value;
  }
  return chosen;
}

}  // namespace cbc
