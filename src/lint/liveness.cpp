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

/// Tasks that require little first, so that their dead values are known where they are required.
std::vector<TaskId> tasks_by_level(const CompiledCatalog& catalog) {
  std::vector<TaskId> order(catalog.tasks.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].level < catalog.tasks[b].level;
  });
  return order;
}

}  // namespace

Liveness::Liveness(AssignmentSearch& search)
    : catalog_(search.catalog()), values_(catalog_.values.items.size(), State::undecided) {
  Assignment solution;
  for (const TaskId task : tasks_by_level(catalog_)) {
    for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
      const ValueId value = catalog_.values.begin[task] + place;
      if (values_[value] == State::live) continue;
      const Feasibility answer = search.find(value, {}, solution);
      if (answer == Feasibility::no) {
        values_[value] = State::dead;
        search.rule_out(value);
      } else if (answer == Feasibility::yes) {
        // What is in a solution beside the value is live, too.
        const TaskId first = catalog_.group_tasks[catalog_.tasks[task].group];
        for (std::uint32_t other = 0; other < solution.size(); ++other) {
          if (solution[other] == none) continue;
          values_[catalog_.values.begin[first + other] + solution[other]] = State::live;
        }
      }
    }
  }
}

Liveness::State Liveness::of_behavior(BehaviorId behavior) const {
  Sum sum;
  for (const ValueId value : catalog_.performs[behavior]) sum.add(values_[value]);
  return sum.state();
}

Liveness::State Liveness::of_task(TaskId task) const {
  Sum sum;
  for (ValueId value = catalog_.values.begin[task]; value < catalog_.values.begin[task + 1];
       ++value) {
    sum.add(values_[value]);
  }
  return sum.state();
}

}  // namespace cbc
