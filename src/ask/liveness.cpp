// What no assignment that satisfies all constraints contains: the dead features of a feature model
// (D. Benavides, S. Segura and A. Ruiz-Cortés, "Automated analysis of feature models 20 years
// later: a literature review", Information Systems 35 (2010)). A value is live if some assignment
// has it; then all other values of that assignment are live, too. Most assignments are put together
// without a search; where that fails, the solver decides. Tasks come from the lowest level up, so
// that a behavior that requires a dead task is dead without a search.
//
// Propagation alone would find only some of what is dead. A decision diagram of all assignments
// would answer all questions at once, but may be far too large. Effort is counted in steps and not
// in seconds, so that every machine has the same findings; what stays open at the limit is reported
// as undecided.

#include "ask/liveness.h"

#include <algorithm>
#include <numeric>

namespace cbc {

namespace {

/// Values that may be taken in total.
constexpr std::uint64_t most_effort_of_direct = 200'000'000;

}  // namespace

/// Finds assignments without search, which is enough for most values of most catalogs: each task
/// that a value requires, directly or indirectly, runs with the first behavior that will do. An
/// assignment is extended as long as that is possible, so that a long chain of requirements is
/// walked once, and not once for each of its values.
class DirectAssignment {
 public:
  explicit DirectAssignment(const CompiledCatalog& catalog);

  /// The values of an assignment that has a value and satisfies all constraints; valid until the
  /// next call. Empty if none is found in this way. `is_dead`, `is_live`: by value.
  [[nodiscard]] const std::vector<ValueId>& find(ValueId value, const std::vector<bool>& is_dead,
                                                 const std::vector<bool>& is_live);

  /// Whether the assignment of the last call, if there is one, satisfies all constraints also with
  /// a value in addition, or in place of the one that its task has. If so, it is added.
  [[nodiscard]] bool extend(ValueId value);

 private:
  [[nodiscard]] bool is_running(TaskId task) const { return running_[task] == number_; }
  [[nodiscard]] bool take(ValueId value);
  [[nodiscard]] bool is_left_to_search(TaskId task) const {
    return catalog_.tasks[task].minimum_performance > 0 || !catalog_.limits_of(task).empty();
  }
  [[nodiscard]] ValueId choose(TaskId task, const std::vector<bool>& is_dead,
                               const std::vector<bool>& is_live) const;

  const CompiledCatalog& catalog_;
  std::vector<ValueId> values_;
  std::uint64_t number_ = 0;            ///< of the present assignment
  std::vector<std::uint64_t> running_;  ///< by task: last assignment in which it runs
  std::vector<std::uint64_t> used_;     ///< by clique: last assignment in which a task of it runs
  std::uint64_t effort_left_;
};

DirectAssignment::DirectAssignment(const CompiledCatalog& catalog)
    : catalog_(catalog),
      running_(catalog.tasks.size(), 0),
      used_(catalog.cliques.size(), 0),
      effort_left_(most_effort_of_direct) {}

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
      if (is_good && !is_running(requirement.task)) {
        const ValueId chosen = choose(requirement.task, is_dead, is_live);
        is_good = chosen != none && take(chosen);
      }
      if (!is_good) break;
    }
  }
  if (!is_good) values_.clear();
  return values_;
}

bool DirectAssignment::extend(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  if (values_.empty() || is_left_to_search(task)) return false;
  for (const CompiledRequirement& requirement :
       catalog_.requirements[catalog_.values.items[value].behavior]) {
    if (requirement.minimum_performance > 0 || !is_running(requirement.task)) return false;
  }
  if (is_running(task)) return true;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    if (used_[clique] == number_) return false;
  }
  return take(value);
}

bool DirectAssignment::take(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  if (effort_left_ == 0 || is_left_to_search(task)) return false;
  --effort_left_;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    if (used_[clique] == number_) return false;
    used_[clique] = number_;
  }
  running_[task] = number_;
  values_.push_back(value);
  return true;
}

/// A value that is known to be live, or else one that may be live.
ValueId DirectAssignment::choose(TaskId task, const std::vector<bool>& is_dead,
                                 const std::vector<bool>& is_live) const {
  ValueId chosen = none;
  for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
       ++value) {
    if (is_live[value]) return value;
    if (chosen == none && !is_dead[value]) chosen = value;
  }
  return chosen;
}

namespace {

/// The state of several things as one: live if one is, dead if all are.
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
  std::iota(order.begin(), order.end(), TaskId(0));
  std::stable_sort(order.begin(), order.end(), [&catalog](TaskId a, TaskId b) {
    return catalog.tasks[a].level < catalog.tasks[b].level;
  });
  return order;
}

Liveness::Liveness(AssignmentSearch& search)
    : catalog_(search.catalog()),
      is_live_(catalog_.values.items.size(), false),
      is_dead_(catalog_.values.items.size(), false) {
  DirectAssignment direct(catalog_);
  for (const TaskId task : tasks_by_level(catalog_)) {
    for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
         ++value) {
      if (!is_live_[value]) decide(value, direct, search);
    }
  }
}

/// Whether a value requires a task of which all values are known to be dead.
bool Liveness::requires_dead_task(ValueId value) const {
  const BehaviorId behavior = catalog_.values.items[value].behavior;
  const auto& requirements = catalog_.requirements[behavior];
  return std::any_of(requirements.begin(), requirements.end(),
                     [this](const CompiledRequirement& requirement) {
                       return of_task(requirement.task) == State::dead;
                     });
}

/// All other values of the assignment that is found are live, too.
void Liveness::decide(ValueId value, DirectAssignment& direct, AssignmentSearch& search) {
  if (direct.extend(value)) {
    is_live_[value] = true;
    return;
  }
  if (requires_dead_task(value)) {
    is_dead_[value] = true;
    search.rule_out(value);
    return;
  }
  const std::vector<ValueId>& values = direct.find(value, is_dead_, is_live_);
  for (const ValueId other : values) is_live_[other] = true;
  if (!values.empty()) return;

  const TaskId task = catalog_.task_of(value);
  const Demand has{Demand::Kind::has, task, value - catalog_.values.begin[task]};
  const Feasibility answer = search.find(catalog_.tasks[task].group, {&has, 1}, solution_);
  if (answer == Feasibility::no) {
    is_dead_[value] = true;
    search.rule_out(value);
  } else if (answer == Feasibility::yes) {
    const TaskId first = catalog_.group_tasks[catalog_.tasks[task].group];
    for (LocalTask local(0); local < solution_.size(); ++local) {
      if (solution_[local] != none) {
        is_live_[catalog_.values.begin[first + local] + solution_[local]] = true;
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
  for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
       ++value) {
    sum.add(of_value(value));
  }
  return sum.state();
}

}  // namespace cbc
