// Every event is one problem of constraint optimization, after M. Molina and P. Santamaria,
// "Behavior coordination for self-adaptive robots using constraint-based configuration": out of all
// sets of behaviors that are consistent after the event, the best one is found, checked by code of
// its own, and applied as a whole. What the clock brings, timeouts and reactive starts, are events
// like all others, handled one after the other in the order of time. An event concerns the tasks of
// one group: groups share no constraint, so the best answer of one is part of the best of all.
//
// To change what is active step by step, starting what a task requires and stopping its rivals,
// would be quicker. But then the answer depends on the order of the steps and on all earlier
// events, and a task may be refused for which there was a place.
#include "runtime/coordinator/coordinator.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <functional>

#include "runtime/base/text.h"
#include "runtime/coordinator/problem_builder.h"

namespace cbc {

Coordinator::Coordinator(const CompiledCatalog& catalog, const CoordinatorOptions& options,
                         EventListener& listener)
    : catalog_(catalog),
      options_(options),
      listener_(listener),
      state_(catalog),
      problem_builder_(catalog, state_),
      transition_(catalog, state_, record_),
      solver_(catalog, options.search),
      checker_(catalog),
      asked_(catalog),
      needs_(catalog),
      needs_of_others_(catalog) {}

void Coordinator::begin(std::span<const Availability> situation,
                        std::span<const VariableValue> variables) {
  state_.change_situation(situation, variables);
  for (GroupId group(0); group < catalog_.group_count(); ++group) enqueue_group(group);
}

void Coordinator::resume(const Snapshot& snapshot) {
  now_ = snapshot.now;
  record_.index = snapshot.events;
  state_.restore(snapshot);
  lost_.clear();
  misfits_.clear();
  to_reconsider_.clear();
  restart_count();
}

Snapshot Coordinator::snapshot() const {
  Snapshot snapshot;
  snapshot.now = now_;
  snapshot.events = record_.index;
  snapshot.reactive_delay = options_.reactive_delay;
  snapshot.timeouts = options_.timeouts;
  for (const std::uint32_t index : state_.running()) {
    const TaskId task = catalog_.task_ids[index];
    Snapshot::RunningTask& entry = snapshot.running.emplace_back();
    entry = {
        task, state_.value_index(task), state_.taken_at(task), {}, state_.timeouts().has(index)};
    if (const Request* const request = state_.find_request(task)) entry.request = *request;
  }
  for (const BehaviorId behavior : catalog_.behavior_ids) {
    if (state_.is_active(behavior)) {
      snapshot.active.emplace_back(behavior, state_.activated_at(behavior));
    }
    if (state_.is_denied(behavior)) snapshot.denied.push_back(behavior);
    if (state_.is_faulty(behavior)) snapshot.faulty.push_back(behavior);
    if (state_.has_failed(behavior)) {
      snapshot.failed.emplace_back(behavior, state_.failed_at(behavior));
    }
  }
  snapshot.variables = state_.variables();
  for (const TaskId task : catalog_.task_ids) {
    if (state_.is_waiting(task)) snapshot.waiting.push_back(task);
    if (state_.is_suspended(task)) {
      snapshot.suspended.emplace_back(task, *state_.find_own_request(task));
    }
  }
  for (const auto& [due, index] : state_.queue().entries()) {
    snapshot.queue.emplace_back(catalog_.task_ids[index], due);
  }
  std::sort(snapshot.queue.begin(), snapshot.queue.end(), [this](const auto& a, const auto& b) {
    return catalog_.tasks[a.first].catalog_index < catalog_.tasks[b.first].catalog_index;
  });
  return snapshot;
}

// The clock.

Coordinator::Status Coordinator::advance_to(Microseconds time) {
  if (const Status status = finish_pending(); status != Status::ok) return status;
  for (auto due = next_due(); due && *due < time; due = next_due()) {
    // Only between instants, so that the events of one are in a log together.
    if (*due > now_ && options_.is_stopped && options_.is_stopped()) return Status::stopped;
    if (const Status status = process_next_due(); status != Status::ok) return status;
  }
  now_ = time;
  return Status::ok;
}

Coordinator::Status Coordinator::settle() {
  if (const Status status = finish_pending(); status != Status::ok) return status;
  for (auto due = next_due(); due && *due <= now_; due = next_due()) {
    if (const Status status = process_next_due(); status != Status::ok) return status;
  }
  return Status::ok;
}

std::optional<Microseconds> Coordinator::next_due() const {
  const Timers& timeouts = state_.timeouts();
  const Timers& queue = state_.queue();
  if (!lost_.empty() || !misfits_.empty() || !to_reconsider_.empty()) return now_;
  if (timeouts.empty() && queue.empty()) return std::nullopt;
  if (timeouts.empty()) return queue.first_due();
  if (queue.empty()) return timeouts.first_due();
  return std::min(timeouts.first_due(), queue.first_due());
}

/// At one instant, timeouts come before reactive starts. Each counts towards max_clock_events, even
/// if it is a no-op, so that the limit bounds the time that a call takes.
Coordinator::Status Coordinator::process_next_due() {
  if (clock_events_ == options_.max_clock_events) return Status::too_many_clock_events;
  ++clock_events_;
  const Timers& timeouts = state_.timeouts();
  const Timers& queue = state_.queue();
  now_ = *next_due();
  const bool is_timeout = !timeouts.empty() && timeouts.first_due() == now_;
  const TaskId task = catalog_.task_ids[is_timeout ? timeouts.first() : queue.first()];
  const Status status = is_timeout ? time_out(task) : start_reactive(task);
  return status == Status::ok ? finish_pending() : status;
}

Coordinator::Status Coordinator::time_out(TaskId task) {
  state_.drop_timeout(task);
  open_record(Origin::timeout, Verb::finish);
  return finish(state_.behavior(task), FinishCause::time_out);
}

Coordinator::Status Coordinator::start_reactive(TaskId task) {
  state_.dequeue(task);
  if (!may_start(task)) {
    state_.set_waiting(task, false);
    return Status::ok;
  }
  open_record(Origin::reactive, Verb::start);
  return start(task, catalog_.rules_of(task).reactive_priority, std::string_view{}, true);
}

/// Whether a reactive task that is due may start. True does not promise it: that takes a search.
bool Coordinator::may_start(TaskId task) const {
  return !state_.is_running(task) && !is_blocked(task) && state_.has_available_behavior(task);
}

bool Coordinator::is_blocked(TaskId task) const {
  return state_.is_blocked(task, catalog_.rules_of(task).reactive_priority);
}

/// Handles what follows an event at the same instant: first the behaviors finish that a rollback
/// could not activate again, then the active ones that no longer fit the situation; then the groups
/// are reconsidered in which more is possible.
Coordinator::Status Coordinator::finish_pending() {
  while (!lost_.empty() || !misfits_.empty() || !to_reconsider_.empty()) {
    Status status = Status::ok;
    if (!lost_.empty()) {
      const BehaviorId behavior = lost_.back();
      lost_.pop_back();
      open_record(Origin::fault, Verb::finish);
      status = finish(behavior, FinishCause::process_failure);
    } else if (misfits_.empty()) {
      const GroupId group = to_reconsider_.back();
      to_reconsider_.pop_back();
      status = reconsider(group);
    } else {
      const BehaviorId behavior = catalog_.behavior_ids[misfits_.back()];
      misfits_.pop_back();
      // An earlier finish may have replaced it already.
      if (!state_.is_active(behavior) || state_.fits(behavior)) continue;
      open_record(Origin::situation, Verb::finish);
      status = finish(behavior, FinishCause::situation_change);
    }
    if (status != Status::ok) return status;
  }
  return Status::ok;
}

// Events.

Coordinator::Status Coordinator::handle(const Event& event) {
  open_record(Origin::script, event.verb);
  const Status status = take(event);
  return status == Status::ok ? finish_pending() : status;
}

Coordinator::Status Coordinator::take(const Event& event) {
  switch (event.verb) {
    case Verb::start:
      return start(catalog_.task_ids[event.subject], event.priority.value_or(1), event.parameters,
                   false);
    case Verb::stop:
      return stop(catalog_.task_ids[event.subject], event.priority);
    case Verb::finish:
      if (!event.is_by_task) return finish(catalog_.behavior_ids[event.subject], event.cause);
      record_.task = catalog_.task_ids[event.subject];
      return finish(state_.behavior(record_.task), event.cause);
    case Verb::situation:
      return change_situation(event);
    case Verb::fault:
      record_.behavior = catalog_.behavior_ids[event.subject];
      state_.set_faulty(record_.behavior, true);
      return report();
    case Verb::repair:
      repair(catalog_.behavior_ids[event.subject]);
      return report();
    case Verb::wait:
      return report();
    case Verb::reconsider:  // no event of a script
      break;
  }
  return Status::ok;
}

void Coordinator::open_record(Origin origin, Verb verb) {
  const std::uint64_t index = record_.index + 1;
  record_.changes.clear();
  record_.tasks_of_changes.clear();
  record_.stopped_tasks.clear();
  record_.resumed_tasks.clear();
  record_.tasks_taken_over.clear();
  record_.objective.reset();
  record_.search = nullptr;
  record_.index = index;
  record_.time = now_;
  record_.origin = origin;
  record_.verb = verb;
  record_.task = none;
  record_.behavior = none;
  record_.priority = 0;
  record_.outcome = Outcome::unchanged;
}

Coordinator::Status Coordinator::report() {
  listener_.on_event(record_);
  return Status::ok;
}

Coordinator::Status Coordinator::start(TaskId task, std::int32_t priority,
                                       std::optional<std::string_view> parameters,
                                       bool is_reactive) {
  record_.task = task;
  record_.priority = priority;
  const Request* const request = state_.find_own_request(task);
  Trigger trigger;
  trigger.kind = Trigger::Kind::start;
  trigger.group = catalog_.tasks[task].group;
  trigger.task = task;
  trigger.priority = priority;
  trigger.time = now_;
  trigger.is_reactive = is_reactive;
  if (request != nullptr && request->priority > priority) {
    return reject_by_priority(trigger);
  }
  if (parameters) {
    trigger.parameters = *parameters;
  } else if (request != nullptr) {
    trigger.parameters = request->parameters;
  }
  if (!is_reactive) forgive(task);
  return coordinate(trigger);
}

/// Takes out of X the behaviors that are tried again when somebody starts a task that may need
/// them, unless this is an attempt on what runs or may be needed: those that are not active after
/// the event go back.
void Coordinator::forgive(TaskId task) {
  forgiven_.clear();
  if (state_.failed_count() == 0) return;
  const GroupId group = catalog_.tasks[task].group;
  needs_.clear();
  needs_.add(task);
  needs_of_others_.clear();
  for (TaskId other = catalog_.group_tasks[group]; other < catalog_.group_tasks[group + 1];
       ++other) {
    if (state_.is_running(other) && !excludes(task, other)) needs_of_others_.add(other);
  }
  for (BehaviorId behavior = catalog_.group_behaviors[group];
       behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
    if (!state_.has_failed(behavior) || catalog_.retry_of(behavior) != Retry::when_started) {
      continue;
    }
    bool is_needed = false;
    bool is_used = false;
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId one = catalog_.task_of(value);
      is_needed |= needs_.has(one);
      is_used |= state_.is_running(one) || needs_of_others_.has(one);
    }
    if (!is_needed || is_used) continue;
    forgiven_.emplace_back(behavior, state_.failed_at(behavior));
    state_.clear_failed(behavior);
  }
}

/// To be called when the event is done.
void Coordinator::end_forgiving() {
  for (const auto& [behavior, time] : forgiven_) {
    if (!state_.is_active(behavior) && !state_.has_failed(behavior)) {
      state_.set_failed(behavior, time);
    }
  }
  forgiven_.clear();
}

/// Whether two tasks exclude each other.
bool Coordinator::excludes(TaskId a, TaskId b) const {
  const auto of_a = catalog_.task_cliques[a];
  const auto of_b = catalog_.task_cliques[b];
  return a != b &&
         std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

/// A behavior has failed: unless it is tried again at any event, it joins X.
void Coordinator::note_failure(BehaviorId behavior) {
  if (catalog_.retry_of(behavior) != Retry::at_events) state_.set_failed(behavior, now_);
}

Coordinator::Status Coordinator::stop(TaskId task, std::optional<std::int32_t> priority) {
  record_.task = task;
  const Request* const request = state_.find_own_request(task);
  record_.priority = priority.value_or(request != nullptr ? request->priority : 0);
  Trigger trigger;
  trigger.kind = Trigger::Kind::stop;
  trigger.group = catalog_.tasks[task].group;
  trigger.task = task;
  trigger.priority = record_.priority;
  if (request != nullptr && request->priority > record_.priority) {
    return reject_by_priority(trigger);
  }
  if (state_.is_running(task)) return coordinate(trigger);
  state_.dequeue(task);
  state_.set_waiting(task, false);
  if (request != nullptr) {
    state_.end_suspended_request(task);
    record_.outcome = Outcome::accepted;
  }
  return report();
}

/// The task's own request has a higher priority than the event.
Coordinator::Status Coordinator::reject_by_priority(const Trigger& trigger) {
  record_.outcome = Outcome::rejected;
  listener_.on_decision(record_, {state_, trigger, record_.priority, {}}, nullptr);
  return report();
}

Coordinator::Status Coordinator::finish(BehaviorId behavior, FinishCause cause) {
  record_.behavior = behavior;
  record_.cause = cause;
  if (behavior == none || !state_.is_active(behavior)) return report();
  Trigger trigger;
  trigger.kind = Trigger::Kind::finish;
  trigger.group = catalog_.group_of(behavior);
  trigger.behavior = behavior;
  trigger.cause = cause;
  if (cause != FinishCause::goal_achieved && cause != FinishCause::situation_change) {
    note_failure(behavior);
  }
  return coordinate(trigger);
}

/// Makes all changes at once. Then the reactive tasks of groups in which a behavior has become
/// available are queued, and active behaviors that no longer fit are noted, to finish in catalog
/// order.
Coordinator::Status Coordinator::change_situation(const Event& event) {
  find_affected(event);
  state_.change_situation(event.situation, event.variables);
  for (const auto& [behavior, was_available] : affected_) {
    if (!was_available && state_.is_available(behavior)) make_possible(behavior);
    if (!state_.is_active(behavior) || state_.fits(behavior)) continue;
    misfits_.push_back(catalog_.behaviors[behavior].catalog_index);
  }
  std::sort(misfits_.begin(), misfits_.end(), std::greater());
  cause_of_reconsidering_ = Origin::situation;
  return report();
}

/// A behavior has become available, or need no longer fail: reactive tasks of its group are queued,
/// and the group is to be decided anew.
void Coordinator::make_possible(BehaviorId behavior) {
  const GroupId group = catalog_.group_of(behavior);
  enqueue_group(group);
  const auto place =
      std::lower_bound(to_reconsider_.begin(), to_reconsider_.end(), group, std::greater());
  if (place == to_reconsider_.end() || *place != group) to_reconsider_.insert(place, group);
}

void Coordinator::find_affected(const Event& event) {
  affected_.clear();
  const auto add = [&](BehaviorId behavior) {
    affected_.emplace_back(behavior, state_.is_available(behavior));
  };
  for (const Availability& entry : event.situation) add(catalog_.behavior_ids[entry.behavior]);
  for (const VariableValue& value : event.variables) {
    for (const FittingValue& fitting : state_.fitting(value.variable)) add(fitting.behavior);
  }
}

void Coordinator::repair(BehaviorId behavior) {
  record_.behavior = behavior;
  if (!state_.is_faulty(behavior) && !state_.has_failed(behavior)) return;
  state_.set_faulty(behavior, false);
  state_.clear_failed(behavior);
  make_possible(behavior);
  cause_of_reconsidering_ = Origin::repair;
}

/// Decides a group anew if a task of it may improve at once, or waits to be resumed
/// (docs/semantics.md, "Reconsidering").
Coordinator::Status Coordinator::reconsider(GroupId group) {
  bool has_reason = false;
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    has_reason |= state_.is_suspended(task) || may_improve(task);
  }
  if (!has_reason) return Status::ok;
  open_record(cause_of_reconsidering_, Verb::reconsider);
  Trigger trigger;
  trigger.kind = Trigger::Kind::reconsider;
  trigger.group = group;
  return coordinate(trigger);
}

bool Coordinator::may_improve(TaskId task) const {
  return state_.is_running(task) && catalog_.rules_of(task).improve == Improve::at_once;
}

/// Whether a solution resumes a task, or gives one a better behavior that may improve at once.
bool Coordinator::improves(GroupId group) const {
  const TaskId first = catalog_.group_tasks[group];
  for (TaskId task = first; task < first + solution_.size(); ++task) {
    const std::uint32_t index = solution_[task - first];
    if (index == none) continue;
    if (state_.is_suspended(task)) return true;
    if (!may_improve(task)) continue;
    const auto values = catalog_.values[task];
    if (values[index].suitability > values[state_.value_index(task)].suitability) return true;
  }
  return false;
}

// Coordination.

Coordinator::Status Coordinator::coordinate(const Trigger& trigger) {
  problem_builder_.load(trigger, record_.index);
  transition_.load(trigger, problem_builder_.active_before());
  if (trigger.kind == Trigger::Kind::finish) state_.set_inactive(trigger.behavior);
  for (;;) {
    const Problem* const problem = options_.measure_time ? timed_search(trigger) : search(trigger);
    if (problem == nullptr) return reject(trigger);
    if (trigger.is_unasked() &&
        asked_.is_worse(catalog_.group_tasks[trigger.group], *problem, solution_)) {
      search_.result.status = SearchStatus::infeasible;
      search_.makes_worse = true;
      return reject(trigger);
    }
    if (trigger.kind == Trigger::Kind::reconsider && problem_builder_.excluded().empty() &&
        !improves(trigger.group)) {
      --record_.index;
      return Status::ok;
    }
    if (const auto violation = checker_.find_violation(*problem, solution_)) {
      internal_error_ = describe_refusal(*violation);
      return Status::refused_answer;
    }
    const auto failed = transition_.apply(solution_, behavior_to_restart(trigger), now_);
    if (!failed) {
      listener_.on_decision(record_, circumstances_of(trigger, problem), &solution_);
      accept(trigger, *problem);
      end_forgiving();
      return report();
    }
    problem_builder_.exclude(*failed);
    note_failure(*failed);
  }
}

/// The report of an internal error: the event, the violation, and the answer.
std::string Coordinator::describe_refusal(const std::string& violation) const {
  std::string text = concat("event ", record_.index, " (", name_of(record_.verb), "): ", violation,
                            "; the answer was");
  const TaskId first = catalog_.group_tasks[search_.group];
  for (LocalTask task(0); task < solution_.size(); ++task) {
    const std::uint32_t place = solution_[task];
    if (place == none) continue;
    text += concat(
        " ", printable(catalog_.name_of_task(first + task)), "=",
        place < catalog_.values[first + task].size()
            ? printable(catalog_.name_of_behavior(catalog_.values[first + task][place].behavior))
            : "?");
  }
  return text;
}

/// Solves the problem of the trigger. A finish without a solution escalates to higher protection
/// levels, up to the one that protects nothing. All searches of an event share its limits. Returns
/// the problem that was solved, or null.
const Problem* Coordinator::search(const Trigger& trigger) {
  std::int32_t protection = problem_builder_.first_protection();
  bool is_first = record_.search == nullptr;
  if (is_first) {
    search_.result = {};
    search_.elapsed.reset();
    search_.makes_worse = false;
  }
  record_.search = &search_;
  search_.group = trigger.group;
  for (;;) {
    const Problem& problem = problem_builder_.build(protection);
    const SearchResult result =
        is_first ? solver_.solve(problem, solution_) : solver_.solve_again(problem, solution_);
    is_first = false;
    search_.protection = protection;
    search_.is_escalated = protection != problem_builder_.first_protection();
    search_.result.status = result.status;
    search_.result.bound = result.bound;
    search_.result.solutions += result.solutions;
    search_.result.nodes += result.nodes;
    search_.result.propagations += result.propagations;
    listener_.on_search(problem, has_solution(result.status) ? &solution_ : nullptr);
    if (has_solution(result.status)) {
      note_domain_sizes(problem);
      return &problem;
    }
    if (trigger.kind == Trigger::Kind::finish && result.status == SearchStatus::unknown) {
      return &keep_present(protection);
    }
    const auto next = trigger.kind == Trigger::Kind::finish
                          ? problem_builder_.next_protection(protection)
                          : std::nullopt;
    if (!next) {
      note_domain_sizes(problem);
      return nullptr;
    }
    protection = *next;
  }
}

/// The answer to a finish where a limit ended the search without one: the present values, apart
/// from what has ended and what then violates something.
const Problem& Coordinator::keep_present(std::int32_t protection) {
  for (auto next = problem_builder_.next_protection(protection); next;
       next = problem_builder_.next_protection(protection)) {
    protection = *next;
  }
  const Problem& problem = problem_builder_.build(protection);
  solution_ = problem.present;
  const TaskId first = catalog_.group_tasks[problem.group];
  for (LocalTask task(0); task < solution_.size(); ++task) {
    if (problem_builder_.has_finished(first + task)) solution_[task] = none;
  }
  checker_.stop_violating_tasks(problem, solution_);
  search_.protection = protection;
  search_.is_escalated = protection != problem_builder_.first_protection();
  search_.result.status = SearchStatus::feasible;
  search_.result.bound = solver_.bound(problem, solution_);
  note_domain_sizes(problem);
  return problem;
}

/// The same, with its time measured.
const Problem* Coordinator::timed_search(const Trigger& trigger) {
  const auto begin = std::chrono::steady_clock::now();
  const Problem* const problem = search(trigger);
  const std::chrono::nanoseconds elapsed = std::chrono::steady_clock::now() - begin;
  search_.elapsed = search_.elapsed.value_or(std::chrono::nanoseconds(0)) + elapsed;
  return problem;
}

void Coordinator::note_domain_sizes(const Problem& problem) {
  const TaskId first = catalog_.group_tasks[problem.group];
  search_.domain_sizes.clear();
  for (LocalTask task(0); task < problem.may_stop.size(); ++task) {
    std::uint32_t size = problem.may_stop[task];
    for (std::uint32_t word = catalog_.words[first + task]; word < catalog_.words[first + task + 1];
         ++word) {
      size +=
          static_cast<std::uint32_t>(std::popcount(problem.domains[word - catalog_.words[first]]));
    }
    search_.domain_sizes.push_back(size);
  }
}

/// The behavior that the started task keeps, if it has to restart to take over changed parameters;
/// otherwise none.
BehaviorId Coordinator::behavior_to_restart(const Trigger& trigger) const {
  if (trigger.kind != Trigger::Kind::start || !state_.is_running(trigger.task)) return none;
  const std::uint32_t index = solution_[trigger.task - catalog_.group_tasks[trigger.group]];
  if (index != state_.value_index(trigger.task)) return none;
  const Request* const request = state_.find_request(trigger.task);
  const std::string_view present = request != nullptr ? request->parameters : std::string_view();
  return trigger.parameters == present ? none : state_.behavior(trigger.task);
}

void Coordinator::accept(const Trigger& trigger, const Problem& problem) {
  record_.outcome = Outcome::accepted;
  const TaskId first = catalog_.group_tasks[trigger.group];
  const TaskId end = catalog_.group_tasks[trigger.group + 1];
  std::uint32_t elsewhere = state_.request_count();
  for (TaskId task = first; task < end; ++task) {
    if (state_.is_counted(task)) --elsewhere;
  }
  ObjectiveValues& objective = record_.objective.emplace();
  objective.requests = elsewhere + static_cast<std::uint32_t>(problem.counted_requests().size());
  objective.changes = transition_.count_changes();
  assign(trigger);
  // Requests that waited are not counted.
  objective.satisfied =
      state_.request_count() - static_cast<std::uint32_t>(record_.resumed_tasks.size());
  objective.idle_total = state_.idle_total();
  objective.idle_running = state_.idle_running();
  update_timeouts(trigger.group);
  update_queue();
  if (state_.waiting_count() > 0) retry_waiting(trigger.group);
}

/// Of the event, while the state is still the one before it.
Circumstances Coordinator::circumstances_of(const Trigger& trigger, const Problem* problem) const {
  return {state_,  trigger,           search_.protection, problem_builder_.excluded(),
          problem, solver_.deadline()};
}

/// Rolls back. Behaviors that cannot be activated again are lost. A finish always has an answer:
/// where nothing is protected, all tasks may stop.
Coordinator::Status Coordinator::reject(const Trigger& trigger) {
  record_.outcome = Outcome::rejected;
  const bool is_silent = note_waiting(trigger);
  if (!is_silent) listener_.on_decision(record_, circumstances_of(trigger, nullptr), nullptr);
  // In reverse, as the last one finishes next.
  const std::vector<BehaviorId>& lost = transition_.roll_back(now_);
  lost_.insert(lost_.end(), lost.rbegin(), lost.rend());
  for (const BehaviorId behavior : lost) note_failure(behavior);
  end_forgiving();
  update_timeouts(trigger.group);
  if (!is_silent) return report();
  --record_.index;
  return Status::ok;
}

/// A reactive task whose start had no solution waits for a change of its group. True if it waited
/// before and nothing happened, which is no event.
bool Coordinator::note_waiting(const Trigger& trigger) {
  if (!trigger.is_reactive) return false;
  const bool was_waiting = state_.is_waiting(trigger.task);
  const bool has_tried = !record_.changes.empty();
  state_.set_waiting(trigger.task, trigger.is_unasked() || !has_tried);
  return was_waiting && !has_tried;
}

/// Whether the behavior, which may be none, was active before the event and goes on.
bool Coordinator::was_active(BehaviorId behavior) const {
  const std::vector<BehaviorId>& active = problem_builder_.active_before();
  return behavior != none && std::binary_search(active.begin(), active.end(), behavior);
}

/// Gives the tasks of the group the values of the solution.
void Coordinator::assign(const Trigger& trigger) {
  started_.clear();
  stopped_by_others_.clear();
  const TaskId first = catalog_.group_tasks[trigger.group];
  for (TaskId task = first; task < first + solution_.size(); ++task) {
    if (state_.value_index(task) == solution_[task - first]) continue;
    const bool was_running = state_.is_running(task);
    std::optional<std::int32_t> priority;
    if (const Request* const request = state_.find_request(task)) priority = request->priority;
    const bool has_finished = problem_builder_.has_finished(task);
    const bool resumes = state_.is_suspended(task);
    state_.set_value(task, solution_[task - first], now_, is_suspended_by(trigger, task));
    if (was_active(state_.behavior(task))) record_.tasks_taken_over.push_back(task);
    if (was_running == state_.is_running(task)) continue;
    if (!was_running) {
      started_.push_back(task);
      if (resumes && task != trigger.task) record_.resumed_tasks.push_back(task);
      continue;
    }
    record_.stopped_tasks.push_back({task, has_finished ? trigger.cause : FinishCause::interrupted,
                                     has_finished, state_.is_suspended(task), priority});
    const bool is_own_end =
        has_finished ? trigger.cause != FinishCause::situation_change : task == trigger.task;
    if (!is_own_end) stopped_by_others_.push_back(task);
  }
  if (trigger.kind == Trigger::Kind::start) {
    state_.set_request(trigger.task, trigger.priority, record_.index, trigger.parameters, now_);
  }
}

/// Whether a task that stops keeps its request: not where somebody stops a task, nor where its
/// behavior has succeeded or failed.
bool Coordinator::is_suspended_by(const Trigger& trigger, TaskId task) const {
  if (catalog_.rules_of(task).resume == 0 || trigger.kind == Trigger::Kind::stop) return false;
  return !problem_builder_.has_finished(task) || trigger.cause == FinishCause::situation_change;
}

void Coordinator::update_timeouts(GroupId group) {
  if (!options_.timeouts) return;
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    state_.update_timeout(task, now_);
  }
}

// The queue of reactive tasks (docs/semantics.md, "Reactive tasks").

void Coordinator::update_queue() {
  for (const StoppedTask& stopped : record_.stopped_tasks) enqueue_rivals(stopped.task);
  for (const TaskId task : stopped_by_others_) enqueue_if_reactive(task);
  for (const TaskId task : started_) dequeue_with_rivals(task);
}

/// The tasks of the group that wait try again after an accepted event.
void Coordinator::retry_waiting(GroupId group) {
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    if (!state_.is_waiting(task)) continue;
    if (state_.is_running(task) || is_blocked(task)) {
      state_.set_waiting(task, false);
    } else {
      enqueue_if_reactive(task);
    }
  }
}

void Coordinator::enqueue_if_reactive(TaskId task) {
  if (catalog_.tasks[task].reactive_start) state_.enqueue(task, now_ + options_.reactive_delay);
}

void Coordinator::enqueue_rivals(TaskId task) {
  for_each_rival(task, [this](TaskId rival) { enqueue_if_reactive(rival); });
}

/// A task that runs leaves the queue, and so do those for which its lists leave no place.
void Coordinator::dequeue_with_rivals(TaskId task) {
  state_.dequeue(task);
  for_each_rival(task, [this, task](TaskId rival) {
    const std::int32_t priority = catalog_.rules_of(rival).reactive_priority;
    if (state_.is_blocked_by(rival, priority, task)) state_.dequeue(rival);
  });
}

/// The other tasks of its exclusivity lists.
template <typename Visit>
void Coordinator::for_each_rival(TaskId task, const Visit& visit) {
  const auto visit_list = [&](std::span<const TaskId> list) {
    for (const TaskId rival : list) {
      if (rival != task) visit(rival);
    }
  };
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    visit_list(catalog_.cliques[clique]);
  }
  for (const std::uint32_t limit : catalog_.limits_of(task)) visit_list(catalog_.limited[limit]);
}

void Coordinator::enqueue_group(GroupId group) {
  for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1]; ++task) {
    enqueue_if_reactive(task);
  }
}

}  // namespace cbc
