#include "lint/liveness.h"

#include <algorithm>
#include <numeric>

namespace cbc {
namespace {

/// A sum of states: live if one is, dead if all are.
class Sum {
 public:
  void add(Liveness::State state) {
    is_live_ |= state == Liveness::State::live;
    is_undecided_ |= state == Liveness::State::undecided;
  }
  [[nodiscard]] Liveness::State state() const {
    if (is_live_) return Liveness::State::live;
    return is_undecided_ ? Liveness::State::undecided : Liveness::State::dead;
  }

 private:
  bool is_live_ = false;
  bool is_undecided_ = false;
};

}  // namespace

std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog) {
  std::vector<TaskId> order(catalog.tasks.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].level < catalog.tasks[b].level;
  });
  return order;
}

Liveness::Liveness(AssignmentSearch& search)
    : catalog_(search.catalog()),
      is_live_(catalog_.values.items.size(), false),
      is_dead_(catalog_.values.items.size(), false),
      direct_(catalog_) {
  for (const TaskId task : tasks_by_level(catalog_)) {
    for (ValueId value = catalog_.values.begin[task]; value < catalog_.values.begin[task + 1];
         ++value) {
      if (!is_live_[value]) decide(value, search);
    }
  }
}

/// What is in an assignment beside the value is live, too.
void Liveness::decide(ValueId value, AssignmentSearch& search) {
  const std::vector<ValueId>& values = direct_.find(value, is_dead_, is_live_);
  for (const ValueId other : values) is_live_[other] = true;
  if (!values.empty()) return;

  const Feasibility answer = search.find(value, {}, solution_);
  if (answer == Feasibility::no) {
    is_dead_[value] = true;
    search.rule_out(value);
  } else if (answer == Feasibility::yes) {
    const TaskId first = catalog_.group_tasks[catalog_.tasks[catalog_.task_of(value)].group];
    for (std::uint32_t task = 0; task < solution_.size(); ++task) {
      if (solution_[task] != none) {
        is_live_[catalog_.values.begin[first + task] + solution_[task]] = true;
      }
    }
  }
}

Liveness::State Liveness::of_behavior(BehaviorId behavior) const {
  Sum sum;
  for (const ValueId value : catalog_.performs[behavior]) sum.add(of_value(value));
  return sum.state();
}

Liveness::State Liveness::of_task(TaskId task) const {
  Sum sum;
  for (ValueId value = catalog_.values.begin[task]; value < catalog_.values.begin[task + 1];
       ++value) {
    sum.add(of_value(value));
  }
  return sum.state();
}

}  // namespace cbc
