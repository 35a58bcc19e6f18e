#include "lint/dead_checks.h"

#include <algorithm>
#include <numeric>
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

class DeadChecks {
 public:
  explicit DeadChecks(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  /// From the lowest level up: where something dead is required, the reason for that is known.
  void check() {
    std::vector<TaskId> order(catalog_.tasks.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [this](TaskId a, TaskId b) {
      return catalog_.tasks[a].level < catalog_.tasks[b].level;
    });
    for (const TaskId task : order) {
      if (catalog_.values[task].empty()) continue;  // reported as task-without-behavior
      if (semantics_.liveness().of_task(task) == Liveness::State::dead) check_task(task);
      for (const Value& value : catalog_.values[task]) check_behavior(value.behavior);
    }
  }

 private:
  void check_task(TaskId task) {
    if (semantics_.is_explained_task(task)) {
      explain_behaviors(task);
      return;
    }
    const Semantics::Goal goal{task, none};
    const auto notes = find_reason({&goal, 1}, none);
    if (!notes) return;
    semantics_.reporter().report(
        rule::dead_task, semantics_.task(task).range,
        "task " + quote(semantics_.task(task).name) + " can never run" +
            (notes->empty() ? "" : ": together these constraints exclude all of its behaviors"),
        *notes);
    semantics_.explain_task(task);
    explain_behaviors(task);
  }

  void explain_behaviors(TaskId task) {
    for (const Value& value : catalog_.values[task]) {
      if (semantics_.liveness().of_behavior(value.behavior) == Liveness::State::dead) {
        semantics_.explain_behavior(value.behavior);
      }
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
    if (const auto notes = find_reason(goals, id)) {
      semantics_.reporter().report(
          rule::dead_behavior, behavior.range,
          "behavior " + quote(behavior.name) + " can never be active" +
              (notes->empty() ? "" : ": together these constraints exclude it"),
          *notes);
    }
    semantics_.explain_behavior(id);
  }

  /// Why none of the goals can be had; none if what is explained already is the reason. Empty if
  /// the reason is beyond reach. `own`: the behavior that it is about, if it is about one.
  std::optional<std::vector<Note>> find_reason(std::span<const Semantics::Goal> goals,
                                               BehaviorId own) {
    const std::vector<Reason> constraints = unexplained_constraints(goals, own);
    if (constraints.size() > most_constraints) return std::vector<Note>();
    const Feasibility answer = semantics_.solve(goals, constraints);
    if (answer == Feasibility::yes) return std::nullopt;
    if (answer == Feasibility::unknown) return std::vector<Note>();
    const std::vector<Reason> reason = minimal_set(constraints, [&](std::span<const Reason> some) {
      return semantics_.solve(goals, some) != Feasibility::no;
    });
    return constraint_notes(reason, semantics_.catalog(), catalog_, semantics_.reporter());
  }

  /// The constraints that bear on the goals, but for those of what is explained already.
  std::vector<Reason> unexplained_constraints(std::span<const Semantics::Goal> goals,
                                              BehaviorId own) {
    RelevantTasks relevant(catalog_, catalog_.tasks[goals.front().task].group);
    for (const Semantics::Goal& goal : goals) relevant.add(goal.task);
    relevant.close();
    std::vector<Reason> reasons;
    for (const TaskId task : relevant.tasks()) {
      add_exclusions(catalog_, task, relevant, most_constraints + 1, reasons);
      if (!semantics_.is_explained_task(task)) add_minimum(catalog_, task, reasons);
    }
    for (const BehaviorId behavior : relevant.behaviors()) {
      if (behavior != own && is_explained(behavior)) continue;
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

  [[nodiscard]] bool is_explained(BehaviorId behavior) const {
    const auto performed = catalog_.performs[behavior];
    return semantics_.is_explained_behavior(behavior) ||
           std::any_of(performed.begin(), performed.end(), [this](ValueId value) {
             return semantics_.is_explained_task(catalog_.task_of(value));
           });
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
};

}  // namespace

void check_dead(Semantics& semantics) { DeadChecks(semantics).check(); }

}  // namespace cbc
