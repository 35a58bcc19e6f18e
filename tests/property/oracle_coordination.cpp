// How the oracle solves an event and applies the solution; the queue of reactive tasks.
#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "demand.h"
#include "oracle.h"

namespace cbc::oracle {
namespace {

using nlohmann::ordered_json;

enum class LevelOrder { highest_first, lowest_first };

// The behaviors of one set that are not in another; of one level in catalog order.
std::vector<std::size_t> difference(const CatalogFacts& facts, const std::set<std::size_t>& from,
                                    const std::set<std::size_t>& without, LevelOrder order) {
  std::vector<std::size_t> result;
  std::set_difference(from.begin(), from.end(), without.begin(), without.end(),
                      std::back_inserter(result));
  std::stable_sort(result.begin(), result.end(), [&](std::size_t a, std::size_t b) {
    const std::size_t level_a = facts.level_of[a];
    const std::size_t level_b = facts.level_of[b];
    return order == LevelOrder::highest_first ? level_a > level_b : level_a < level_b;
  });
  return result;
}

// The higher of two priorities; an empty one is the lowest.
std::optional<int> higher(std::optional<int> a, std::optional<int> b) { return a < b ? b : a; }

bool is_failure(Cause cause) {
  return cause != Cause::goal_achieved && cause != Cause::situation_change;
}

}  // namespace

void Oracle::coordinate(ordered_json record, const Trigger& trigger) {
  Transition transition = begin(trigger);
  const bool is_unasked = trigger.reactive && trigger.priority == 0;
  const bool anew = trigger.verb == Verb::reconsider;
  std::optional<Solution> solution = solve_at_some_level(transition);
  while (solution) {
    if (is_unasked && makes_worse(transition, solution->values)) {
      count("reactive start: would make worse what was asked for");
      solution.reset();
      break;
    }
    if (anew && transition.changes.empty() && !improves(solution->values)) {
      count("reconsidered: nothing better");
      --event_number_;
      return;
    }
    const std::optional<std::size_t> failed = apply(transition, solution->values);
    if (!failed) {
      break;
    }
    transition.excluded.insert(*failed);
    remember_failure(*failed);
    solution = solve_at_some_level(transition);
  }
  std::set<std::size_t> differing = find_differing(transition, solution);
  const std::string outcome = solution ? "accepted" : "rejected";
  if (trigger.verb == Verb::finish) {
    const int depth = transition.level - transition.first_level;
    count("escalation: " + (depth < 3 ? std::to_string(depth) : std::string("3 or more")));
  }
  count_if(anew, "reconsidered: " + outcome);
  if (trigger.reactive) {
    count("reactive start: " + outcome);
    count_if(trigger.priority > 0, "reactive start with a priority: " + outcome);
    count_if(solution && waiting_.contains(trigger.subject), "waiting: until it starts");
  }

  ordered_json stopped = ordered_json::array();
  ordered_json objectives;
  if (solution) {
    for (const std::size_t task : stopped_tasks(solution->values)) {
      const bool own = contains(transition.finished_tasks, task);
      const bool asked = trigger.verb == Verb::stop && trigger.subject == task;
      const std::optional<Request>& request = state_.requests[task];
      ordered_json entry = {{"task", task_name(task)},
                            {"cause", own       ? std::string(to_string(trigger.cause))
                                      : asked   ? "requested"
                                      : request ? "displaced"
                                                : "released"}};
      if (request && request->priority > 0) {
        entry["conflict"] = ordered_json::array();
      }
      stopped.push_back(std::move(entry));
    }
    objectives = objective(transition, *solution);
    if (keeps_answers_) {
      answers_[record["index"]] = {
          trigger,    problem(transition),       *solution,           state_,          own_,
          variables_, transition.finished_tasks, transition.excluded, transition.level};
    }
    commit(transition, solution->values);
    if (keeps_answers_) {
      Answer& answer = answers_.at(record["index"]);
      answer.after = state_;
      answer.queued = queued_tasks(transition.group);
    }
  } else {
    roll_back(transition);
    for (const std::size_t behavior : transition.lost) {
      remember_failure(behavior);
    }
    if (!transition.changes.empty()) {
      count("rejected and taken back");
    }
    if (trigger.reactive) {
      const bool waited = waiting_.contains(trigger.subject);
      const bool tried = !transition.changes.empty();
      if (is_unasked || !tried) {
        waiting_.insert(trigger.subject);
      } else {
        waiting_.erase(trigger.subject);
      }
      if (waited && !tried) {
        count("waiting: silent attempt");
        --event_number_;
        return;
      }
      count_if(waited, "waiting: an attempt with a failed activation");
    }
  }
  for (const std::size_t behavior : forgiven_) {
    if (!is_active(behavior)) {
      failed_.insert(behavior);
    }
  }
  forgiven_.clear();

  if (!differing.empty()) differing_[record["index"]] = std::move(differing);
  record["outcome"] = outcome;
  record["changes"] = transition.changes;
  record["stopped_tasks"] = std::move(stopped);
  record["objective"] = std::move(objectives);
  record["search"] = {{"status", solution ? "optimal" : "infeasible"},
                      {"group", transition.group},
                      {"space", transition.space.str()},
                      {"protection", transition.level}};
  complete(std::move(record), outcome);

  for (const std::size_t behavior : transition.lost) {
    run_finish("fault", behavior, Cause::process_failure);
  }
}

void Oracle::compare_with(std::vector<CatalogFacts> variants) {
  for (CatalogFacts& facts : variants) {
    variants_.push_back(std::make_shared<const CatalogFacts>(std::move(facts)));
  }
}

std::set<std::size_t> Oracle::find_differing(const Transition& transition,
                                             const std::optional<Solution>& solution) const {
  std::set<std::size_t> found;
  if (variants_.empty()) return found;
  Oracle other(*this);
  other.statistics_ = nullptr;
  for (std::size_t place = 0; place < variants_.size(); ++place) {
    other.facts_ = variants_[place];
    Transition again = transition;
    const std::optional<Solution> answer = other.solve_at_some_level(again);
    const bool is_same = answer.has_value() == solution.has_value() &&
                         (!answer || answer->values == solution->values);
    if (!is_same) found.insert(place);
  }
  if (!solution && transition.trigger.verb == Verb::start) {
    Transition unprotected = transition;
    unprotected.level = std::numeric_limits<int>::max();
    if (solve(*facts_, problem(unprotected), nullptr)) found.insert(none);
  }
  return found;
}

Oracle::Transition Oracle::begin(const Trigger& trigger) const {
  Transition transition;
  transition.trigger = trigger;
  transition.active_before = active_behaviors(state_.values);
  transition.tasks_of.resize(facts_->catalog.behaviors.size());
  for (const std::size_t behavior : transition.active_before) {
    transition.tasks_of[behavior] = tasks_performed(state_.values, behavior);
  }
  if (trigger.verb == Verb::finish) {
    transition.finished_tasks = transition.tasks_of[trigger.subject];
    transition.active_before.erase(trigger.subject);
    transition.group = facts_->group_of_behavior(trigger.subject);
    for (const std::size_t task : transition.finished_tasks) {
      const std::optional<Request>& request = state_.requests[task];
      transition.first_level = std::max(transition.first_level, request ? request->priority : 0);
    }
    if (is_failure(trigger.cause)) {
      transition.excluded.insert(trigger.subject);
    }
  } else if (trigger.verb == Verb::reconsider) {
    transition.group = trigger.subject;
  } else {
    transition.group = facts_->group_of[trigger.subject];
    transition.first_level = trigger.priority;
  }
  transition.active = transition.active_before;
  return transition;
}

// A finish always finds a solution, as in the end nothing is protected.
std::optional<Solution> Oracle::solve_at_some_level(Transition& transition) const {
  transition.level = transition.first_level;
  while (true) {
    const Problem to_solve = problem(transition);
    transition.space = search_space(to_solve);
    std::optional<Solution> solution = solve(*facts_, to_solve, statistics_);
    if (solution || transition.trigger.verb != Verb::finish) {
      return solution;
    }
    ++transition.level;
  }
}

Problem Oracle::problem(const Transition& transition) const {
  Problem result;
  result.group = transition.group;
  result.before = state_.values;
  for (const std::size_t task : facts_->groups[transition.group]) {
    result.domains.push_back(domain(transition, task));
  }
  for (const ActiveRequest& request : active_requests(transition)) {
    if (facts_->group_of[request.task] == transition.group) {
      (request.priority == 0 ? result.unasked : result.requests).push_back(request);
    }
  }
  for (const ActiveRequest& request : suspended_requests(transition)) {
    if (facts_->group_of[request.task] == transition.group) {
      result.suspended.push_back(request);
    }
  }
  sort_requests(result.requests);
  sort_requests(result.suspended);
  sort_requests(result.unasked);
  for (const std::size_t behavior : transition.active_before) {
    if (facts_->group_of_behavior(behavior) == transition.group) {
      result.active.insert(behavior);
    }
  }
  return result;
}

std::vector<std::size_t> Oracle::domain(const Transition& transition, std::size_t task) const {
  const Trigger& trigger = transition.trigger;
  std::vector<std::size_t> values = selectable(transition, task);
  if (trigger.verb == Verb::start && task == trigger.subject) {
    return values;
  }
  if (trigger.verb == Verb::stop && task == trigger.subject) {
    return {none};
  }
  if (contains(transition.finished_tasks, task)) {
    if (trigger.cause == Cause::goal_achieved) {
      return {none};
    }
    values.push_back(none);
    return values;
  }
  const bool is_unasked = trigger.reactive && trigger.priority == 0;
  const bool waits = state_.suspended[task] && !is_unasked;
  if (facts_->catalog.tasks[task].start_on_request && state_.values[task] == none && !waits) {
    return {none};
  }
  if (!is_protected(transition, task)) {
    values.push_back(none);
  }
  return values;
}

// S(x), without the excluded behaviors.
std::vector<std::size_t> Oracle::selectable(const Transition& transition, std::size_t task) const {
  const bool finished = contains(transition.finished_tasks, task);
  std::vector<std::size_t> result;
  for (const std::size_t behavior : facts_->behaviors_of[task]) {
    const bool keeps_it = behavior == state_.values[task] && !finished;
    const bool is_better =
        state_.values[task] != none &&
        facts_->suitability(behavior, task) > facts_->suitability(state_.values[task], task);
    if (is_better && may_not_improve(transition, task)) {
      continue;
    }
    if ((available(behavior) || (keeps_it && fits(behavior))) &&
        !transition.excluded.contains(behavior)) {
      result.push_back(behavior);
    }
  }
  return result;
}

// Of a running task.
bool Oracle::may_not_improve(const Transition& transition, std::size_t task) const {
  const Trigger& trigger = transition.trigger;
  const std::vector<Task>& tasks = facts_->catalog.tasks;
  const bool is_started =
      trigger.verb == Verb::start && !trigger.reactive && task == trigger.subject;
  if (tasks[task].improve == Improve::when_started && !is_started) {
    return true;
  }
  if (trigger.verb != Verb::reconsider || tasks[task].improve == Improve::at_once) {
    return false;
  }
  for (const std::size_t other : facts_->groups[transition.group]) {
    const bool matters = state_.suspended[other] ||
                         (state_.values[other] != none && tasks[other].improve == Improve::at_once);
    if (matters && may_need(other).contains(task)) {
      return false;
    }
  }
  return true;
}

bool Oracle::is_protected(const Transition& transition, std::size_t task) const {
  const std::optional<Request>& request = state_.requests[task];
  if (!request) {
    return false;
  }
  if (transition.trigger.reactive) {
    return request->priority >= transition.trigger.priority;
  }
  if (transition.trigger.verb == Verb::reconsider) {
    return request->priority >= 1;
  }
  return request->priority > transition.level;
}

// Whether what was asked for would run worse than now.
bool Oracle::makes_worse(const Transition& transition, const Assignment& values) const {
  const Problem solved = problem(transition);
  return asked_product(*facts_, solved, values) < asked_product(*facts_, solved, state_.values);
}

// Of the whole catalog. A start of the task takes the place of its request.
std::vector<ActiveRequest> Oracle::suspended_requests(const Transition& transition) const {
  const Trigger& trigger = transition.trigger;
  std::vector<ActiveRequest> result;
  if (trigger.reactive && trigger.priority == 0) {
    return result;
  }
  for (std::size_t task = 0; task < state_.suspended.size(); ++task) {
    const std::optional<Request>& request = state_.suspended[task];
    const bool is_started = trigger.verb == Verb::start && task == trigger.subject;
    if (request && !is_started) {
      result.push_back({task, request->priority, request->set_by});
    }
  }
  return result;
}

// Of the whole catalog: those of running tasks, the new one included, one stopped or done excluded.
std::vector<ActiveRequest> Oracle::active_requests(const Transition& transition) const {
  const Trigger& trigger = transition.trigger;
  const bool success = trigger.cause == Cause::goal_achieved;
  std::vector<ActiveRequest> result;
  for (std::size_t task = 0; task < state_.requests.size(); ++task) {
    const std::optional<Request>& request = state_.requests[task];
    if (trigger.verb == Verb::start && task == trigger.subject) {
      result.push_back({task, trigger.priority, event_number_});
      continue;
    }
    const bool stopped = trigger.verb == Verb::stop && task == trigger.subject;
    const bool done = success && contains(transition.finished_tasks, task);
    if (request && !stopped && !done) {
      result.push_back({task, request->priority, request->set_by});
    }
  }
  return result;
}

// Applying a solution

std::optional<std::size_t> Oracle::apply(Transition& transition, const Assignment& values) {
  const std::set<std::size_t> target = active_behaviors(values);
  const bool restart = restarts(transition, values);
  const std::size_t restarted = restart ? values[transition.trigger.subject] : none;

  for (const std::size_t behavior :
       difference(*facts_, transition.active, target, LevelOrder::highest_first)) {
    const std::vector<std::size_t>& tasks = transition.tasks_of[behavior];
    if (!transition.active_before.contains(behavior)) {
      deactivate(transition, behavior, "undone", std::nullopt);
    } else {
      deactivate(transition, behavior, deactivation_cause(transition, values, tasks),
                 priority_before(tasks));
    }
  }
  for (const std::size_t behavior :
       difference(*facts_, target, transition.active, LevelOrder::lowest_first)) {
    if (behavior == restarted) {
      continue;
    }
    const std::vector<std::size_t> tasks = tasks_performed(values, behavior);
    const std::optional<int> priority = priority_after(transition, tasks);
    const char* cause = activation_cause(transition, tasks);
    const bool undone = transition.active_before.contains(behavior);
    if (!activate(transition, behavior, tasks, undone ? "undone" : cause,
                  undone ? std::nullopt : priority)) {
      return behavior;
    }
  }
  if (restart) {
    if (transition.active.contains(restarted)) {
      deactivate(transition, restarted, "restarted",
                 priority_before(transition.tasks_of[restarted]));
    }
    const std::vector<std::size_t> tasks = tasks_performed(values, restarted);
    if (!activate(transition, restarted, tasks, "restarted", priority_after(transition, tasks))) {
      return restarted;
    }
  }
  return std::nullopt;
}

// The cause of the deactivation of a behavior that performed these tasks.
const char* Oracle::deactivation_cause(const Transition& transition, const Assignment& values,
                                       const std::vector<std::size_t>& tasks) const {
  const Trigger& trigger = transition.trigger;
  if (trigger.verb == Verb::stop && contains(tasks, trigger.subject)) {
    return "requested";
  }
  const bool goes_on = std::any_of(tasks.begin(), tasks.end(),
                                   [&](std::size_t task) { return values[task] != none; });
  if (goes_on) {
    return "replaced";
  }
  return priority_before(tasks) ? "displaced" : "released";
}

// The cause of an activation for these tasks.
const char* Oracle::activation_cause(const Transition& transition,
                                     const std::vector<std::size_t>& tasks) const {
  const Trigger& trigger = transition.trigger;
  bool is_resumed = false;
  bool is_reactive = false;
  for (const std::size_t task : tasks) {
    const bool is_started = trigger.verb == Verb::start && task == trigger.subject;
    if (is_started) {
      if (!trigger.reactive) {
        return "requested";
      }
      is_reactive = true;
    } else if (state_.suspended[task]) {
      is_resumed = true;
    } else if (state_.requests[task]) {
      if (state_.requests[task]->priority >= 1) {
        return "requested";
      }
      is_reactive = true;
    }
  }
  return is_resumed ? "resumed" : is_reactive ? "reactive" : "required";
}

std::optional<int> Oracle::priority_before(const std::vector<std::size_t>& tasks) const {
  std::optional<int> priority;
  for (const std::size_t task : tasks) {
    if (const std::optional<Request>& request = state_.requests[task]) {
      priority = higher(priority, request->priority);
    }
  }
  return priority;
}

std::optional<int> Oracle::priority_after(const Transition& transition,
                                          const std::vector<std::size_t>& tasks) const {
  std::optional<int> priority;
  for (const ActiveRequest& request : active_requests(transition)) {
    if (contains(tasks, request.task)) {
      priority = higher(priority, request.priority);
    }
  }
  for (const std::size_t task : tasks) {
    const bool is_started =
        transition.trigger.verb == Verb::start && task == transition.trigger.subject;
    if (state_.suspended[task] && !is_started) {
      priority = higher(priority, state_.suspended[task]->priority);
    }
  }
  return priority;
}

// Returns to what was active before the event, as far as that can be activated.
void Oracle::roll_back(Transition& transition) {
  const std::set<std::size_t>& before = transition.active_before;
  for (const std::size_t behavior :
       difference(*facts_, transition.active, before, LevelOrder::highest_first)) {
    deactivate(transition, behavior, "undone", std::nullopt);
  }
  for (const std::size_t behavior :
       difference(*facts_, before, transition.active, LevelOrder::lowest_first)) {
    if (!activate(transition, behavior, tasks_performed(state_.values, behavior), "undone",
                  std::nullopt)) {
      transition.lost.push_back(behavior);
    }
  }
  std::sort(transition.lost.begin(), transition.lost.end());
}

void Oracle::deactivate(Transition& transition, std::size_t behavior, const std::string& cause,
                        std::optional<int> priority) {
  add_change(transition, "deactivate", behavior, transition.tasks_of[behavior], cause, priority,
             true);
  transition.active.erase(behavior);
}

// False if the activation fails.
bool Oracle::activate(Transition& transition, std::size_t behavior,
                      const std::vector<std::size_t>& tasks, const std::string& cause,
                      std::optional<int> priority) {
  const bool success = !faulty(behavior);
  add_change(transition, "activate", behavior, tasks, cause, priority, success);
  if (!success) {
    count("activation failed: " + cause);
    return false;
  }
  if (tasks.size() >= 2) {
    count("activated for two or more tasks");
    count("activated for two or more tasks: " + cause);
  }
  transition.active.insert(behavior);
  transition.tasks_of[behavior] = tasks;
  activated_at_[behavior] = now_;
  return true;
}

void Oracle::add_change(Transition& transition, const std::string& operation, std::size_t behavior,
                        const std::vector<std::size_t>& tasks, const std::string& cause,
                        std::optional<int> priority, bool success) const {
  ordered_json names = ordered_json::array();
  for (const std::size_t task : tasks) {
    names.push_back(task_name(task));
  }
  ordered_json change;
  change["op"] = operation;
  change["behavior"] = behavior_name(behavior);
  change["tasks"] = std::move(names);
  change["cause"] = cause;
  change["priority"] = priority ? ordered_json(*priority) : ordered_json();
  change["success"] = success;
  transition.changes.push_back(std::move(change));
  count(operation + ": " + cause);
}

// Whether the started task keeps its behavior, with other parameters.
bool Oracle::restarts(const Transition& transition, const Assignment& values) const {
  const Trigger& trigger = transition.trigger;
  if (trigger.verb != Verb::start || !trigger.parameters) {
    return false;
  }
  const std::size_t before = state_.values[trigger.subject];
  if (before == none || before != values[trigger.subject]) {
    return false;
  }
  const std::optional<Request>& request = state_.requests[trigger.subject];
  return !same_parameters(*trigger.parameters, request ? request->parameters : Parameters());
}

std::vector<std::size_t> Oracle::stopped_tasks(const Assignment& values) const {
  std::vector<std::size_t> result;
  for (std::size_t task = 0; task < values.size(); ++task) {
    if (state_.values[task] != none && values[task] == none) {
      result.push_back(task);
    }
  }
  return result;
}

void Oracle::commit(const Transition& transition, const Assignment& values) {
  const Trigger& trigger = transition.trigger;
  const Assignment before = state_.values;
  state_.values = values;
  if (trigger.verb == Verb::start) {
    std::optional<Request>& request = state_.requests[trigger.subject];
    std::optional<Request>& waiting = state_.suspended[trigger.subject];
    Parameters parameters = request   ? request->parameters
                            : waiting ? waiting->parameters
                                      : Parameters();
    if (trigger.parameters) {
      parameters = *trigger.parameters;
    }
    request = Request{trigger.priority, std::move(parameters), event_number_};
    waiting.reset();
  }
  for (std::size_t task = 0; task < values.size(); ++task) {
    std::optional<Request>& request = state_.requests[task];
    if (values[task] == none) {
      const bool own_end =
          contains(transition.finished_tasks, task) && trigger.cause != Cause::situation_change;
      if (request && facts_->catalog.tasks[task].resume && trigger.verb != Verb::stop && !own_end) {
        count("suspended");
        state_.suspended[task] = request;
      }
      request.reset();
      continue;
    }
    if (state_.suspended[task]) {
      count("resumed");
      request = state_.suspended[task];
      state_.suspended[task].reset();
    }
    if (values[task] != before[task]) {
      taken_at_[task] = now_;
    }
  }
  update_queue(transition, before);
}

// The stops count before the starts.
void Oracle::update_queue(const Transition& transition, const Assignment& before) {
  const Trigger& trigger = transition.trigger;
  for (std::size_t task = 0; task < before.size(); ++task) {
    if (before[task] == none || state_.values[task] != none) {
      continue;
    }
    for (const std::size_t list : facts_->lists_of[task]) {
      for (const std::size_t other : facts_->catalog.exclusivity[list]) {
        if (other != task) {
          join_queue(other);
        }
      }
    }
    const bool own_stop = trigger.verb == Verb::stop && task == trigger.subject;
    const bool own_finish = contains(transition.finished_tasks, task);
    const bool fits_no_more = trigger.cause == Cause::situation_change;
    if (!own_stop && (!own_finish || fits_no_more)) {
      join_queue(task);
      count_if(own_finish && facts_->catalog.tasks[task].reactive_start,
               "reactive task stopped by a situation change of its own");
    }
  }
  for (std::size_t task = 0; task < before.size(); ++task) {
    if (before[task] == none && state_.values[task] != none) {
      queue_[task].reset();
      for (const std::size_t list : facts_->lists_of[task]) {
        for (const std::size_t other : facts_->catalog.exclusivity[list]) {
          if (other != task && counts_against(other, task) && is_blocked_by(other, list)) {
            queue_[other].reset();
          }
        }
      }
    }
  }
  update_waiting(transition.group);
}

// After an accepted event of the group.
void Oracle::update_waiting(std::size_t group) {
  for (const std::size_t task : facts_->groups[group]) {
    if (!waiting_.contains(task)) {
      continue;
    }
    if (state_.values[task] != none) {
      waiting_.erase(task);
    } else if (is_blocked(task)) {
      count("waiting: until an exclusive task starts");
      waiting_.erase(task);
    } else {
      count_if(!queue_[task], "waiting: joins the queue again");
      join_queue(task);
    }
  }
}

std::map<std::size_t, bool> Oracle::queued_tasks(std::size_t group) const {
  std::map<std::size_t, bool> result;
  for (const std::size_t task : facts_->groups[group]) {
    if (queue_[task]) {
      Trigger trigger;
      trigger.verb = Verb::start;
      trigger.subject = task;
      trigger.reactive = true;
      trigger.priority = facts_->catalog.tasks[task].reactive_priority;
      result[task] = solve(*facts_, problem(begin(trigger)), nullptr).has_value();
    }
  }
  return result;
}

// A reactive task that is neither running nor in Q joins it.
void Oracle::join_queue(std::size_t task) {
  if (facts_->catalog.tasks[task].reactive_start && state_.values[task] == none && !queue_[task]) {
    queue_[task] = now_ + reactive_delay_;
  }
}

void Oracle::join_queue_by_group(std::size_t group) {
  for (const std::size_t task : facts_->groups[group]) {
    join_queue(task);
  }
}

}  // namespace cbc::oracle
