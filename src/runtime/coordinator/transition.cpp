#include "runtime/coordinator/transition.h"

#include <algorithm>

namespace cbc {

Transition::Transition(const CompiledCatalog& catalog, State& state, EventRecord& record)
    : catalog_(catalog), state_(state), record_(record) {}

void Transition::load(const Trigger& trigger, const std::vector<BehaviorId>& active_before) {
  trigger_ = trigger;
  first_task_ = catalog_.group_tasks[trigger.group];
  first_behavior_ = catalog_.group_behaviors[trigger.group];
  end_behavior_ = catalog_.group_behaviors[trigger.group + 1];
  was_active_.assign(end_behavior_ - first_behavior_, 0);
  activations_.assign(end_behavior_ - first_behavior_, none);
  for (const BehaviorId behavior : active_before) was_active_[behavior - first_behavior_] = 1;
}

std::optional<BehaviorId> Transition::apply(const Assignment& solution, BehaviorId restart,
                                            Microseconds now) {
  find_wanted(solution);
  plan();
  for (const BehaviorId behavior : to_deactivate_) deactivate(behavior, &solution, false);
  for (const BehaviorId behavior : to_activate_) {
    if (behavior != restart && !activate(behavior, &solution, false, now)) return behavior;
  }
  if (restart != none) {
    if (state_.is_active(restart)) deactivate(restart, &solution, true);
    if (!activate(restart, &solution, true, now)) return restart;
  }
  return std::nullopt;
}

const std::vector<BehaviorId>& Transition::roll_back(Microseconds now) {
  wanted_ = was_active_;
  plan();
  lost_.clear();
  for (const BehaviorId behavior : to_deactivate_) deactivate(behavior, nullptr, false);
  for (const BehaviorId behavior : to_activate_) {
    if (!activate(behavior, nullptr, false, now)) lost_.push_back(behavior);
  }
  for (const BehaviorId behavior : lost_) state_.leave_active(behavior);
  std::sort(lost_.begin(), lost_.end());
  return lost_;
}

std::uint32_t Transition::count_changes() const {
  std::uint32_t changes = 0;
  for (std::size_t index = 0; index < wanted_.size(); ++index) {
    if (wanted_[index] != was_active_[index]) ++changes;
  }
  return changes;
}

void Transition::find_wanted(const Assignment& solution) {
  wanted_.assign(end_behavior_ - first_behavior_, 0);
  for (LocalTask task(0); task < solution.size(); ++task) {
    const BehaviorId behavior = behavior_in(solution, first_task_ + task);
    if (behavior != none) wanted_[behavior - first_behavior_] = 1;
  }
}

/// Orders deactivations from the highest level down, so that a behavior stops before what it
/// requires, and activations from the lowest level up; behaviors of one level in catalog order.
void Transition::plan() {
  to_deactivate_.clear();
  to_activate_.clear();
  for (BehaviorId behavior = first_behavior_; behavior < end_behavior_; ++behavior) {
    if (is_wanted(behavior) == state_.is_active(behavior)) continue;
    (is_wanted(behavior) ? to_activate_ : to_deactivate_).push_back(behavior);
  }
  const auto level = [this](BehaviorId behavior) { return catalog_.behaviors[behavior].level; };
  std::sort(to_deactivate_.begin(), to_deactivate_.end(), [&](BehaviorId a, BehaviorId b) {
    return level(a) != level(b) ? level(a) > level(b) : a < b;
  });
  std::sort(to_activate_.begin(), to_activate_.end(), [&](BehaviorId a, BehaviorId b) {
    return level(a) != level(b) ? level(a) < level(b) : a < b;
  });
}

void Transition::deactivate(BehaviorId behavior, const Assignment* solution, bool is_restart) {
  Change& change = add_change(false, behavior);
  find_tasks_of_deactivation(change);
  if (is_restart) {
    change.cause = ChangeCause::restarted;
  } else if (!was_active(behavior)) {
    change.cause = ChangeCause::undone;
  } else {
    explain_deactivation(change, *solution);
  }
  if (change.cause != ChangeCause::undone) {
    for (const TaskId task : record_.tasks_of(change)) {
      change.priority = std::max(change.priority, priority_before(task));
    }
  }
  state_.set_inactive(behavior);
}

bool Transition::activate(BehaviorId behavior, const Assignment* solution, bool is_restart,
                          Microseconds now) {
  Change& change = add_change(true, behavior);
  find_tasks_of_activation(change, solution);
  if (is_restart) {
    change.cause = ChangeCause::restarted;
  } else if (was_active(behavior)) {
    change.cause = ChangeCause::undone;
  } else {
    explain_activation(change);
  }
  if (change.cause != ChangeCause::undone) {
    for (const TaskId task : record_.tasks_of(change)) {
      change.priority = std::max(change.priority, priority_after(task));
    }
  }
  change.success = !state_.is_faulty(behavior);
  if (change.success) {
    state_.set_active(behavior, now);
    activations_[behavior - first_behavior_] =
        static_cast<std::uint32_t>(record_.changes.size() - 1);
  }
  return change.success;
}

Change& Transition::add_change(bool is_activation, BehaviorId behavior) {
  Change& change = record_.changes.emplace_back();
  change.is_activation = is_activation;
  change.behavior = behavior;
  change.first_task = static_cast<std::uint32_t>(record_.tasks_of_changes.size());
  return change;
}

/// Adds a task to a change, which must be the last one: its tasks end the list.
void Transition::add_task(Change& change, TaskId task) {
  record_.tasks_of_changes.push_back(task);
  ++change.task_count;
}

BehaviorId Transition::behavior_in(const Assignment& solution, TaskId task) const {
  const std::uint32_t index = solution[task - first_task_];
  return index == none ? none : catalog_.values[task][index].behavior;
}

/// Finds the tasks that the behavior performs in the solution or, in a rollback, before the event.
void Transition::find_tasks_of_activation(Change& change, const Assignment* solution) {
  for (const ValueId value : catalog_.performs[change.behavior]) {
    const TaskId task = catalog_.task_of(value);
    const BehaviorId behavior =
        solution != nullptr ? behavior_in(*solution, task) : state_.behavior(task);
    if (behavior == change.behavior) add_task(change, task);
  }
}

/// Finds the tasks of its last activation within the event, or else those that it performed before.
void Transition::find_tasks_of_deactivation(Change& change) {
  if (const std::uint32_t place = activations_[change.behavior - first_behavior_]; place != none) {
    const Change& activation = record_.changes[place];
    change.first_task = activation.first_task;
    change.task_count = activation.task_count;
    return;
  }
  for (const ValueId value : catalog_.performs[change.behavior]) {
    const TaskId task = catalog_.task_of(value);
    if (state_.behavior(task) == change.behavior) add_task(change, task);
  }
}

void Transition::explain_activation(Change& change) const {
  change.cause = ChangeCause::required;
  for (const TaskId task : record_.tasks_of(change)) {
    const std::optional<std::int32_t> priority = priority_after(task);
    if (!priority) continue;
    const bool is_started = trigger_.kind == Trigger::Kind::start && task == trigger_.task;
    ChangeCause cause = *priority >= 1 ? ChangeCause::requested : ChangeCause::reactive;
    if (is_started && trigger_.is_reactive) cause = ChangeCause::reactive;
    if (!is_started && state_.is_suspended(task)) cause = ChangeCause::resumed;
    change.cause = std::min(change.cause, cause);
  }
}

void Transition::explain_deactivation(Change& change, const Assignment& solution) const {
  change.cause = ChangeCause::released;
  for (const TaskId task : record_.tasks_of(change)) {
    const bool is_stopped = trigger_.kind == Trigger::Kind::stop && task == trigger_.task;
    if (is_stopped) {
      change.cause = ChangeCause::requested;
    } else if (behavior_in(solution, task) != none) {
      change.cause = std::min(change.cause, ChangeCause::replaced);
    } else if (priority_before(task)) {
      change.cause = std::min(change.cause, ChangeCause::displaced);
    }
  }
}

std::optional<std::int32_t> Transition::priority_before(TaskId task) const {
  const Request* const request = state_.find_request(task);
  return request != nullptr ? std::optional(request->priority) : std::nullopt;
}

/// The priority of a task that runs in the solution, after the event.
std::optional<std::int32_t> Transition::priority_after(TaskId task) const {
  if (trigger_.kind == Trigger::Kind::start && task == trigger_.task) return trigger_.priority;
  const Request* const request = state_.find_own_request(task);
  return request != nullptr ? std::optional(request->priority) : std::nullopt;
}

}  // namespace cbc
