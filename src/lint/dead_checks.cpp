#include "lint/dead_checks.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "explain/constraints.h"
#include "explain/minimal_set.h"
#include "lint/constraint_notes.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// With more constraints than this, finding a minimal set takes too long.
constexpr std::size_t most_constraints = 20'000;

/// A value is what is explained: a behavior of several tasks may be dead as a value of one of them
/// for one reason, and as a value of another for another.
class DeadChecks {
 public:
  explicit DeadChecks(Semantics& semantics)
      : semantics_(semantics),
        catalog_(semantics.compiled()),
        is_explained_below_(catalog_.values.items.size()) {
    for (TaskId task = 0; task < catalog_.tasks.size(); ++task) {
      is_dead_.push_back(semantics.liveness().of_task(task) == Liveness::State::dead);
    }
  }

  /// From the lowest level up: where something dead is required, the reason for that is known.
  void check() {
    for (const TaskId task : tasks_by_level(catalog_)) {
      if (catalog_.values[task].empty()) continue;  // reported as task-without-behavior
      // A behavior of several tasks explains all of them at once.
      check_behaviors(task, true);
      if (is_dead_[task]) check_task(task);
      check_behaviors(task, false);
    }
  }

 private:
  void check_task(TaskId task) {
    if (semantics_.is_explained_task(task)) return;
    const Semantics::Goal goal{task, none};
    const std::vector<Reason> constraints = unexplained_constraints({&goal, 1}, none);
    if (can_be_had({&goal, 1}, constraints)) return;
    const std::vector<Note> notes = find_reason({&goal, 1}, constraints);
    semantics_.reporter().report(
        rule::dead_task, semantics_.task(task).range,
        "task " + quote(semantics_.task(task).name) + " can never run" +
            (notes.empty() ? "" : ": together these constraints exclude all of its behaviors"),
        notes);
    semantics_.explain_task(task);
  }

  void check_behaviors(TaskId task, bool of_several_tasks) {
    for (const Value& value : catalog_.values[task]) {
      const bool has_several = catalog_.performs[value.behavior].size() > 1;
      if (has_several == of_several_tasks) check_behavior(value.behavior);
    }
  }

  void check_behavior(BehaviorId id) {
    if (semantics_.is_explained_behavior(id)) return;
    const Liveness::State state = semantics_.liveness().of_behavior(id);
    if (state == Liveness::State::live) return;
    const Behavior& behavior = semantics_.behavior(id);
    if (state == Liveness::State::undecided) {
      semantics_.report_undecided(behavior.range,
                                  "whether behavior " + quote(behavior.name) + " can be active");
      semantics_.explain_behavior(id);
      return;
    }
    std::vector<Semantics::Goal> goals;
    for (const ValueId value : catalog_.performs[id]) {
      const TaskId task = catalog_.task_of(value);
      goals.push_back({task, value - catalog_.values.begin[task]});
    }
    const std::vector<Reason> constraints = unexplained_constraints(goals, id);
    if (is_explained_elsewhere(id, goals, constraints)) return;
    const std::vector<Note> notes = find_reason(goals, constraints);
    semantics_.reporter().report(
        rule::dead_behavior, behavior.range,
        "behavior " + quote(behavior.name) + " can never be active" +
            (notes.empty() ? "" : ": together these constraints exclude it"),
        notes);
    semantics_.explain_behavior(id);
  }

  /// Whether a finding on one of its tasks, or what is explained below it, is why a behavior is
  /// dead: then it may come to life once that is mended.
  bool is_explained_elsewhere(BehaviorId id, std::span<const Semantics::Goal> goals,
                              const std::vector<Reason>& constraints) {
    bool is_explained = false;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const ValueId value = catalog_.performs[id][i];
      if (can_be_had(goals.subspan(i, 1), constraints)) is_explained_below_[value] = true;
      is_explained |= is_explained_value(value);
    }
    return is_explained;
  }

  bool can_be_had(std::span<const Semantics::Goal> goals, const std::vector<Reason>& constraints) {
    return constraints.size() <= most_constraints &&
           semantics_.solve(goals, constraints) == Feasibility::yes;
  }

  /// Why none of the goals can be had. Empty if the reason is beyond reach.
  std::vector<Note> find_reason(std::span<const Semantics::Goal> goals,
                                const std::vector<Reason>& constraints) {
    if (constraints.size() > most_constraints ||
        semantics_.solve(goals, constraints) != Feasibility::no) {
      return {};
    }
    const std::vector<Reason> reason = minimal_set(constraints, [&](std::span<const Reason> some) {
      return semantics_.solve(goals, some) != Feasibility::no;
    });
    return constraint_notes(reason, semantics_.catalog(), catalog_, semantics_.reporter());
  }

  /// The constraints that bear on the goals, but for those of what is explained already. `own`: the
  /// behavior that it is about, if it is about one.
  std::vector<Reason> unexplained_constraints(std::span<const Semantics::Goal> goals,
                                              BehaviorId own) {
    RelevantTasks relevant(catalog_, catalog_.tasks[goals.front().task].group);
    if (own == none) {
      relevant.add(goals.front().task);
    } else {
      for (const CompiledRequirement& requirement : catalog_.requirements[own]) {
        relevant.add(requirement.task);
      }
    }
    relevant.close();
    const std::vector<BehaviorId> behaviors = relevant.behaviors();
    for (const Semantics::Goal& goal : goals) relevant.add(goal.task);

    std::vector<Reason> reasons;
    for (const TaskId task : relevant.tasks()) {
      add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
      if (!semantics_.is_explained_task(task)) add_minimum(catalog_, task, reasons);
    }
    if (own != none) add_requirements(catalog_, own, reasons);
    for (const BehaviorId behavior : behaviors) {
      if (is_explained(behavior, goals, relevant)) continue;
      add_requirements(catalog_, behavior, reasons);
    }
    reasons.erase(std::remove_if(reasons.begin(), reasons.end(),
                                 [this](const Reason& reason) {
                                   return reason.behavior != none &&
                                          catalog_.values[reason.task].empty();
                                 }),
                  reasons.end());
    return reasons;
  }

  /// Whether what a behavior requires is no reason any more: it is dead, and that is explained, or
  /// it performs a task that is dead, and that the goals may require.
  [[nodiscard]] bool is_explained(BehaviorId behavior, std::span<const Semantics::Goal> goals,
                                  const RelevantTasks& relevant) const {
    if (semantics_.is_explained_behavior(behavior)) return true;
    const auto performed = catalog_.performs[behavior];
    const auto is_below = [&](TaskId task) {
      return relevant.contains(task) &&
             std::none_of(goals.begin(), goals.end(),
                          [task](const Semantics::Goal& goal) { return goal.task == task; });
    };
    return std::any_of(performed.begin(), performed.end(),
                       [&](ValueId value) {
                         const TaskId task = catalog_.task_of(value);
                         return is_dead_[task] && is_below(task);
                       }) ||
           std::all_of(performed.begin(), performed.end(),
                       [this](ValueId value) { return is_explained_value(value); });
  }

  [[nodiscard]] bool is_explained_value(ValueId value) const {
    return is_explained_below_[value] || semantics_.is_explained_task(catalog_.task_of(value));
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  std::vector<bool> is_dead_;             ///< by task
  std::vector<bool> is_explained_below_;  ///< by value: what it needs is dead, which is explained
};

}  // namespace

void check_dead(Semantics& semantics) { DeadChecks(semantics).check(); }

}  // namespace cbc
