#include "ask/group_search.h"

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

GroupSearch::GroupSearch(const CompiledCatalog& catalog, GroupId group, Wanted wanted)
    : catalog_(catalog),
      first_task_(catalog.group_tasks[group]),
      end_task_(catalog.group_tasks[group + 1]),
      wanted_(wanted) {
  problem_.group = group;
  problem_.present.assign(end_task_ - first_task_, none);
  constexpr std::uint64_t first_budget = 10'000;
  set_budget(first_budget);
}

GroupSearch::Answer GroupSearch::find(const GroupDemand& demand, const KeepOn& keep_on) {
  take(demand);
  for (;;) {
    if (!keep_on(budget_)) return Answer::stopped;
    const SearchStatus status = solver_->solve(problem_, assignment_).status;
    if (status == SearchStatus::infeasible) return Answer::impossible;
    if (status == SearchStatus::optimal) return Answer::found;
    if (wanted_ == Wanted::any && has_solution(status)) return Answer::found;
    set_budget(2 * budget_);
  }
}

void GroupSearch::take(const GroupDemand& demand) {
  const std::uint32_t first_word = catalog_.words[first_task_];
  problem_.domains.assign(catalog_.words[end_task_] - first_word, 0);
  problem_.may_stop.assign(end_task_ - first_task_, 1);
  problem_.requests.clear();
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (demand.runs[task]) {
      problem_.may_stop[task - first_task_] = 0;
      problem_.requests.push_back(task - first_task_);
    }
    const ValueId begin(catalog_.values.begin[task]);
    for (std::uint32_t place = 0; place < catalog_.values[task].size(); ++place) {
      if (demand.ruled_out[begin + place]) continue;
      problem_.domains[catalog_.words[task] - first_word + place / 64] |= std::uint64_t{1}
                                                                          << (place % 64);
    }
  }
}

/// A hard search begins anew with twice the decisions, which at most triples the effort, so that
/// it can be stopped in between.
void GroupSearch::set_budget(std::uint64_t nodes) {
  budget_ = nodes;
  SearchOptions options;
  options.max_nodes = nodes;
  if (wanted_ == Wanted::any) {
    options.any_solution = true;
    options.easy_nodes = UINT64_MAX;  // bounds are about the objective, which does not matter here
  }
  solver_.emplace(catalog_, options, no_ranks_);
}

}  // namespace cbc
