#include "coverage/engine/goal_monitor.h"

#include <algorithm>

namespace cbc {

GoalMonitor::GoalMonitor(const CompiledCatalog& catalog, std::span<const Goal> goals,
                         const CoordinatorOptions& options)
    : catalog_(catalog),
      goals_(goals),
      relaxation_(catalog, options),
      is_stopped_(options.is_stopped),
      deciding_(catalog.group_count()),
      notes_(catalog, goals) {
  for (std::uint32_t number = 0; number < goals.size(); ++number) {
    if (!is_about_deciding(goals[number].kind)) continue;
    deciding_[catalog.tasks[goals[number].task].group].push_back(number);
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (!catalog.fitting_values_of(behavior).empty()) conditional_.push_back(behavior);
  }
}

void GoalMonitor::begin(const State& state) {
  notes_.begin();
  fits_.clear();
  for (const BehaviorId behavior : conditional_) fits_.push_back(state.fits(behavior) ? 1 : 0);
  note_situation(state);
}

void GoalMonitor::on_decision(const EventRecord& record, const Circumstances& circumstances,
                              const Assignment* solution) {
  if (solution != nullptr) {
    note_answer(circumstances, *solution);
    if (record.origin == Origin::timeout) note_timeouts(record, circumstances.state);
  }
  ask_for_deciding(record, circumstances, solution);
}

void GoalMonitor::note_answer(const Circumstances& circumstances, const Assignment& solution) {
  const GroupId group = circumstances.trigger.group;
  behaviors_.clear();
  requests_.clear();
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    const Request* const request = circumstances.state.find_own_request(task);
    behaviors_.push_back(circumstances.state.behavior(task));
    requests_.push_back(request != nullptr ? std::optional(request->priority) : std::nullopt);
  }
  notes_.note({circumstances.trigger, behaviors_, requests_, solution});
}

void GoalMonitor::note_timeouts(const EventRecord& record, const State& before) {
  const BehaviorId behavior = record.behavior;
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const Microseconds timeout = timeout_of(catalog_, task, behavior);
    if (before.behavior(task) != behavior || timeout == 0) continue;
    const Microseconds since = std::max(before.activated_at(behavior), before.taken_at(task));
    if (since + timeout == record.time) notes_.note_timeout(value);
  }
}

void GoalMonitor::ask_for_deciding(const EventRecord& record, const Circumstances& circumstances,
                                   const Assignment* solution) {
  const auto& deciding = deciding_[circumstances.trigger.group];
  const bool is_rejected_start =
      solution == nullptr && record.origin == Origin::script && record.verb == Verb::start;
  const std::uint32_t rejected =
      is_rejected_start ? notes_.find(Kind::lower_rejected, record.task) : none;
  if (rejected == none && deciding.empty()) return;
  if (!relaxation_.load(record, circumstances, solution)) return;
  for (const std::uint32_t number : deciding) {
    if (met()[number] != 0 || !relaxation_.may_matter(goals_[number])) continue;
    if (is_stopped_ && is_stopped_()) break;
    notes_.facts().was_asked[number] = 1;
    if (relaxation_.decided(goals_[number], number)) notes_.meet(number);
  }
  if (rejected == none || met()[rejected] != 0) return;
  if (relaxation_.was_protection_alone()) notes_.meet(rejected);
}

void GoalMonitor::note_event(const EventRecord& record, const State& state) {
  for (const Change& change : record.changes) {
    if (change.is_activation && !change.success) notes_.note_failure(change.behavior);
  }
  if (record.verb == Verb::situation) note_situation(state);
  if (record.verb == Verb::start && record.origin == Origin::script) {
    if (record.outcome == Outcome::accepted) notes_.facts().start_accepted[record.task] = 1;
    if (record.outcome == Outcome::rejected) notes_.facts().start_rejected[record.task] = 1;
  }
}

void GoalMonitor::note_situation(const State& state) {
  for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
    notes_.meet(Kind::variable_value,
                catalog_.variables[variable].first_value + state.value_of(variable));
  }
  for (std::size_t place = 0; place < conditional_.size(); ++place) {
    const BehaviorId behavior = conditional_[place];
    const bool fits = state.fits(behavior);
    (fits ? notes_.facts().fitted : notes_.facts().misfitted)[behavior] = 1;
    if (fits && fits_[place] == 0) notes_.meet(Kind::behavior_began_to_fit, behavior);
    // What follows it is not decided yet.
    if (!fits && fits_[place] != 0 && state.is_active(behavior)) {
      notes_.meet(Kind::behavior_ceased_to_fit, behavior);
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
