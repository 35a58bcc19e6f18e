#include "coverage/engine/goal_notes.h"

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

}  // namespace

GoalFacts::GoalFacts(const CompiledCatalog& catalog, std::size_t goals)
    : performed(catalog.values.items.size(), 0),
      misfitted(catalog.behaviors.size(), 0),
      start_accepted(catalog.tasks.size(), 0),
      start_rejected(catalog.tasks.size(), 0),
      started_itself(catalog.tasks.size(), 0),
      gave_way(catalog.tasks.size(), 0),
      was_asked(goals, 0),
      forestalled_by(catalog.values.items.size(), none) {
  for (BehaviorId behavior(0); behavior < catalog.behaviors.size(); ++behavior) {
    fitted.push_back(catalog.fitting_values_of(behavior).empty() ? 1 : 0);
  }
}

void GoalFacts::add(const GoalFacts& other) {
  for (const auto list :
       {&GoalFacts::performed, &GoalFacts::fitted, &GoalFacts::misfitted,
        &GoalFacts::start_accepted, &GoalFacts::start_rejected, &GoalFacts::started_itself,
        &GoalFacts::gave_way, &GoalFacts::was_asked}) {
    for (std::size_t place = 0; place < (this->*list).size(); ++place) {
      (this->*list)[place] |= (other.*list)[place];
    }
  }
}

GoalNotes::GoalNotes(const CompiledCatalog& catalog, std::span<const Goal> goals)
    : catalog_(catalog),
      facts_(catalog, goals.size()),
      met_(goals.size(), 0),
      has_given_way_(catalog.tasks.size(), 0),
      was_active_(catalog.behaviors.size(), 0) {
  const std::size_t subjects =
      std::max({catalog.tasks.size() + catalog.behaviors.size(), catalog.requirements.items.size(),
                catalog.variable_values.size()});
  for (std::uint32_t number = 0; number < goals.size(); ++number) {
    const Goal& goal = goals[number];
    if (is_about_deciding(goal.kind)) continue;
    auto& places = places_.at(static_cast<std::size_t>(goal.kind));
    if (places.empty()) places.assign(subjects, none);
    places[subject_of(catalog, goal)] = number;
  }
}

void GoalNotes::begin() {
  std::fill(has_given_way_.begin(), has_given_way_.end(), std::uint8_t{0});
}

std::uint32_t GoalNotes::find(Kind kind, std::uint32_t subject) const {
  const auto& places = places_.at(static_cast<std::size_t>(kind));
  return places.empty() ? none : places[subject];
}

void GoalNotes::meet(Kind kind, std::uint32_t subject) {
  if (const std::uint32_t goal = find(kind, subject); goal != none) meet(goal);
}

void GoalNotes::meet(std::uint32_t goal) {
  if (std::exchange(met_[goal], std::uint8_t{1}) == 0) found_.push_back(goal);
}

void GoalNotes::forget() {
  for (const std::uint32_t goal : found_) met_[goal] = 0;
  found_.clear();
}

void GoalNotes::note(const DecidedEvent& event) {
  note_values(event);
  const Trigger& trigger = event.trigger;
  if (trigger.kind == Trigger::Kind::start) note_start(event);
  if (trigger.kind != Trigger::Kind::finish || trigger.cause == FinishCause::situation_change) {
    return;
  }
  if (trigger.cause == FinishCause::goal_achieved) {
    meet(Kind::behavior_succeeded, trigger.behavior);
  } else {
    note_failure(trigger.behavior);
  }
}

void GoalNotes::note_failure(BehaviorId behavior) {
  meet(Kind::behavior_failed, behavior);
  if (catalog_.retry_of(behavior) != Retry::at_events) meet(Kind::failure_remembered, behavior);
}

/// Whether the request of a task begins to wait, or waits no more.
void GoalNotes::note_request(const DecidedEvent& event, LocalTask place) {
  const Trigger& trigger = event.trigger;
  const TaskId task = catalog_.group_tasks[trigger.group] + place;
  if (catalog_.rules_of(task).resume == 0 || !event.requests[place]) return;
  const bool was_running = event.behaviors[place] != none;
  const bool runs = event.solution[place] != none;
  if (!was_running && runs && task != trigger.task) meet(Kind::request_resumed, task);
  if (!was_running || runs || trigger.kind == Trigger::Kind::stop) return;
  const bool has_finished =
      trigger.kind == Trigger::Kind::finish && event.behaviors[place] == trigger.behavior;
  if (!has_finished || trigger.cause == FinishCause::situation_change) {
    meet(Kind::request_suspended, task);
  }
}

void GoalNotes::note_improvement(const DecidedEvent& event, LocalTask place) {
  const TaskId task = catalog_.group_tasks[event.trigger.group] + place;
  const std::uint32_t index = event.solution[place];
  if (event.trigger.kind != Trigger::Kind::reconsider || index == none ||
      catalog_.rules_of(task).improve != Improve::at_once) {
    return;
  }
  const auto values = catalog_.values[task];
  const auto present = std::find_if(values.begin(), values.end(), [&](const Value& value) {
    return value.behavior == event.behaviors[place];
  });
  if (present != values.end() && values[index].suitability > present->suitability) {
    meet(Kind::improved_at_once, task);
  }
}

void GoalNotes::note_values(const DecidedEvent& event) {
  const TaskId first = catalog_.group_tasks[event.trigger.group];
  for (const BehaviorId behavior : event.behaviors) {
    if (behavior != none) was_active_[behavior] = 1;
  }
  for (LocalTask place(0); place < event.solution.size(); ++place) {
    const TaskId task = first + place;
    const BehaviorId old_behavior = event.behaviors[place];
    const std::uint32_t index = event.solution[place];
    note_request(event, place);
    note_improvement(event, place);
    const BehaviorId behavior =
        index == none ? BehaviorId(none) : catalog_.values[task][index].behavior;
    if (behavior != none) {
      facts_.performed[catalog_.values.begin[task] + index] = 1;
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
      note_stop(event, task);
    }
  }
  for (const BehaviorId behavior : event.behaviors) {
    if (behavior != none) was_active_[behavior] = 0;
  }
}

/// A reactive task gives way if it joins the queue as it stops (docs/semantics.md, "Reactive
/// tasks").
void GoalNotes::note_stop(const DecidedEvent& event, TaskId task) {
  if (catalog_.tasks[task].reactive_start == 0) return;
  const Trigger& trigger = event.trigger;
  const TaskId first = catalog_.group_tasks[trigger.group];
  const bool has_finished =
      trigger.kind == Trigger::Kind::finish && event.behaviors[task - first] == trigger.behavior;
  const bool is_own_end =
      has_finished ? trigger.cause != FinishCause::situation_change : task == trigger.task;
  if (is_own_end) return;
  has_given_way_[task] = 1;
  facts_.gave_way[task] = 1;
  meet(Kind::reactive_gave_way, task);
}

void GoalNotes::note_start(const DecidedEvent& event) {
  const Trigger& trigger = event.trigger;
  if (trigger.is_reactive) {
    facts_.started_itself[trigger.task] = 1;
    meet(Kind::reactive_started, trigger.task);
    if (has_given_way_[trigger.task] != 0) meet(Kind::reactive_returned, trigger.task);
    return;
  }
  for (LocalTask place(0); place < event.solution.size(); ++place) {
    const std::optional<std::int32_t> request = event.requests[place];
    if (!request || event.behaviors[place] == none || event.solution[place] != none) continue;
    meet(*request < trigger.priority ? Kind::higher_displaced : Kind::equal_displaced,
         trigger.task);
  }
}

void GoalNotes::note_timeout(ValueId value) {
  const BehaviorId behavior = catalog_.values.items[value].behavior;
  const bool is_own = catalog_.behaviors[behavior].timeout > 0;
  meet(Kind::timeout_fired, is_own ? static_cast<std::uint32_t>(catalog_.tasks.size()) + behavior
                                   : static_cast<std::uint32_t>(catalog_.task_of(value)));
}

}  // namespace cbc
