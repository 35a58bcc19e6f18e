#include "verify/engine/task_search.h"

#include <algorithm>

namespace cbc {

BehaviorSet behaviors_of(const CompiledCatalog& catalog, TaskId task,
                         const Assignment& assignment) {
  const TaskId first = catalog.group_tasks[catalog.tasks[task].group];
  BehaviorSet active;
  for (LocalTask local(0); local < assignment.size(); ++local) {
    if (assignment[local] == none) continue;
    active.push_back(catalog.values[first + local][assignment[local]].behavior);
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  return active;
}

TaskSearch::TaskSearch(const CompiledCatalog& catalog, TaskId task, Wanted wanted)
    : catalog_(catalog),
      task_(task),
      first_task_(catalog.group_tasks[catalog.tasks[task].group]),
      wanted_(wanted) {
  problem_.group = catalog.tasks[task].group;
  const TaskId end = catalog.group_tasks[problem_.group + 1];
  problem_.domains.assign(catalog.words[end] - catalog.words[first_task_], 0);
  problem_.may_stop.assign(end - first_task_, 1);
  problem_.may_stop[task - first_task_] = 0;
  problem_.present.assign(end - first_task_, none);
  problem_.requests = {task - first_task_};
  for (ValueId value(catalog.values.begin[first_task_]); value < catalog.values.begin[end];
       ++value) {
    flip(value);
  }
  full_domains_ = problem_.domains;
  constexpr std::uint64_t first_budget = 10'000;
  set_budget(first_budget);
}

TaskSearch::Answer TaskSearch::find_without(const std::vector<bool>& absent,
                                            const std::function<bool()>& keep_on) {
  problem_.domains = full_domains_;
  for (BehaviorId behavior = catalog_.group_behaviors[problem_.group];
       behavior < catalog_.group_behaviors[problem_.group + 1]; ++behavior) {
    if (!absent[behavior]) continue;
    for (const ValueId value : catalog_.performs[behavior]) flip(value);
  }
  for (;;) {
    if (!keep_on()) return Answer::stopped;
    const SearchStatus status = solver_->solve(problem_, assignment_).status;
    if (status == SearchStatus::infeasible) return Answer::impossible;
    if (status == SearchStatus::optimal) return Answer::found;
    if (wanted_ == Wanted::any && has_solution(status)) return Answer::found;
    set_budget(2 * budget_);
  }
}

/// A hard search begins anew with twice the decisions, which at most triples the effort, so that
/// it can be stopped in between.
void TaskSearch::set_budget(std::uint64_t nodes) {
  budget_ = nodes;
  SearchOptions options;
  options.max_nodes = nodes;
  if (wanted_ == Wanted::any) {
    options.any_solution = true;
    options.easy_nodes = UINT64_MAX;  // bounds are about the objective, which does not matter here
  }
  solver_.emplace(catalog_, options, no_ranks_);
}

void TaskSearch::flip(ValueId value) {
  const TaskId task = catalog_.task_of(value);
  const std::uint32_t place = value - catalog_.values.begin[task];
  const std::uint32_t word = catalog_.words[task] - catalog_.words[first_task_] + place / 64;
  problem_.domains[word] ^= std::uint64_t{1} << (place % 64);
}

}  // namespace cbc
