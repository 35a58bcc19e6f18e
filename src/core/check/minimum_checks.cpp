// See proofs.h: minimum performances that are reached anyway.
#include <string>
#include <vector>

#include "ask/conflict/conflict_search.h"
#include "ask/conflict/reasons.h"
#include "core/check/proofs.h"
#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

class RedundantMinimumCheck {
 public:
  explicit RedundantMinimumCheck(ProofContext& proof) : proof_(proof), catalog_(proof.compiled()) {}

  void check() {
    for (TaskId task(0); task < catalog_.tasks.size(); ++task) check_task(task);
    for (BehaviorId id(0); id < catalog_.behaviors.size(); ++id) check_behavior(id);
  }

 private:
  void check_task(TaskId id) {
    const Millionths minimum = catalog_.tasks[id].minimum_performance;
    if (minimum == 0 || proof_.liveness().of_task(id) != Liveness::State::live) return;
    RelevantTasks relevant(catalog_, catalog_.tasks[id].group);
    relevant.add(id);
    const Task& task = proof_.task(id);
    report({{Demand::Kind::run, id, none}}, none, {id, minimum}, relevant,
           task.minimum_performance_range, "task " + quote(task.name) + " runs");
  }

  void check_behavior(BehaviorId id) {
    if (proof_.liveness().of_behavior(id) != Liveness::State::live) return;
    Demands goals;
    RelevantTasks relevant(catalog_, catalog_.group_of(id));
    for (const ValueId value : catalog_.performs[id]) {
      const TaskId task = catalog_.task_of(value);
      goals.push_back(proof_.has(value));
      relevant.add(task);
    }
    for (const CompiledRequirement& requirement : catalog_.requirements[id]) {
      if (requirement.minimum_performance == 0) continue;
      const Behavior& behavior = proof_.behavior(id);
      const TaskIndex task = catalog_.tasks[requirement.task].catalog_index;
      report(goals, id, {requirement.task, requirement.minimum_performance}, relevant,
             strongest_requirement(behavior, task).minimum_performance_range,
             "behavior " + quote(behavior.name) + " is active");
    }
  }

  struct Minimum {
    TaskId task = none;
    Millionths performance = 0;
  };

  /// Reports a minimum if the task reaches it wherever one of the goals is reached under the other
  /// constraints. `owner`: the behavior that has it, or none.
  void report(const Demands& goals, BehaviorId owner, const Minimum& minimum,
              RelevantTasks relevant, const Range& range, const std::string& condition) {
    const std::string task = quote(proof_.task(minimum.task).name);
    switch (is_missed(goals, minimum, other_constraints(owner, minimum, relevant))) {
      case Feasibility::yes:
        break;
      case Feasibility::no:
        proof_.reporter().report(rule::redundant_minimum, range,
                                 "this minimum decides nothing: wherever " + condition + ", " +
                                     task + " performs with at least " +
                                     format_percent(minimum.performance) + " anyway");
        break;
      case Feasibility::unknown:
        proof_.report_undecided(
            range, "whether this minimum performance of " + task + " decides anything");
        break;
    }
  }

  /// The constraints that bear on the tasks and on what they may require, but for the minimum.
  std::vector<Reason> other_constraints(BehaviorId owner, const Minimum& minimum,
                                        RelevantTasks& relevant) const {
    relevant.close();
    std::vector<Reason> constraints = constraints_on(catalog_, relevant);
    std::erase_if(constraints, [&](const Reason& reason) {
      return reason.kind == Reason::Kind::performance && reason.behavior == owner &&
             reason.task == minimum.task;
    });
    return constraints;
  }

  /// Whether the task can run below the minimum while one of the goals is reached.
  Feasibility is_missed(const Demands& goals, const Minimum& minimum,
                        const std::vector<Reason>& constraints) {
    if (constraints.size() > most_constraints) return Feasibility::unknown;
    RelaxedQuestions questions(proof_.space(), proof_.effort());
    for (const Demand& goal : goals) {
      questions.add({{catalog_.tasks[goal.task].group, {goal}, minimum.task, minimum.performance}});
    }
    return questions.solve(constraints);
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
};

}  // namespace

void check_redundant_minimums(ProofContext& proof) { RedundantMinimumCheck(proof).check(); }

}  // namespace cbc
