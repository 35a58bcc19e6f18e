#include "coordinator/conflict.h"

#include <algorithm>

#include "explain/constraints.h"
#include "explain/minimal_set.h"
#include "explain/relaxed_problem.h"

namespace cbc {
namespace {

/// With more possible reasons than this, finding a minimal set takes too long.
constexpr std::size_t most_candidates = 20'000;

/// All that may speak against the event.
class Candidates {
 public:
  Candidates(const CompiledCatalog& catalog, const State& state, const Trigger& trigger,
             std::span<const BehaviorId> failed)
      : catalog_(catalog),
        state_(state),
        trigger_(trigger),
        failed_(failed),
        relevant_(catalog, trigger.group) {}

  std::vector<Reason> collect() && {
    find_relevant_tasks();
    for (const TaskId task : relevant_.tasks()) {
      add_exclusions(catalog_, task, relevant_, most_candidates + 1, reasons_);
      add_state(task);
      add_minimum(catalog_, task, reasons_);
    }
    for (const BehaviorId behavior : relevant_.behaviors()) {
      add_condition(behavior);
      add_requirements(catalog_, behavior, reasons_);
    }
    return std::move(reasons_);
  }

 private:
  [[nodiscard]] bool is_protected(TaskId task) const {
    return task != trigger_.task && cbc::is_protected(state_, trigger_, task, trigger_.priority);
  }

  void find_relevant_tasks() {
    for (TaskId task = catalog_.group_tasks[trigger_.group];
         task < catalog_.group_tasks[trigger_.group + 1]; ++task) {
      if (task == trigger_.task || is_protected(task)) relevant_.add(task);
    }
    relevant_.close();
  }

  void add_state(TaskId task) {
    if (task == trigger_.task) return;
    Reason reason;
    reason.task = task;
    if (is_protected(task)) {
      reason.kind = Reason::Kind::is_protected;
      reason.priority = state_.request(task).priority;
      reasons_.push_back(reason);
    } else if (!state_.is_running(task) && catalog_.tasks[task].start_on_request) {
      reason.kind = Reason::Kind::on_request;
      reasons_.push_back(reason);
    }
  }

  void add_condition(BehaviorId behavior) {
    Reason reason;
    reason.behavior = behavior;
    if (std::find(failed_.begin(), failed_.end(), behavior) != failed_.end()) {
      reason.kind = Reason::Kind::faulty;
      reasons_.push_back(reason);
    } else if (!state_.is_available(behavior)) {
      reason.kind = Reason::Kind::unavailable;
      reasons_.push_back(reason);
    }
  }

  const CompiledCatalog& catalog_;
  const State& state_;
  const Trigger& trigger_;
  const std::span<const BehaviorId> failed_;
  RelevantTasks relevant_;
  std::vector<Reason> reasons_;
};

}  // namespace

std::vector<Reason> find_conflict(const CompiledCatalog& catalog, const State& state,
                                  const Trigger& trigger, std::span<const BehaviorId> failed) {
  const bool is_start = trigger.kind == Trigger::Kind::start;
  if (is_start && catalog.values[trigger.task].empty()) {
    Reason reason;
    reason.kind = Reason::Kind::no_behavior;
    reason.task = trigger.task;
    return {reason};
  }
  const std::vector<Reason> candidates = Candidates(catalog, state, trigger, failed).collect();
  if (candidates.empty() || candidates.size() > most_candidates) return {};

  std::vector<std::uint32_t> present;
  for (TaskId task = catalog.group_tasks[trigger.group];
       task < catalog.group_tasks[trigger.group + 1]; ++task) {
    present.push_back(state.place(task));
  }
  RelaxedProblem problem(catalog, trigger.group, present, trigger.task,
                         is_start ? RelaxedProblem::Goal::run : RelaxedProblem::Goal::stop);
  const HasSolution has_solution = [&problem](std::span<const Reason> reasons) {
    return problem.solve(reasons) != Feasibility::no;
  };
  if (has_solution(candidates)) return {};
  return minimal_set(candidates, has_solution);
}

}  // namespace cbc
