// See proofs.h, check_situations.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "diagnostic/rules.h"
#include "lint/proofs.h"
#include "lint/situations.h"

namespace cbc {
namespace {

/// What the constraints allow is dead nevertheless if it takes behaviors that fit in no common
/// situation. As with the constraints, a fault is reported where it is, and not again above.
class SituationCheck {
 public:
  explicit SituationCheck(ProofContext& proof)
      : proof_(proof), catalog_(proof.compiled()), is_dead_(catalog_.tasks.size(), false) {}

  void check() {
    if (catalog_.variables.empty()) return;
    for (const TaskId task : tasks_by_level(catalog_)) check_task(task);
  }

 private:
  void check_task(TaskId task) {
    if (proof_.liveness().of_task(task) == Liveness::State::dead) return;
    const std::vector<std::uint32_t> variables = variables_of(catalog_, {&task, 1});
    if (variables.empty()) return;
    std::vector<BehaviorId> dead;
    const std::span<const Value> values = catalog_.values[task];
    for (const Value& value : values) {
      const bool is_dead_already =
          proof_.liveness().of_behavior(value.behavior) == Liveness::State::dead;
      if (is_dead_already || can_be_active(value.behavior)) continue;
      dead.push_back(value.behavior);
    }
    if (dead.empty()) return;
    is_dead_[task] = !can_run(task, variables);
    if (is_dead_[task]) {
      if (!std::all_of(dead.begin(), dead.end(), [this](BehaviorId id) { return is_told(id); })) {
        report_task(task);
      }
      for (const BehaviorId behavior : dead) proof_.explain_behavior(behavior);
      return;
    }
    for (const BehaviorId behavior : dead) {
      if (!is_told(behavior)) report_behavior(behavior);
      proof_.explain_behavior(behavior);
    }
  }

  /// Whether a finding says so already: about the behavior, or about what it requires.
  [[nodiscard]] bool is_told(BehaviorId behavior) const {
    const auto requirements = catalog_.requirements[behavior];
    return proof_.is_explained_behavior(behavior) ||
           std::any_of(
               requirements.begin(), requirements.end(),
               [this](const CompiledRequirement& required) { return is_dead_[required.task]; });
  }

  [[nodiscard]] bool can_run(TaskId task, const std::vector<std::uint32_t>& variables) {
    return ask_in_situations(catalog_, variables, [&](std::span<const std::uint32_t> situation) {
             return proof_.search().find_running({&task, 1}, situation, solution_);
           }) != Feasibility::no;
  }

  /// For any of its tasks. True if that is not known.
  [[nodiscard]] bool can_be_active(BehaviorId behavior) {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(), [&](ValueId value) {
      const TaskId task = catalog_.task_of(value);
      return ask_in_situations(catalog_, variables_of(catalog_, {&task, 1}),
                               [&](std::span<const std::uint32_t> situation) {
                                 return proof_.search().find(value, {}, solution_, situation);
                               }) != Feasibility::no;
    });
  }

  void report_task(TaskId id) {
    const Task& task = proof_.task(id);
    const Demands demands{{Demand::Kind::run, id, none}};
    proof_.reporter().report(
        rule::dead_task, task.range,
        "task " + quote(task.name) +
            " can never run: what it takes to run fits in no common situation",
        proof_.notes_of(conflict_in_all_situations(catalog_, demands, effort_left_)));
  }

  void report_behavior(BehaviorId id) {
    const Behavior& behavior = proof_.behavior(id);
    const ValueId value = catalog_.performs[id].front();
    const TaskId task = catalog_.task_of(value);
    const Demands demands{{Demand::Kind::has, task, value - catalog_.values.begin[task]}};
    proof_.reporter().report(
        rule::dead_behavior, behavior.range,
        "behavior " + quote(behavior.name) +
            " can never be active: it fits in no situation in which what it requires does",
        proof_.notes_of(conflict_in_all_situations(catalog_, demands, effort_left_)));
  }

  ProofContext& proof_;
  const CompiledCatalog& catalog_;
  std::vector<bool> is_dead_;  ///< by task, because of the situation
  Assignment solution_;
  std::uint64_t effort_left_ = 100'000'000;  ///< reasons that may be examined in total
};

}  // namespace

void check_situations(ProofContext& proof) { SituationCheck(proof).check(); }

}  // namespace cbc
