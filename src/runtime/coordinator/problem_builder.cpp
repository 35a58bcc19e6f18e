#include "runtime/coordinator/problem_builder.h"

#include <algorithm>

namespace cbc {

bool is_protected(const State& state, const Trigger& trigger, TaskId task,
                  std::int32_t protection) {
  if (!state.has_request(task)) return false;
  const std::int32_t priority = state.request(task).priority;
  if (trigger.is_reactive) return priority >= trigger.priority;
  if (trigger.kind == Trigger::Kind::reconsider) return priority >= 1;
  return priority > protection;
}

bool has_finished(const State& state, const Trigger& trigger, TaskId task) {
  return trigger.kind == Trigger::Kind::finish && state.behavior(task) == trigger.behavior;
}

ProblemBuilder::ProblemBuilder(const CompiledCatalog& catalog, const State& state)
    : catalog_(catalog), state_(state), may_need_(catalog) {}

void ProblemBuilder::load(const Trigger& trigger, std::uint64_t event) {
  trigger_ = trigger;
  first_task_ = catalog_.group_tasks[trigger.group];
  end_task_ = catalog_.group_tasks[trigger.group + 1];
  excluded_.clear();
  problem_.group = trigger.group;
  problem_.present.clear();
  for (TaskId task = first_task_; task < end_task_; ++task) {
    problem_.present.push_back(state_.value_index(task));
  }
  find_active();
  rank_requests(event);

  first_protection_ = trigger.kind == Trigger::Kind::finish ? 0 : trigger.priority;
  if (trigger.kind != Trigger::Kind::finish) return;
  for (const ValueId value : catalog_.performs[trigger.behavior]) {
    const TaskId task = catalog_.task_of(value);
    if (has_finished(task) && state_.has_request(task)) {
      first_protection_ = std::max(first_protection_, state_.request(task).priority);
    }
  }
  if (trigger.cause != FinishCause::goal_achieved &&
      trigger.cause != FinishCause::situation_change) {
    exclude(trigger.behavior);
  }
}

void ProblemBuilder::find_active() {
  const BehaviorId first = catalog_.group_behaviors[trigger_.group];
  is_listed_.assign(catalog_.group_behaviors[trigger_.group + 1] - first, 0);
  problem_.active.clear();
  for (TaskId task = first_task_; task < end_task_; ++task) {
    const BehaviorId behavior = state_.behavior(task);
    if (behavior == none || has_finished(task) || is_listed_[behavior - first] != 0) continue;
    is_listed_[behavior - first] = 1;
    problem_.active.push_back(behavior);
  }
  std::sort(problem_.active.begin(), problem_.active.end());
}

/// The active requests: those of running tasks and the new one, without those that a stop or a
/// success ends; and the suspended ones. Of each kind the highest priority first, then the most
/// recent.
void ProblemBuilder::rank_requests(std::uint64_t event) {
  const auto priority_of = [&](LocalTask task) {
    const TaskId id = first_task_ + task;
    return id == trigger_.task ? trigger_.priority : state_.request(id).priority;
  };
  const auto event_of = [&](LocalTask task) {
    const TaskId id = first_task_ + task;
    return id == trigger_.task ? event : state_.request(id).event;
  };
  problem_.requests.clear();
  problem_.suspended = 0;
  problem_.unasked = 0;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    const bool is_new = trigger_.kind == Trigger::Kind::start && task == trigger_.task;
    const bool is_stopped = trigger_.kind == Trigger::Kind::stop && task == trigger_.task;
    const bool is_done = trigger_.cause == FinishCause::goal_achieved && has_finished(task);
    const bool is_active = state_.has_request(task) && !is_stopped && !is_done;
    const bool waits = state_.is_suspended(task) && !trigger_.is_unasked();
    if (!is_new && !is_active && !waits) continue;
    problem_.requests.push_back(task - first_task_);
    if (!is_new && waits) ++problem_.suspended;
  }
  const auto waits = [&](LocalTask task) {
    const TaskId id = first_task_ + task;
    return state_.is_suspended(id) &&
           !(trigger_.kind == Trigger::Kind::start && id == trigger_.task);
  };
  std::sort(problem_.requests.begin(), problem_.requests.end(), [&](LocalTask a, LocalTask b) {
    if (problem_.suspended > 0) {
      const bool is_unasked = priority_of(a) == 0;
      if (is_unasked != (priority_of(b) == 0)) return !is_unasked;
      if (waits(a) != waits(b)) return waits(b);
    }
    return priority_of(a) != priority_of(b) ? priority_of(a) > priority_of(b)
                                            : event_of(a) > event_of(b);
  });
  const auto first_unasked = std::find_if(problem_.requests.rbegin(), problem_.requests.rend(),
                                          [&](LocalTask task) { return priority_of(task) != 0; });
  problem_.unasked = static_cast<std::uint32_t>(first_unasked - problem_.requests.rbegin());
}

std::optional<std::int32_t> ProblemBuilder::next_protection(std::int32_t level) const {
  std::optional<std::int32_t> next;
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (!state_.has_request(task)) continue;
    const std::int32_t priority = state_.request(task).priority;
    if (priority > level && (!next || priority < *next)) next = priority;
  }
  return next;
}

const Problem& ProblemBuilder::build(std::int32_t protection) {
  const auto words_begin = state_.available_words().begin();
  problem_.domains.assign(words_begin + catalog_.words[first_task_],
                          words_begin + catalog_.words[end_task_]);
  problem_.may_stop.assign(end_task_ - first_task_, 1);
  for (TaskId task = first_task_; task < end_task_; ++task) {
    add_present_value(task);
    restrict_domain(task, protection);
    if (!catalog_.task_rules.empty()) keep_from_improving(task);
  }
  if (trigger_.kind == Trigger::Kind::reconsider) keep_what_was_not_asked_for();
  remove_excluded();
  return problem_;
}

/// Available behaviors are in the domain already. The present one may be kept if it fits, unless it
/// has just finished.
void ProblemBuilder::add_present_value(TaskId task) {
  if (state_.is_running(task) && !has_finished(task) && state_.fits(state_.behavior(task))) {
    const std::uint32_t index = state_.value_index(task);
    word_of(task, index) |= std::uint64_t{1} << (index % 64);
  }
}

void ProblemBuilder::restrict_domain(TaskId task, std::int32_t protection) {
  std::uint8_t& may_stop = problem_.may_stop[task - first_task_];
  if (task == trigger_.task) {
    if (trigger_.kind == Trigger::Kind::stop) {
      empty_domain(task);
    } else {
      may_stop = 0;
    }
  } else if (has_finished(task)) {
    if (trigger_.cause == FinishCause::goal_achieved) empty_domain(task);
  } else if (!state_.is_running(task)) {
    const bool waits = state_.is_suspended(task) && !trigger_.is_unasked();
    if (catalog_.tasks[task].start_on_request && !waits) empty_domain(task);
  } else if (is_protected(state_, trigger_, task, protection)) {
    may_stop = 0;
  }
}

/// A running task that gets better only when it is started keeps no better behavior, unless this is
/// a scripted start of it.
void ProblemBuilder::keep_from_improving(TaskId task) {
  const bool is_started =
      trigger_.kind == Trigger::Kind::start && !trigger_.is_reactive && task == trigger_.task;
  if (!is_started && catalog_.task_rules[task].improve == Improve::when_started) {
    remove_better(task);
  }
}

/// Where a group is reconsidered, only what may improve at once, what waits, and what these may
/// need gets better.
void ProblemBuilder::keep_what_was_not_asked_for() {
  const auto may_improve = [this](TaskId task) {
    return state_.is_running(task) && catalog_.rules_of(task).improve == Improve::at_once;
  };
  may_need_.clear();
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (may_improve(task) || state_.is_suspended(task)) may_need_.add(task);
  }
  for (TaskId task = first_task_; task < end_task_; ++task) {
    if (!may_improve(task) && !may_need_.has(task)) remove_better(task);
  }
}

/// Removes the values of a running task that suit it better than its present one.
void ProblemBuilder::remove_better(TaskId task) {
  if (!state_.is_running(task)) return;
  const auto values = catalog_.values[task];
  const std::uint32_t present = state_.value_index(task);
  for (std::uint32_t index = 0; index < present; ++index) {
    if (values[index].suitability == values[present].suitability) break;
    word_of(task, index) &= ~(std::uint64_t{1} << (index % 64));
  }
}

void ProblemBuilder::remove_excluded() {
  for (const BehaviorId behavior : excluded_) {
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId task = catalog_.task_of(value);
      const std::uint32_t index = value - catalog_.values.begin[task];
      word_of(task, index) &= ~(std::uint64_t{1} << (index % 64));
    }
  }
}

std::uint64_t& ProblemBuilder::word_of(TaskId task, std::uint32_t index) {
  return problem_.domains[catalog_.words[task] - catalog_.words[first_task_] + index / 64];
}

void ProblemBuilder::empty_domain(TaskId task) {
  const auto first =
      problem_.domains.begin() + (catalog_.words[task] - catalog_.words[first_task_]);
  std::fill(first, first + (catalog_.words[task + 1] - catalog_.words[task]), 0);
}

}  // namespace cbc
