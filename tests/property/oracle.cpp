#include "oracle.h"

#include <algorithm>
#include <string>
#include <utility>

#include "demand.h"

namespace cbc::oracle {
namespace {

using nlohmann::ordered_json;

constexpr Microseconds default_reactive_delay = 80'000;

double seconds(Microseconds time) { return static_cast<double>(time) / 1e6; }

// Null stands for null, empty and absent; mappings lose their order.
nlohmann::json canonical(const Parameters& value) {
  if (value.is_object()) {
    nlohmann::json result;
    for (const auto& [key, item] : value.items()) {
      nlohmann::json reduced = canonical(item);
      if (!reduced.is_null()) {
        result[key] = std::move(reduced);
      }
    }
    return result;
  }
  if (value.is_array()) {
    nlohmann::json result;
    for (const Parameters& item : value) {
      result.push_back(canonical(item));
    }
    return result;
  }
  if (value.is_string() && value.get_ref<const std::string&>().empty()) {
    return nullptr;
  }
  return value;
}

// The value of a variable: true or false if it has none of its own, or else a text.
ordered_json value_json(const Variable& variable, std::size_t value) {
  return variable.is_boolean() ? ordered_json(value == 0) : ordered_json(variable.values[value]);
}

}  // namespace

std::set<std::size_t> active_behaviors(const Assignment& values) {
  std::set<std::size_t> active(values.begin(), values.end());
  active.erase(none);
  return active;
}

bool same_parameters(const Parameters& a, const Parameters& b) {
  return canonical(a) == canonical(b);
}

Oracle::Oracle(std::shared_ptr<const CatalogFacts> facts, const Script& script,
               Statistics* statistics)
    : facts_(std::move(facts)),
      statistics_(statistics),
      reactive_delay_(script.reactive_delay.value_or(default_reactive_delay)) {
  const std::size_t tasks = facts_->catalog.tasks.size();
  const std::size_t behaviors = facts_->catalog.behaviors.size();
  state_.values.assign(tasks, none);
  state_.requests.resize(tasks);
  state_.suspended.resize(tasks);
  queue_.resize(tasks);
  taken_at_.resize(tasks, 0);
  variables_.resize(facts_->catalog.variables.size(), 0);
  own_.resize(behaviors, true);
  faulty_.resize(behaviors, false);
  activated_at_.resize(behaviors, 0);
  set_situation(script.situation);
  for (std::size_t group = 0; group < facts_->groups.size(); ++group) {
    join_queue_by_group(group);
  }
}

// The clock

void Oracle::handle(const Event& event) {
  const Microseconds time = event.at.value_or(now_ + event.wait.value_or(0));
  for (std::optional<Due> due = next_due(); due && due->time < time; due = next_due()) {
    run_due(*due);
  }
  now_ = time;
  if (next_due_time() == time) {
    count("due at the instant of a scripted event");
  }
  switch (event.verb) {
    case Verb::start:
      return run_start(event);
    case Verb::stop:
      return run_stop(event);
    case Verb::finish:
      return event.performed_task == none
                 ? run_finish("script", event.subject, event.cause)
                 : run_finish("script", state_.values[event.performed_task], event.cause,
                              event.performed_task);
    case Verb::situation:
      return run_situation(event);
    case Verb::fault:
      return run_fault(event);
    case Verb::repair:
      return run_repair(event);
    case Verb::wait:
      return complete_unsolved(new_record("script", Verb::wait), "unchanged");
    case Verb::reconsider:  // no event of a script
      return;
  }
}

void Oracle::finish() {
  const Microseconds end = now_;
  for (std::optional<Due> due = next_due(); due && due->time <= end; due = next_due()) {
    run_due(*due);
  }
}

ordered_json Oracle::preview(const Event& event, Statistics* statistics) const {
  Oracle copy(*this);
  copy.statistics_ = statistics;
  copy.events_ = ordered_json::array();
  copy.handle(event);
  return copy.events_;
}

std::optional<Microseconds> Oracle::next_due_time() const {
  const std::optional<Due> due = next_due();
  return due ? std::optional<Microseconds>(due->time) : std::nullopt;
}

std::optional<Oracle::Due> Oracle::next_due() const {
  std::optional<Due> first;
  const auto consider = [&](const Due& due) {
    if (!first || due < *first) {
      first = due;
    }
  };
  for (std::size_t task = 0; task < state_.values.size(); ++task) {
    if (const std::optional<Microseconds> time = deadline(task)) {
      consider({*time, DueKind::timeout, 0, task});
    }
    if (queue_[task]) {
      consider({*queue_[task], DueKind::reactive_start,
                -facts_->catalog.tasks[task].reactive_priority, task});
    }
  }
  return first;
}

std::optional<Microseconds> Oracle::deadline(std::size_t task) const {
  const std::size_t behavior = state_.values[task];
  const Task& attributes = facts_->catalog.tasks[task];
  if (behavior == none || attributes.keep_running) {
    return std::nullopt;
  }
  std::optional<Microseconds> timeout = facts_->catalog.behaviors[behavior].timeout;
  if (!timeout) {
    timeout = attributes.timeout;
  }
  if (!timeout) {
    return std::nullopt;
  }
  return std::max(activated_at_[behavior], taken_at_[task]) + *timeout;
}

void Oracle::run_due(const Due& due) {
  now_ = due.time;
  if (due.kind == DueKind::timeout) {
    run_finish("timeout", state_.values[due.task], Cause::time_out);
  } else {
    run_reactive_start(due.task);
  }
  if (next_due_time() == due.time) {
    count("due at the instant of another that was due");
  }
}

// Events

void Oracle::run_start(const Event& event) {
  const std::size_t task = event.subject;
  const int priority = event.priority.value_or(1);
  ordered_json record = new_record("script", Verb::start);
  record["name"] = task_name(task);
  record["priority"] = priority;
  if (event.parameters) {
    record["parameters"] = *event.parameters;
  }
  const std::optional<Request>& request =
      state_.suspended[task] ? state_.suspended[task] : state_.requests[task];
  if (request && request->priority > priority) {
    count("rejected by the priority of its own request: start");
    return complete_unsolved(std::move(record), "rejected");
  }
  Trigger trigger;
  trigger.verb = Verb::start;
  trigger.subject = task;
  trigger.priority = priority;
  trigger.parameters = event.parameters;
  forgiven_ = forgive(task);
  coordinate(std::move(record), trigger);
}

void Oracle::run_stop(const Event& event) {
  const std::size_t task = event.subject;
  const std::optional<Request>& request =
      state_.suspended[task] ? state_.suspended[task] : state_.requests[task];
  const int priority = event.priority.value_or(request ? request->priority : 0);
  ordered_json record = new_record("script", Verb::stop);
  record["name"] = task_name(task);
  record["priority"] = priority;
  if (request && request->priority > priority) {
    count("rejected by the priority of its own request: stop");
    return complete_unsolved(std::move(record), "rejected");
  }
  if (state_.values[task] == none) {
    queue_[task].reset();
    if (waiting_.erase(task) != 0) {
      count("waiting: until a stop");
    }
    if (state_.suspended[task]) {
      count("suspended: until a stop");
      state_.suspended[task].reset();
      return complete_unsolved(std::move(record), "accepted");
    }
    return complete_unsolved(std::move(record), "unchanged");
  }
  Trigger trigger;
  trigger.verb = Verb::stop;
  trigger.subject = task;
  trigger.priority = priority;
  coordinate(std::move(record), trigger);
}

void Oracle::run_finish(const char* origin, std::size_t behavior, Cause cause, std::size_t task) {
  ordered_json record = new_record(origin, Verb::finish);
  record["name"] = behavior == none ? ordered_json() : ordered_json(behavior_name(behavior));
  record["cause"] = to_string(cause);
  if (task != none) {
    record["task"] = task_name(task);
    count(behavior == none ? "finish by task, not running" : "finish by task");
  }
  if (behavior == none) {
    return complete_unsolved(std::move(record), "unchanged");
  }
  if (!is_active(behavior)) {
    count(std::string("finish of an inactive behavior, origin ") + origin);
    return complete_unsolved(std::move(record), "unchanged");
  }
  count(std::string("finish: ") + to_string(cause));
  Trigger trigger;
  trigger.verb = Verb::finish;
  trigger.subject = behavior;
  trigger.cause = cause;
  if (cause != Cause::goal_achieved && cause != Cause::situation_change) {
    remember_failure(behavior);
  }
  coordinate(std::move(record), trigger);
}

void Oracle::run_situation(const Event& event) {
  ordered_json record = new_record("script", Verb::situation);
  ordered_json map = ordered_json::object();
  for (const auto& [behavior, own] : event.situation.own) {
    map[behavior_name(behavior)] = own;
  }
  std::size_t changed = 0;
  for (const auto& [variable, value] : event.situation.variables) {
    map[facts_->catalog.variables[variable].name] =
        value_json(facts_->catalog.variables[variable], value);
    changed += variables_[variable] != value ? 1U : 0U;
  }
  count_if(changed >= 1, "situation: variables change");
  count_if(changed >= 2, "situation: several variables change");
  count_if(changed >= 1 && !event.situation.own.empty(), "situation: variables and behaviors");

  std::vector<bool> fitted;
  std::vector<bool> was_available;
  for (std::size_t behavior = 0; behavior < own_.size(); ++behavior) {
    fitted.push_back(fits(behavior));
    was_available.push_back(available(behavior));
  }
  set_situation(event.situation);
  std::set<std::size_t> groups;
  for (std::size_t behavior = 0; behavior < own_.size(); ++behavior) {
    if (available(behavior) && !was_available[behavior]) {
      groups.insert(facts_->group_of_behavior(behavior));
      count_if(!fitted[behavior], "situation: available because it fits");
      join_queue_by_group(facts_->group_of_behavior(behavior));
    }
  }
  record["situation"] = std::move(map);
  if (!facts_->catalog.variables.empty()) {
    record["variables"] = variables_json();
  }
  complete_unsolved(std::move(record), "unchanged");
  finish_what_does_not_fit();
  reconsider("situation", groups);
}

void Oracle::set_situation(const Situation& situation) {
  for (const auto& [behavior, own] : situation.own) {
    own_[behavior] = own;
  }
  for (const auto& [variable, value] : situation.variables) {
    variables_[variable] = value;
  }
}

void Oracle::finish_what_does_not_fit() {
  const std::set<std::size_t> active = active_behaviors(state_.values);
  std::size_t finishes = 0;
  for (const std::size_t behavior : active) {
    if (fits(behavior)) {
      continue;
    }
    if (!is_active(behavior)) {
      count("situation: replaced by an earlier finish");
      continue;
    }
    run_finish("situation", behavior, Cause::situation_change);
    ++finishes;
  }
  count_if(finishes >= 2, "situation: several finishes");
}

void Oracle::run_fault(const Event& event) {
  ordered_json record = new_record("script", Verb::fault);
  record["name"] = behavior_name(event.subject);
  faulty_[event.subject] = true;
  complete_unsolved(std::move(record), "unchanged");
}

void Oracle::run_repair(const Event& event) {
  ordered_json record = new_record("script", Verb::repair);
  record["name"] = behavior_name(event.subject);
  std::set<std::size_t> groups;
  if (faulty_[event.subject] || failed_.contains(event.subject)) {
    count_if(!faulty_[event.subject], "repair: of what has failed, and is not faulty");
    groups.insert(facts_->group_of_behavior(event.subject));
    join_queue_by_group(facts_->group_of_behavior(event.subject));
  }
  faulty_[event.subject] = false;
  failed_.erase(event.subject);
  complete_unsolved(std::move(record), "unchanged");
  reconsider("repair", groups);
}

// Deciding anew

void Oracle::reconsider(const char* origin, const std::set<std::size_t>& groups) {
  for (const std::size_t group : groups) {
    const std::vector<std::size_t>& tasks = facts_->groups[group];
    const bool has_reason = std::any_of(tasks.begin(), tasks.end(), [&](std::size_t task) {
      return state_.suspended[task] || (state_.values[task] != none &&
                                        facts_->catalog.tasks[task].improve == Improve::at_once);
    });
    if (!has_reason) {
      continue;
    }
    Trigger trigger;
    trigger.verb = Verb::reconsider;
    trigger.subject = group;
    coordinate(new_record(origin, Verb::reconsider), trigger);
  }
}

// Whether a suspended request is resumed, or a running task that may improve at once gets a better
// behavior.
bool Oracle::improves(const Assignment& values) const {
  for (std::size_t task = 0; task < values.size(); ++task) {
    if (values[task] == none) {
      continue;
    }
    if (state_.suspended[task]) {
      return true;
    }
    if (state_.values[task] != none && facts_->catalog.tasks[task].improve == Improve::at_once &&
        facts_->suitability(values[task], task) > facts_->suitability(state_.values[task], task)) {
      return true;
    }
  }
  return false;
}

// The tasks that the task may need, itself included, whatever is chosen.
std::set<std::size_t> Oracle::may_need(std::size_t task) const {
  std::set<std::size_t> needed{task};
  std::vector<std::size_t> open{task};
  while (!open.empty()) {
    const std::size_t next = open.back();
    open.pop_back();
    for (const std::size_t behavior : facts_->behaviors_of[next]) {
      for (const Requirement& requirement : facts_->catalog.behaviors[behavior].requirements) {
        if (needed.insert(requirement.task).second) {
          open.push_back(requirement.task);
        }
      }
    }
  }
  return needed;
}

// Failures that are remembered

void Oracle::remember_failure(std::size_t behavior) {
  if (facts_->catalog.behaviors[behavior].retry != Retry::at_events) {
    failed_.insert(behavior);
  }
}

bool Oracle::excludes_each_other(std::size_t a, std::size_t b) const {
  return facts_->excludes[a].contains(b);
}

// The behaviors that leave X for a scripted start.
std::set<std::size_t> Oracle::forgive(std::size_t task) {
  const std::set<std::size_t> needed = may_need(task);
  std::set<std::size_t> needed_by_others;
  for (std::size_t other = 0; other < state_.values.size(); ++other) {
    if (state_.values[other] != none && !excludes_each_other(task, other)) {
      needed_by_others.merge(may_need(other));
    }
  }
  std::set<std::size_t> forgiven;
  for (const std::size_t behavior : failed_) {
    if (facts_->catalog.behaviors[behavior].retry != Retry::when_started) {
      continue;
    }
    bool is_needed = false;
    bool is_used = false;
    for (const Performance& performed : facts_->catalog.behaviors[behavior].performs) {
      is_needed = is_needed || needed.contains(performed.task);
      is_used = is_used || state_.values[performed.task] != none ||
                needed_by_others.contains(performed.task);
    }
    if (is_needed && !is_used) {
      forgiven.insert(behavior);
    }
  }
  for (const std::size_t behavior : forgiven) {
    failed_.erase(behavior);
  }
  count_if(!forgiven.empty(), "failed: tried again by a start");
  return forgiven;
}

void Oracle::run_reactive_start(std::size_t task) {
  queue_[task].reset();
  if (state_.values[task] != none) {
    return;
  }
  const std::vector<std::size_t>& behaviors = facts_->behaviors_of[task];
  const bool blocked = is_blocked(task);
  const bool possible = std::any_of(behaviors.begin(), behaviors.end(),
                                    [&](std::size_t behavior) { return available(behavior); });
  if (blocked || !possible) {
    count("reactive start: dropped");
    if (waiting_.erase(task) != 0) {
      count("waiting: until a start is dropped");
    }
    return;
  }
  ordered_json record = new_record("reactive", Verb::start);
  record["name"] = task_name(task);
  record["priority"] = facts_->catalog.tasks[task].reactive_priority;
  Trigger trigger;
  trigger.verb = Verb::start;
  trigger.subject = task;
  trigger.reactive = true;
  trigger.priority = facts_->catalog.tasks[task].reactive_priority;
  coordinate(std::move(record), trigger);
}

// Whether some list has as many other tasks running as may run.
bool Oracle::is_blocked(std::size_t task) const {
  const std::vector<std::size_t>& lists = facts_->lists_of[task];
  return std::any_of(lists.begin(), lists.end(),
                     [&](std::size_t list) { return is_blocked_by(task, list); });
}

bool Oracle::is_blocked_by(std::size_t task, std::size_t list) const {
  std::set<std::size_t> running;
  for (const std::size_t other : facts_->catalog.exclusivity[list]) {
    if (other != task && counts_against(task, other)) {
      running.insert(other);
    }
  }
  return running.size() >= facts_->catalog.most(list);
}

// Whether a running task counts where a reactive task might start.
bool Oracle::counts_against(std::size_t task, std::size_t other) const {
  const int least = facts_->catalog.tasks[task].reactive_priority;
  if (state_.values[other] == none) {
    return false;
  }
  return least == 0 || (state_.requests[other] && state_.requests[other]->priority >= least);
}

// Reports

ordered_json Oracle::objective(const Transition& transition, const Solution& solution) const {
  const std::vector<Task>& tasks = facts_->catalog.tasks;
  std::vector<ActiveRequest> requests = active_requests(transition);
  std::erase_if(requests, [](const ActiveRequest& request) { return request.priority == 0; });
  std::size_t satisfied = 0;
  for (const ActiveRequest& request : requests) {
    satisfied += solution.values[request.task] != none ? 1U : 0U;
  }
  Integer suitability = 1;
  std::size_t automatic = 0;
  std::size_t idle = 0;
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    const std::size_t behavior = solution.values[task];
    suitability *= behavior == none ? whole_degree : facts_->suitability(behavior, task);
    if (!tasks[task].start_on_request) {
      ++automatic;
      idle += behavior == none ? 1U : 0U;
    }
  }
  const double idle_share =
      automatic == 0 ? 1.0 : static_cast<double>(idle) / static_cast<double>(automatic);
  return {{"satisfied", satisfied},
          {"requests", requests.size()},
          {"suitability", nearest_double(suitability, power_of_million(tasks.size()))},
          {"idle", idle_share},
          {"changes", solution.changes}};
}

ordered_json Oracle::variables_json() const {
  const std::vector<Variable>& variables = facts_->catalog.variables;
  ordered_json result = ordered_json::object();
  for (std::size_t variable = 0; variable < variables.size(); ++variable) {
    result[variables[variable].name] = value_json(variables[variable], variables_[variable]);
  }
  return result;
}

ordered_json Oracle::new_record(const std::string& origin, Verb verb) {
  ++event_number_;
  return {{"index", event_number_},
          {"time", seconds(now_)},
          {"origin", origin},
          {"verb", to_string(verb)}};
}

void Oracle::complete_unsolved(ordered_json record, const std::string& outcome) {
  record["outcome"] = outcome;
  record["changes"] = ordered_json::array();
  record["stopped_tasks"] = ordered_json::array();
  record["objective"] = nullptr;
  record["search"] = nullptr;
  complete(std::move(record), outcome);
}

// Adds the state after the event.
void Oracle::complete(ordered_json record, const std::string& outcome) {
  ordered_json running = ordered_json::object();
  ordered_json requests = ordered_json::object();
  ordered_json queue = ordered_json::object();
  for (std::size_t task = 0; task < state_.values.size(); ++task) {
    if (state_.values[task] != none) {
      running[task_name(task)] = behavior_name(state_.values[task]);
    }
    if (state_.requests[task]) {
      requests[task_name(task)] = state_.requests[task]->priority;
    }
    if (queue_[task]) {
      queue[task_name(task)] = seconds(*queue_[task]);
    } else if (waiting_.contains(task)) {
      queue[task_name(task)] = nullptr;
      count("queue: waiting only");
    }
  }
  record["running"] = std::move(running);
  record["requests"] = std::move(requests);
  if (facts_->catalog.has_further_keys()) {
    ordered_json suspended = ordered_json::object();
    for (std::size_t task = 0; task < state_.values.size(); ++task) {
      if (state_.suspended[task]) {
        suspended[task_name(task)] = state_.suspended[task]->priority;
      }
    }
    count_if(!suspended.empty(), "state: with suspended requests");
    record["suspended"] = std::move(suspended);
    ordered_json failed = ordered_json::array();
    for (const std::size_t behavior : failed_) {
      failed.push_back(behavior_name(behavior));
    }
    count_if(!failed.empty(), "state: with failures that are remembered");
    record["failed"] = std::move(failed);
  }
  record["queue"] = std::move(queue);
  count("origin: " + record["origin"].get<std::string>());
  events_.push_back(std::move(record));
  count("outcome: " + outcome);
}

std::vector<std::size_t> Oracle::tasks_performed(const Assignment& values,
                                                 std::size_t behavior) const {
  std::vector<std::size_t> result;
  for (std::size_t task = 0; task < values.size(); ++task) {
    if (values[task] == behavior) {
      result.push_back(task);
    }
  }
  return result;
}

bool Oracle::is_active(std::size_t behavior) const { return contains(state_.values, behavior); }

const std::string& Oracle::task_name(std::size_t task) const {
  return facts_->catalog.tasks[task].name;
}

const std::string& Oracle::behavior_name(std::size_t behavior) const {
  return facts_->catalog.behaviors[behavior].name;
}

void Oracle::count(const std::string& what) const {
  if (statistics_ != nullptr) {
    statistics_->count(what);
  }
}

void Oracle::count_if(bool holds, const std::string& what) const {
  if (holds) {
    count(what);
  }
}

ordered_json run_oracle(const Catalog& catalog, const Script& script, Statistics* statistics) {
  Oracle oracle(std::make_shared<const CatalogFacts>(catalog), script, statistics);
  for (const Event& event : script.events) {
    oracle.handle(event);
  }
  oracle.finish();
  return oracle.events();
}

}  // namespace cbc::oracle
