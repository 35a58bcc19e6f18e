#include "coverage/engine/goal_monitor.h"

#include <algorithm>

namespace cbc {
namespace {

/// What tells goals of one kind apart, beside pairs and minimums, which are only asked for group by
/// group: the task, the behavior, the place of the requirement, or that of the value.
std::uint32_t subject_of(const CompiledCatalog& catalog, const Goal& goal) {
  switch (goal.kind) {
    case Goal::Kind::requirement_used: {
      std::uint32_t place = catalog.requirements.begin[goal.behavior];
      while (catalog.requirements.items[place].task != goal.task) ++place;
      return place;
    }
    case Goal::Kind::variable_value:
      return catalog.variables[goal.variable].first_value + goal.value;
    case Goal::Kind::timeout_fired:
      // Tasks, then behaviors.
      return goal.behavior == none
                 ? goal.task
                 : static_cast<std::uint32_t>(catalog.tasks.size()) + goal.behavior;
    default:
      return goal.behavior == none ? goal.task : goal.behavior;
  }
}

BehaviorId behavior_in(const CompiledCatalog& catalog, TaskId task, std::uint32_t index) {
  return index == none ? none : catalog.values[task][index].behavior;
}

}  // namespace

GoalFacts::GoalFacts(const CompiledCatalog& catalog, std::size_t goals)
    : performed(catalog.values.items.size(), 0),
      fitted(catalog.behaviors.size(), 0),
      misfitted(catalog.behaviors.size(), 0),
      start_accepted(catalog.tasks.size(), 0),
      start_rejected(catalog.tasks.size(), 0),
      started_itself(catalog.tasks.size(), 0),
      gave_way(catalog.tasks.size(), 0),
      was_asked(goals, 0),
      forestalled_by(catalog.values.items.size(), none) {}

GoalMonitor::GoalMonitor(const CompiledCatalog& catalog, std::span<const Goal> goals,
                         const CoordinatorOptions& options)
    : catalog_(catalog),
      goals_(goals),
      relaxation_(catalog, options),
      is_stopped_(options.is_stopped),
      deciding_(catalog.group_count()),
      facts_(catalog, goals.size()),
      met_(goals.size(), 0),
      has_given_way_(catalog.tasks.size(), 0),
      was_active_(catalog.behaviors.size(), 0) {
  const std::size_t subjects =
      std::max({catalog.tasks.size() + catalog.behaviors.size(), catalog.requirements.items.size(),
                catalog.variable_values.size()});
  for (std::uint32_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    if (is_about_deciding(goal.kind)) {
      deciding_[catalog.tasks[goal.task].group].push_back(number);
      continue;
    }
    auto& places = places_.at(static_cast<std::size_t>(goal.kind));
    if (places.empty()) places.assign(subjects, none);
    places[subject_of(catalog, goal)] = number;
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    const bool is_conditional = !catalog.fitting_values_of(behavior).empty();
    if (is_conditional) conditional_.push_back(behavior);
    facts_.fitted[behavior] = is_conditional ? 0 : 1;
  }
}

void GoalMonitor::begin(const State& state) {
  std::fill(has_given_way_.begin(), has_given_way_.end(), std::uint8_t{0});
  fits_.clear();
  for (const BehaviorId behavior : conditional_) fits_.push_back(state.fits(behavior) ? 1 : 0);
  note_situation(state);
}

/// Does nothing if the catalog has no such goal.
void GoalMonitor::meet(Kind kind, std::uint32_t subject) {
  const auto& places = places_.at(static_cast<std::size_t>(kind));
  if (places.empty() || places[subject] == none) return;
  met_[places[subject]] = 1;
}

void GoalMonitor::on_decision(const EventRecord& record, const Circumstances& circumstances,
                              const Assignment* solution) {
  const Trigger& trigger = circumstances.trigger;
  if (solution != nullptr) {
    note_values(circumstances.state, trigger, *solution);
    if (trigger.kind == Trigger::Kind::start) note_start(record, circumstances, *solution);
    if (trigger.kind == Trigger::Kind::finish) note_finish(record, circumstances.state);
  }
  ask_for_deciding(record, circumstances, solution);
}

void GoalMonitor::note_values(const State& before, const Trigger& trigger,
                              const Assignment& solution) {
  const TaskId first = catalog_.group_tasks[trigger.group];
  for (LocalTask place(0); place < solution.size(); ++place) {
    const BehaviorId behavior = before.behavior(first + place);
    if (behavior != none) was_active_[behavior] = 1;
  }
  for (LocalTask place(0); place < solution.size(); ++place) {
    const TaskId task = first + place;
    const BehaviorId old_behavior = before.behavior(task);
    const BehaviorId behavior = behavior_in(catalog_, task, solution[place]);
    if (behavior != none) {
      facts_.performed[catalog_.values.begin[task] + solution[place]] = 1;
      if (old_behavior == none) meet(Kind::task_ran, task);
      if (was_active_[behavior] == 0) meet(Kind::behavior_active, behavior);
      for (std::uint32_t requirement = catalog_.requirements.begin[behavior];
           requirement < catalog_.requirements.begin[behavior + 1]; ++requirement) {
        meet(Kind::requirement_used, requirement);
      }
    }
    if (old_behavior == none || old_behavior == behavior) continue;
    if (behavior != none) {
      meet(Kind::behavior_replaced, old_behavior);
    } else {
      note_stop(trigger, before, task);
    }
  }
  for (LocalTask place(0); place < solution.size(); ++place) {
    const BehaviorId behavior = before.behavior(first + place);
    if (behavior != none) was_active_[behavior] = 0;
  }
}

/// A reactive task gives way if it joins the queue as it stops (docs/semantics.md, "Reactive
/// tasks").
void GoalMonitor::note_stop(const Trigger& trigger, const State& before, TaskId task) {
  if (catalog_.tasks[task].reactive_start == 0) return;
  const bool is_own_end = has_finished(before, trigger, task)
                              ? trigger.cause != FinishCause::situation_change
                              : task == trigger.task;
  if (is_own_end) return;
  has_given_way_[task] = 1;
  facts_.gave_way[task] = 1;
  meet(Kind::reactive_gave_way, task);
}

void GoalMonitor::note_start(const EventRecord& record, const Circumstances& circumstances,
                             const Assignment& solution) {
  const Trigger& trigger = circumstances.trigger;
  if (trigger.is_reactive) {
    facts_.started_itself[trigger.task] = 1;
    meet(Kind::reactive_started, trigger.task);
    if (has_given_way_[trigger.task] != 0) meet(Kind::reactive_returned, trigger.task);
    return;
  }
  const TaskId first = catalog_.group_tasks[trigger.group];
  for (LocalTask place(0); place < solution.size(); ++place) {
    const Request* const request = circumstances.state.find_request(first + place);
    if (request == nullptr || solution[place] != none) continue;
    meet(request->priority < record.priority ? Kind::higher_displaced : Kind::equal_displaced,
         trigger.task);
  }
}

void GoalMonitor::note_finish(const EventRecord& record, const State& before) {
  if (record.cause == FinishCause::situation_change) return;
  const bool is_failure = record.cause != FinishCause::goal_achieved;
  meet(is_failure ? Kind::behavior_failed : Kind::behavior_succeeded, record.behavior);
  if (record.origin == Origin::timeout || (is_failure && takes_failures_for_timeouts_)) {
    note_timeout(record, before);
  }
}

void GoalMonitor::note_timeout(const EventRecord& record, const State& before) {
  const BehaviorId behavior = record.behavior;
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const Microseconds timeout = timeout_of(catalog_, task, behavior);
    if (before.behavior(task) != behavior || timeout == 0) continue;
    const Microseconds since = std::max(before.activated_at(behavior), before.taken_at(task));
    if (!takes_failures_for_timeouts_ && since + timeout != record.time) continue;
    const bool is_own = catalog_.behaviors[behavior].timeout > 0;
    meet(Kind::timeout_fired,
         is_own ? static_cast<std::uint32_t>(catalog_.tasks.size()) + behavior : task);
  }
}

/// Only of what no earlier event has decided.
void GoalMonitor::ask_for_deciding(const EventRecord& record, const Circumstances& circumstances,
                                   const Assignment* solution) {
  const auto& rejectable = places_.at(static_cast<std::size_t>(Kind::lower_rejected));
  const auto& deciding = deciding_[circumstances.trigger.group];
  if (rejectable.empty() && deciding.empty()) return;
  if (!relaxation_.load(record, circumstances, solution)) return;
  constexpr std::size_t most_known = 1'000'000;
  if (decided_.size() == most_known) decided_.clear();
  const auto [known, is_new] = decided_.try_emplace(relaxation_.digest());
  if (is_new) {
    const std::vector<std::uint8_t>& unasked = apart_.empty() ? met_ : apart_;
    for (const std::uint32_t number : deciding) {
      if (unasked[number] != 0 || !relaxation_.may_matter(goals_[number])) continue;
      if (is_stopped_ && is_stopped_()) break;
      facts_.was_asked[number] = 1;
      if (relaxation_.decided(goals_[number], number)) known->second.push_back(number);
    }
  }
  for (const std::uint32_t number : known->second) met_[number] = 1;
  if (solution != nullptr || record.origin != Origin::script) return;
  if (rejectable.empty() || record.verb != Verb::start) return;
  const std::uint32_t number = rejectable[record.task];
  if (number == none || met_[number] != 0) return;
  if (relaxation_.was_protection_alone()) met_[number] = 1;
}

void GoalMonitor::note_event(const EventRecord& record, const State& state) {
  for (const Change& change : record.changes) {
    if (change.is_activation && !change.success) meet(Kind::behavior_failed, change.behavior);
  }
  if (record.verb == Verb::situation) note_situation(state);
  if (record.verb == Verb::start && record.origin == Origin::script) {
    if (record.outcome == Outcome::accepted) facts_.start_accepted[record.task] = 1;
    if (record.outcome == Outcome::rejected) facts_.start_rejected[record.task] = 1;
  }
}

void GoalMonitor::note_situation(const State& state) {
  for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
    meet(Kind::variable_value, catalog_.variables[variable].first_value + state.value_of(variable));
  }
  for (std::size_t place = 0; place < conditional_.size(); ++place) {
    const BehaviorId behavior = conditional_[place];
    const bool fits = state.fits(behavior);
    (fits ? facts_.fitted : facts_.misfitted)[behavior] = 1;
    if (fits && fits_[place] == 0) meet(Kind::behavior_began_to_fit, behavior);
    // What follows it is not decided yet.
    if (!fits && fits_[place] != 0 && state.is_active(behavior)) {
      meet(Kind::behavior_ceased_to_fit, behavior);
    }
    fits_[place] = fits ? 1 : 0;
  }
}

MonitoredResult run_monitored(const CompiledCatalog& catalog, std::span<const Goal> goals,
                              const Script& script, const CoordinatorOptions& options) {
  GoalMonitor monitor(catalog, goals, options);
  State first(catalog);
  first.change_situation(script.situation.availability, script.situation.variables);
  monitor.begin(first);
  RunResult result = run_script(catalog, script, options, monitor);
  return {std::move(result), monitor.met()};
}

}  // namespace cbc
