#include "coverage/engine/goal_proof.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "coverage/engine/goal_watch.h"

namespace cbc {
namespace {

/// Where reactive tasks give way, and start by themselves.
class Returns final : private GroupWalk::Listener {
 public:
  GroupWalkResult run(GroupWalk& walk) {
    const GroupWalkResult result = walk.run(*this);
    next_.resize(result.states);
    return result;
  }

  /// The reactive tasks that start by themselves in some path after they have given way.
  [[nodiscard]] std::vector<TaskId> find() const {
    std::vector<TaskId> tasks;
    for (const auto& [task, states] : left_behind_) {
      const auto starts = starts_from_.find(task);
      if (starts != starts_from_.end() && leads_to_any(states, starts->second)) {
        tasks.push_back(task);
      }
    }
    return tasks;
  }

 private:
  void on_move(GroupWalk::Number from, GroupWalk::Number to, const Move& /*move*/,
               const StateReplay& replay) override {
    if (next_.size() <= from) next_.resize(from + 1);
    next_[from].push_back(to);
    for (const TaskId task : replay.gave_way()) left_behind_[task].push_back(to);
    for (const TaskId task : replay.started()) starts_from_[task].push_back(from);
  }

  [[nodiscard]] bool leads_to_any(const std::vector<GroupWalk::Number>& from,
                                  const std::vector<GroupWalk::Number>& to) const {
    std::vector<std::uint8_t> is_wanted(next_.size(), 0);
    for (const GroupWalk::Number state : to) is_wanted[state] = 1;
    std::vector<std::uint8_t> is_seen(next_.size(), 0);
    std::vector<GroupWalk::Number> waiting;
    const auto add = [&](GroupWalk::Number state) {
      if (std::exchange(is_seen[state], std::uint8_t{1}) == 0) waiting.push_back(state);
    };
    for (const GroupWalk::Number state : from) add(state);
    while (!waiting.empty()) {
      const GroupWalk::Number state = waiting.back();
      waiting.pop_back();
      if (is_wanted[state] != 0) return true;
      for (const GroupWalk::Number reached : next_[state]) add(reached);
    }
    return false;
  }

  std::deque<std::vector<GroupWalk::Number>> next_;
  /// The states after a task gave way.
  std::map<TaskId, std::vector<GroupWalk::Number>> left_behind_;
  /// The states before a task started by itself.
  std::map<TaskId, std::vector<GroupWalk::Number>> starts_from_;
};

/// The groups that a goal is about: of a variable those whose behaviors name it.
std::vector<std::uint32_t> groups_of(const CompiledCatalog& catalog, const Goal& goal) {
  if (goal.task != none) return {catalog.tasks[goal.task].group};
  if (goal.behavior != none) return {catalog.group_of(goal.behavior)};
  std::vector<std::uint32_t> groups;
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (fitting.variable == goal.variable) groups.push_back(catalog.group_of(fitting.behavior));
  }
  return groups;
}

/// Of a variable that no behavior names.
bool may_have(const Assumptions& assumptions, const Goal& goal) {
  return initial_value(assumptions, goal.variable) == goal.value ||
         std::find(assumptions.variables.begin(), assumptions.variables.end(), goal.variable) !=
             assumptions.variables.end();
}

}  // namespace

Assumptions assumptions_of_goals(const CompiledCatalog& catalog) {
  Assumptions assumptions = default_assumptions(catalog);
  assumptions.start.clear();
  assumptions.stop.clear();
  for (const TaskId task : catalog.task_ids) {
    const CompiledTask& compiled = catalog.tasks[task];
    const bool starts_otherwise = compiled.reactive_start != 0 || !catalog.incoming[task].empty();
    if (compiled.start_on_request == 0 && starts_otherwise) continue;
    assumptions.start.push_back({task, {1, 2}});
    assumptions.stop.push_back(task);
  }
  return assumptions;
}

GoalProof prove_unreachable(const CompiledCatalog& catalog, std::span<const Goal> goals,
                            const Assumptions& assumptions, const GoalProofOptions& options) {
  GoalProof proof;
  proof.unreachable.resize(goals.size());
  proof.groups.resize(catalog.group_count());
  GoalWatch watch(catalog, goals, {});
  watch.take_failures_for_timeouts();
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) {
    if (options.group.value_or(group) != group) continue;
    if (options.walk.on_progress && !options.walk.on_progress(group, 0)) break;
    GroupWalk walk(catalog, group, assumptions, watch, options.walk);
    proof.error = walk.find_obstacle();
    if (proof.error) return proof;
    Returns returns;
    proof.groups[group] = returns.run(walk);
    for (const TaskId task : returns.find()) watch.note_return(task);
  }
  proof.facts = watch.facts();
  for (std::size_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    const std::vector<std::uint32_t> groups = groups_of(catalog, goal);
    const bool is_proven = std::all_of(groups.begin(), groups.end(), [&](std::uint32_t group) {
      return proof.groups[group].is_complete;
    });
    const bool is_free = groups.empty() && may_have(assumptions, goal);
    const bool is_met = watch.met()[number] != 0 && !is_forestalled(catalog, goal, proof.facts);
    if (is_met || !is_proven || is_free) continue;
    proof.unreachable[number] = why_unreachable(catalog, goals, number, assumptions, proof.facts);
  }
  return proof;
}

}  // namespace cbc
