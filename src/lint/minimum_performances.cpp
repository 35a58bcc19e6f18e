#include "lint/minimum_performances.h"

#include <string>
#include <unordered_map>
#include <vector>

#include "cbc/rules.h"
#include "lint/percent.h"
#include "solver/exact_product.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

bool is_below(const std::vector<Millionths>& factors, Millionths minimum) {
  ExactProduct product;
  for (const Millionths factor : factors) product.multiply(factor);
  ExactProduct least;
  least.multiply(minimum);
  return ExactProduct::compare(product, least) < 0;
}

class MinimumCheck {
 public:
  explicit MinimumCheck(Semantics& semantics)
      : semantics_(semantics), catalog_(semantics.compiled()) {}

  /// What a live behavior requires is reached. Where the required task cannot run at all, that is
  /// the fault.
  void check_behavior(BehaviorId id) {
    if (semantics_.liveness().of_behavior(id) != Liveness::State::dead) return;
    const Behavior& behavior = semantics_.behavior(id);
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.minimum_performance == 0) continue;
      const TaskId task = catalog_.task_ids[requirement.task];
      if (semantics_.liveness().of_task(task) != Liveness::State::live) continue;
      const AssignmentSearch::Best& best = best_of(task);
      const std::string name = quote(semantics_.task(task).name);
      if (best.exists == Feasibility::unknown) {
        semantics_.report_undecided(
            requirement.minimum_performance_range,
            "whether " + name + " can reach " + format_percent(requirement.minimum_performance));
      } else if (best.exists == Feasibility::yes &&
                 is_below(best.factors, requirement.minimum_performance)) {
        semantics_.reporter().report(
            rule::unreachable_performance, requirement.minimum_performance_range,
            "behavior " + quote(behavior.name) + " requires " + name + " with at least " +
                format_percent(requirement.minimum_performance) +
                ", but the best that can be reached is " + show_product(best.factors));
        semantics_.explain_behavior(id);
      }
    }
  }

  void check_task(TaskId id) {
    const Task& task = semantics_.task(id);
    if (task.minimum_performance == 0 || catalog_.values[id].empty()) return;
    if (semantics_.liveness().of_task(id) != Liveness::State::dead) return;
    const AssignmentSearch::Best best = semantics_.search().best_performance(id, true);
    if (best.exists == Feasibility::unknown) {
      semantics_.report_undecided(
          task.minimum_performance_range,
          "whether " + quote(task.name) + " can reach " + format_percent(task.minimum_performance));
    } else if (best.exists == Feasibility::yes) {
      semantics_.reporter().report(rule::unreachable_performance, task.minimum_performance_range,
                                   "task " + quote(task.name) + " must perform with at least " +
                                       format_percent(task.minimum_performance) +
                                       ", but the best that can be reached is " +
                                       show_product(best.factors));
      semantics_.explain_task(id);
    }
  }

 private:
  const AssignmentSearch::Best& best_of(TaskId task) {
    const auto [entry, is_new] = best_.try_emplace(task);
    if (is_new) entry->second = semantics_.search().best_performance(task, false);
    return entry->second;
  }

  Semantics& semantics_;
  const CompiledCatalog& catalog_;
  std::unordered_map<TaskId, AssignmentSearch::Best> best_;
};

}  // namespace

void check_minimum_performances(Semantics& semantics) {
  MinimumCheck check(semantics);
  const CompiledCatalog& catalog = semantics.compiled();
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) check.check_task(task);
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    check.check_behavior(behavior);
  }
}

}  // namespace cbc
