#include "why/conflict.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

#include "ask/ask.h"

namespace cbc {
namespace {

/// Why a behavior is not available: a script denied it, it does not fit, or it has failed and is
/// not tried again. `fit_first`: what to say if the first two hold.
Reason unavailability(const CompiledCatalog& catalog, const State& state, BehaviorId behavior,
                      bool fit_first) {
  Reason reason;
  reason.behavior = behavior;
  const bool is_denied = state.is_denied(behavior) && (state.fits(behavior) || !fit_first);
  if (is_denied) {
    reason.kind = Reason::Kind::unavailable;
  } else if (state.fits(behavior)) {
    reason.kind = Reason::Kind::not_retried;
    reason.time = state.failed_at(behavior);
    reason.line = catalog.retry_lines[behavior];
  } else {
    reason.kind = Reason::Kind::situation;
    reason.variable = *catalog.find_misfit(behavior, state.variables());
    reason.value = state.value_of(reason.variable);
  }
  return reason;
}

/// Collects all reasons that may speak against the event.
class Candidates {
 public:
  Candidates(const CompiledCatalog& catalog, const Circumstances& circumstances)
      : catalog_(catalog),
        state_(circumstances.state),
        trigger_(circumstances.trigger),
        protection_(circumstances.protection),
        failed_(circumstances.failed),
        relevant_(catalog, trigger_.group) {}

  std::vector<Reason> collect(std::span<const Demands> ways) {
    find_relevant_tasks(ways);
    for (const TaskId task : relevant_.tasks()) {
      add_exclusions(catalog_, task, relevant_, most_constraints + 1, reasons_);
      add_state(task);
      add_minimum(catalog_, task, reasons_);
    }
    for (const BehaviorId behavior : relevant_.behaviors()) {
      add_condition(behavior);
      add_requirements(catalog_, behavior, reasons_);
    }
    return std::move(reasons_);
  }

  /// Faults that are known, but no reasons: the event has not tried these behaviors. To be called
  /// after collect().
  [[nodiscard]] std::vector<Reason> untried_faults() const {
    std::vector<Reason> faults;
    for (const BehaviorId behavior : relevant_.behaviors()) {
      if (!state_.is_faulty(behavior) || has_failed(behavior) || was_active(behavior)) continue;
      Reason& fault = faults.emplace_back();
      fault.kind = Reason::Kind::faulty;
      fault.behavior = behavior;
    }
    return faults;
  }

 private:
  [[nodiscard]] bool has_failed(BehaviorId behavior) const {
    return std::find(failed_.begin(), failed_.end(), behavior) != failed_.end();
  }

  [[nodiscard]] bool is_protected(TaskId task) const {
    return task != trigger_.task && !has_finished(state_, trigger_, task) &&
           cbc::is_protected(state_, trigger_, task, protection_);
  }

  void find_relevant_tasks(std::span<const Demands> ways) {
    for (const Demands& demands : ways) {
      for (const Demand& demand : demands) relevant_.add(demand.task);
    }
    for (TaskId task = catalog_.group_tasks[trigger_.group];
         task < catalog_.group_tasks[trigger_.group + 1]; ++task) {
      if (task == trigger_.task || is_protected(task)) relevant_.add(task);
    }
    relevant_.close();
  }

  void add_state(TaskId task) {
    Reason reason;
    reason.task = task;
    if (may_not_improve(task)) {
      reason.kind = Reason::Kind::not_improved;
      reason.behavior = state_.behavior(task);
      reason.line = catalog_.improve_lines[task];
      reasons_.push_back(reason);
      reason = {};
      reason.task = task;
    }
    if (task == trigger_.task) return;
    if (is_protected(task)) {
      reason.kind = Reason::Kind::is_protected;
      reason.priority = state_.request(task).priority;
      reason.is_from_any_request = trigger_.is_unasked();
      reasons_.push_back(reason);
    } else if (!state_.is_running(task) && catalog_.tasks[task].start_on_request &&
               (!state_.is_suspended(task) || trigger_.is_unasked())) {
      reason.kind = Reason::Kind::on_request;
      reasons_.push_back(reason);
    }
  }

  /// Whether the task keeps its behavior, or gets a worse one.
  [[nodiscard]] bool may_not_improve(TaskId task) const {
    const bool is_started =
        trigger_.kind == Trigger::Kind::start && !trigger_.is_reactive && task == trigger_.task;
    if (is_started || !state_.is_running(task) ||
        catalog_.rules_of(task).improve != Improve::when_started) {
      return false;
    }
    const auto values = catalog_.values[task];
    return values.front().suitability > values[state_.value_index(task)].suitability;
  }

  /// Whether the behavior was active before the event, apart from one that has finished. Read off
  /// the tasks: the event may have changed what is active, but not yet the values of tasks.
  [[nodiscard]] bool was_active(BehaviorId behavior) const {
    const auto values = catalog_.performs[behavior];
    return std::any_of(values.begin(), values.end(), [&](ValueId value) {
      const TaskId task = catalog_.task_of(value);
      return state_.behavior(task) == behavior && !has_finished(state_, trigger_, task);
    });
  }

  void add_condition(BehaviorId behavior) {
    Reason reason;
    reason.behavior = behavior;
    if (has_failed(behavior)) {
      // The behavior of a finish event is in this list from the start if it finished by a failure;
      // otherwise it was chosen again, for another task, and its activation failed.
      const bool ended_by_failure = trigger_.cause != FinishCause::goal_achieved &&
                                    trigger_.cause != FinishCause::situation_change;
      reason.kind = behavior == trigger_.behavior && ended_by_failure ? Reason::Kind::finished
                                                                      : Reason::Kind::faulty;
      reasons_.push_back(reason);
    } else if (!state_.is_available(behavior)) {
      // An active behavior that does not fit may not be kept, unlike one that is unavailable.
      reasons_.push_back(unavailability(catalog_, state_, behavior, was_active(behavior)));
    }
  }

  const CompiledCatalog& catalog_;
  const State& state_;
  const Trigger& trigger_;
  const std::int32_t protection_;
  const std::span<const BehaviorId> failed_;
  RelevantTasks relevant_;
  std::vector<Reason> reasons_;
};

/// Whether a reason says which behaviors can perform what, and with what else.
bool is_about_behaviors(const Reason& reason) {
  switch (reason.kind) {
    case Reason::Kind::on_request:
    case Reason::Kind::requires_task:
    case Reason::Kind::unavailable:
    case Reason::Kind::situation:
    case Reason::Kind::faulty:
    case Reason::Kind::not_retried:
    case Reason::Kind::not_improved:
    case Reason::Kind::finished:
      return true;
    default:
      return false;
  }
}

/// What holds beside a minimum performance of a conflict set: the rest of the set, and of the other
/// candidates those that count, but for other minimums of the task.
template <typename Counts>
std::vector<Reason> reasons_beside(const Reason& minimum, std::span<const Reason> conflict_set,
                                   std::span<const Reason> candidates, Counts counts) {
  std::vector<Reason> reasons;
  for (const Reason& reason : conflict_set) {
    if (reason != minimum) reasons.push_back(reason);
  }
  for (const Reason& reason : candidates) {
    const bool is_of_task = reason.kind == Reason::Kind::performance && reason.task == minimum.task;
    const bool is_known =
        std::find(conflict_set.begin(), conflict_set.end(), reason) != conflict_set.end();
    if (!is_of_task && !is_known && counts(reason)) reasons.push_back(reason);
  }
  return reasons;
}

/// The performance of a task with these values, to a millionth below.
Millionths performance_of(const CompiledCatalog& catalog, std::span<const ValueId> values) {
  double performance = one_million;
  for (const ValueId value : values) {
    performance *= static_cast<double>(catalog.values.items[value].suitability) / one_million;
  }
  return static_cast<Millionths>(performance);
}

/// The values with which the task does best where these reasons hold. Empty if they leave no
/// solution; nothing where that takes too long.
std::optional<std::vector<ValueId>> find_best(const CompiledCatalog& catalog,
                                              RelaxedQuestions& questions, TaskId task,
                                              std::vector<Reason> reasons) {
  const std::size_t place = reasons.size();
  reasons.emplace_back();
  reasons[place].kind = Reason::Kind::performance;
  reasons[place].task = task;
  std::vector<ValueId> best;
  for (;;) {
    const Feasibility answer = questions.solve(reasons);
    if (answer == Feasibility::unknown) return std::nullopt;
    if (answer == Feasibility::no) return best;
    best = questions.values_of(task);
    if (best.empty()) return best;
    Millionths& minimum = reasons[place].minimum_performance;
    minimum = std::max(minimum, performance_of(catalog, best)) + 1;
    if (minimum > one_million) return best;
  }
}

/// Tells of each minimum performance of a conflict set how near to it one can come: where all else
/// holds, also the faults that are known but were not tried, or, if something else leaves no
/// solution either, with the behaviors that can be chosen.
void add_best(const CompiledCatalog& catalog, RelaxedQuestions& questions,
              std::span<const Reason> candidates, std::vector<Reason>& conflict_set) {
  const std::vector<Reason> plain = conflict_set;
  for (Reason& reason : conflict_set) {
    if (reason.kind != Reason::Kind::performance) continue;
    const auto find = [&](auto counts) {
      return find_best(catalog, questions, reason.task,
                       reasons_beside(reason, plain, candidates, counts));
    };
    auto best = find([](const Reason&) { return true; });
    if (best && best->empty()) best = find(is_about_behaviors);
    if (best) reason.best = std::move(*best);
  }
}

/// The demands of the event alone.
Demands demands_of(const CompiledCatalog& catalog, const State& state, const Trigger& trigger) {
  switch (trigger.kind) {
    case Trigger::Kind::start:
      return {{Demand::Kind::run, trigger.task, none}};
    case Trigger::Kind::stop:
      return {{Demand::Kind::stop, trigger.task, none}};
    case Trigger::Kind::reconsider:
      return {};
    case Trigger::Kind::finish:
      break;
  }
  Demands demands;
  if (trigger.cause != FinishCause::goal_achieved) return demands;
  for (const ValueId value : catalog.performs[trigger.behavior]) {
    const TaskId task = catalog.task_of(value);
    if (has_finished(state, trigger, task)) demands.push_back({Demand::Kind::stop, task, none});
  }
  return demands;
}

/// By task of the group: the value index that it may keep although its behavior is unavailable,
/// which is the present one unless that behavior has just finished.
std::vector<std::uint32_t> present_values(const CompiledCatalog& catalog,
                                          const Circumstances& circumstances) {
  const Trigger& trigger = circumstances.trigger;
  std::vector<std::uint32_t> present;
  for (TaskId task = catalog.group_tasks[trigger.group];
       task < catalog.group_tasks[trigger.group + 1]; ++task) {
    const bool is_kept = !has_finished(circumstances.state, trigger, task);
    present.push_back(is_kept ? circumstances.state.value_index(task) : none);
  }
  return present;
}

/// The values of all variables.
SituationPart situation_of(const State& state) {
  SituationPart situation;
  for (std::uint32_t variable = 0; variable < state.variables().size(); ++variable) {
    situation.variables.push_back({variable, state.value_of(variable)});
  }
  return situation;
}

/// For one answer: a measure of time that does not depend on the machine (some tenths of a second),
/// and the deadline, if there is one.
Effort effort_of(const Circumstances& circumstances) {
  if (!circumstances.deadline) return Effort(most_effort_of_answer);
  return Effort(most_effort_of_answer, [deadline = *circumstances.deadline] {
    return std::chrono::steady_clock::now() >= deadline;
  });
}

/// A minimal conflict set of the event together with all of the `ways`. Empty if the event alone
/// leaves no solution; nothing where that takes too long.
std::optional<std::vector<Reason>> find_reasons(const CompiledCatalog& catalog,
                                                const Circumstances& circumstances,
                                                std::span<const Demands> ways) {
  const Trigger& trigger = circumstances.trigger;
  Candidates collector(catalog, circumstances);
  std::vector<Reason> candidates = collector.collect(ways);
  const SituationSpace space(catalog, situation_of(circumstances.state), {});
  Effort effort = effort_of(circumstances);
  RelaxedQuestions questions(space, effort, present_values(catalog, circumstances));
  for (const Demands& way : ways) {
    Demands demands = demands_of(catalog, circumstances.state, trigger);
    demands.insert(demands.end(), way.begin(), way.end());
    Asked question(1);  // a list would be copied
    question.front() = {trigger.group, std::move(demands)};
    questions.add(std::move(question));
  }
  if (questions.solve({}) == Feasibility::no) return std::vector<Reason>();
  std::vector<Reason> reasons = questions.conflict(candidates);
  if (reasons.empty()) return std::nullopt;
  const std::vector<Reason> faults = collector.untried_faults();
  candidates.insert(candidates.end(), faults.begin(), faults.end());
  add_best(catalog, questions, candidates, reasons);
  return reasons;
}

/// Whether the event itself says that tasks do not run.
bool stops_tasks(const Trigger& trigger) {
  return trigger.kind == Trigger::Kind::stop ||
         (trigger.kind == Trigger::Kind::finish && trigger.cause == FinishCause::goal_achieved);
}

/// Whether the reasons rule out all of the `ways` only because the event stops its tasks.
bool needs_event(const CompiledCatalog& catalog, const Circumstances& circumstances,
                 std::span<const Demands> ways, std::span<const Reason> reasons) {
  const Trigger& trigger = circumstances.trigger;
  if (!stops_tasks(trigger) || reasons.empty()) return false;
  const SituationSpace space(catalog, situation_of(circumstances.state), {});
  Effort effort = effort_of(circumstances);
  RelaxedQuestions questions(space, effort, present_values(catalog, circumstances));
  for (const Demands& way : ways) questions.add({{trigger.group, way}});
  return questions.solve(reasons) == Feasibility::yes;
}

/// The event itself.
Reason reason_of(const Trigger& trigger) {
  Reason reason;
  reason.kind =
      trigger.kind == Trigger::Kind::stop ? Reason::Kind::stopped : Reason::Kind::finished;
  reason.task = trigger.kind == Trigger::Kind::stop ? trigger.task : none;
  reason.behavior = trigger.behavior;
  return reason;
}

}  // namespace

std::vector<Reason> find_conflict(const CompiledCatalog& catalog, const EventRecord& record,
                                  const Circumstances& circumstances) {
  if (record.search != nullptr && record.search->makes_worse) {
    Reason reason;
    reason.kind = Reason::Kind::makes_worse;
    reason.task = circumstances.trigger.task;
    return {reason};
  }
  const bool is_proven =
      record.search == nullptr || record.search->result.status == SearchStatus::infeasible;
  return is_proven ? find_conflict(catalog, circumstances) : std::vector<Reason>();
}

std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                  const Circumstances& circumstances) {
  const Trigger& trigger = circumstances.trigger;
  Reason reason;
  reason.task = trigger.task;
  const Request* const request =
      trigger.task == none ? nullptr : circumstances.state.find_own_request(trigger.task);
  if (request != nullptr && request->priority > trigger.priority) {
    reason.kind = Reason::Kind::priority;
    reason.priority = request->priority;
    return {reason};
  }
  if (trigger.kind == Trigger::Kind::start && catalog.values[trigger.task].empty()) {
    reason.kind = Reason::Kind::no_behavior;
    return {reason};
  }
  const Demands nothing_else;
  return find_reasons(catalog, circumstances, std::span(&nothing_else, 1))
      .value_or(std::vector<Reason>());
}

std::optional<std::vector<Reason>> find_conflict_with(const CompiledCatalog& catalog,
                                                      const Circumstances& circumstances,
                                                      std::span<const Demands> ways) {
  auto reasons = find_reasons(catalog, circumstances, ways);
  if (!reasons) return std::nullopt;
  const bool is_event_alone = reasons->empty() && stops_tasks(circumstances.trigger);
  if (is_event_alone || needs_event(catalog, circumstances, ways, *reasons)) {
    reasons->push_back(reason_of(circumstances.trigger));
  }
  return reasons;
}

Reason reason_of_unavailability(const CompiledCatalog& catalog, const State& state,
                                BehaviorId behavior) {
  return unavailability(catalog, state, behavior, false);
}

std::vector<Reason> reasons_of_unavailability(const CompiledCatalog& catalog, const State& state,
                                              TaskId task) {
  std::vector<Reason> reasons;
  for (const Value& value : catalog.values[task]) {
    reasons.push_back(reason_of_unavailability(catalog, state, value.behavior));
  }
  return reasons;
}

std::vector<Reason> hindrances_to_reactive_start(const CompiledCatalog& catalog, const State& state,
                                                 TaskId task) {
  if (!catalog.values[task].empty() && !state.has_available_behavior(task)) {
    return reasons_of_unavailability(catalog, state, task);
  }
  Trigger start;
  start.group = catalog.tasks[task].group;
  start.task = task;
  start.is_reactive = true;
  start.priority = catalog.rules_of(task).reactive_priority;
  return find_conflict(catalog, {state, start, start.priority, {}});
}

}  // namespace cbc
