#include "plain_model.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "cbc/event.h"
#include "demand.h"
#include "runtime/coordinator/record.h"

namespace cbc::plain {

using oracle::contains;
using oracle::demand;

namespace {

class FirstOutcome final : public EventListener {
 public:
  void on_event(const EventRecord& record) override {
    demand(record.origin != Origin::timeout, "a timeout fired");
    if (!outcome && record.origin == Origin::script && form_of(record.verb).is_decided) {
      outcome = record.outcome;
    }
    if (model != nullptr) {
      happenings->push_back(
          happening_of(model->catalog(), record, coordinator->state(), model->tasks()));
    }
  }

  std::optional<Outcome> outcome;
  // For the happenings; null: none are wanted.
  const PlainModel* model = nullptr;
  const Coordinator* coordinator = nullptr;
  std::vector<Happening>* happenings = nullptr;
};

CoordinatorOptions plain_options() {
  CoordinatorOptions options;
  options.reactive_delay = reactive_delay;
  return options;
}

template <typename Item>
void erase_value(std::vector<Item>& items, const Item& item) {
  items.erase(std::remove(items.begin(), items.end(), item), items.end());
}

/// Makes own(b) what it says.
void set_own(Snapshot& state, BehaviorId behavior, bool available) {
  erase_value(state.denied, behavior);
  if (!available) state.denied.push_back(behavior);
}

bool agrees(const SituationPart& part, const Snapshot& state) {
  return std::all_of(part.variables.begin(), part.variables.end(),
                     [&](const VariableValue& entry) {
                       return state.variables[entry.variable] == entry.value;
                     }) &&
         std::all_of(part.behaviors.begin(), part.behaviors.end(),
                     [&](const SituationPart::Own& entry) {
                       return contains(state.denied, entry.behavior) != entry.available;
                     });
}

BehaviorId behavior_of(const CompiledCatalog& catalog, const Snapshot::RunningTask& entry) {
  return catalog.values[entry.task][entry.value_index].behavior;
}

}  // namespace

const Snapshot::RunningTask* find_running(const Snapshot& state, TaskId task) {
  const auto found =
      std::find_if(state.running.begin(), state.running.end(),
                   [task](const Snapshot::RunningTask& entry) { return entry.task == task; });
  return found == state.running.end() ? nullptr : &*found;
}

const Request* find_request(const Snapshot& state, TaskId task) {
  const Snapshot::RunningTask* const entry = find_running(state, task);
  if (entry != nullptr) return entry->request ? &*entry->request : nullptr;
  for (const auto& [other, request] : state.suspended) {
    if (other == task) return &request;
  }
  return nullptr;
}

bool has_failed(const Snapshot& state, BehaviorId behavior) {
  return std::any_of(state.failed.begin(), state.failed.end(),
                     [behavior](const auto& entry) { return entry.first == behavior; });
}

bool is_active(const Snapshot& state, BehaviorId behavior) {
  return std::any_of(state.active.begin(), state.active.end(),
                     [behavior](const auto& entry) { return entry.first == behavior; });
}

std::vector<std::vector<VariableValue>> combinations_of(
    const CompiledCatalog& catalog, const std::vector<std::uint32_t>& variables) {
  std::vector<std::vector<VariableValue>> all(1);
  for (const std::uint32_t variable : variables) {
    std::vector<std::vector<VariableValue>> longer;
    for (const auto& values : all) {
      for (std::uint32_t value = 0; value < catalog.variables[variable].value_count; ++value) {
        longer.push_back(values);
        longer.back().push_back({variable, value});
      }
    }
    all = std::move(longer);
  }
  return all;
}

void handle_move(const CompiledCatalog& catalog, const Assumptions& assumptions, const Move& move,
                 Coordinator& coordinator) {
  Event event;
  event.subject = move.subject;
  const Availability own{move.subject, move.choice != 0};
  const VariableValue value{move.subject, static_cast<std::uint32_t>(move.choice)};
  std::vector<VariableValue> values;
  switch (move.kind) {
    case Move::Kind::start:
      event.verb = Verb::start;
      event.priority = move.choice;
      break;
    case Move::Kind::stop:
      event.verb = Verb::stop;
      break;
    case Move::Kind::success:
    case Move::Kind::failure:
    case Move::Kind::situation_change:
      event.verb = Verb::finish;
      event.cause = move.kind == Move::Kind::success   ? FinishCause::goal_achieved
                    : move.kind == Move::Kind::failure ? FinishCause::process_failure
                                                       : FinishCause::situation_change;
      demand(coordinator.state().is_active(catalog.behavior_ids[move.subject]),
             "a behavior finishes that is not active");
      break;
    case Move::Kind::fault:
      event.verb = Verb::fault;
      break;
    case Move::Kind::repair:
      event.verb = Verb::repair;
      break;
    case Move::Kind::variable:
      event.verb = Verb::situation;
      event.variables = std::span(&value, 1);
      break;
    case Move::Kind::own:
      event.verb = Verb::situation;
      event.situation = std::span(&own, 1);
      break;
    case Move::Kind::together:
      values = combinations_of(catalog, assumptions.together.at(move.subject))
                   .at(static_cast<std::size_t>(move.choice));
      event.verb = Verb::situation;
      event.variables = values;
      break;
    case Move::Kind::due:
      demand(coordinator.next_due() == coordinator.now(), "nothing is due");
      demand(coordinator.settle() == Coordinator::Status::ok, coordinator.internal_error());
      return;
  }
  demand(coordinator.handle(event) == Coordinator::Status::ok, coordinator.internal_error());
}

PlainModel::PlainModel(const CompiledCatalog& catalog, std::vector<GroupId> groups,
                       const Assumptions& assumptions, const std::set<std::uint32_t>& variables)
    : catalog_(catalog),
      assumptions_(assumptions),
      groups_(std::move(groups)),
      variables_(variables.begin(), variables.end()) {
  for (const TaskId task : catalog.task_ids) {
    if (has_group(catalog.tasks[task].group)) tasks_.push_back(task);
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (!has_group(catalog.group_of(behavior))) continue;
    behaviors_.push_back(behavior);
    if (contains(assumptions.behaviors, behavior)) own_.push_back(behavior);
    for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
      if (!contains(variables_, fitting.variable)) variables_.push_back(fitting.variable);
    }
  }
  while (add_tied()) {
  }
  std::sort(variables_.begin(), variables_.end());
  const auto index_of = [&](BehaviorId behavior) {
    return catalog.behaviors[behavior].catalog_index;
  };
  std::sort(own_.begin(), own_.end(),
            [&](BehaviorId a, BehaviorId b) { return index_of(a) < index_of(b); });
  const auto is_known = [&](const SituationPart& part) {
    return std::all_of(part.variables.begin(), part.variables.end(),
                       [&](const VariableValue& entry) {
                         return contains(variables_, entry.variable) ||
                                !contains(assumptions.variables, entry.variable);
                       }) &&
           std::all_of(part.behaviors.begin(), part.behaviors.end(),
                       [&](const SituationPart::Own& entry) {
                         return contains(own_, entry.behavior) ||
                                !contains(assumptions.behaviors, entry.behavior);
                       });
  };
  std::copy_if(assumptions.never.begin(), assumptions.never.end(), std::back_inserter(never_),
               is_known);
}

/// Adds what an entry of `never` names together with something in the state. False: nothing is new.
bool PlainModel::add_tied() {
  const std::size_t before = variables_.size() + own_.size();
  for (const SituationPart& part : assumptions_.never) {
    const bool is_about_state =
        std::any_of(
            part.variables.begin(), part.variables.end(),
            [&](const VariableValue& entry) { return contains(variables_, entry.variable); }) ||
        std::any_of(
            part.behaviors.begin(), part.behaviors.end(),
            [&](const SituationPart::Own& entry) { return contains(own_, entry.behavior); });
    if (!is_about_state) continue;
    for (const VariableValue& entry : part.variables) {
      if (!contains(variables_, entry.variable)) variables_.push_back(entry.variable);
    }
    for (const SituationPart::Own& entry : part.behaviors) {
      if (contains(own_, entry.behavior) || !contains(assumptions_.behaviors, entry.behavior)) {
        continue;
      }
      own_.push_back(entry.behavior);
    }
  }
  return variables_.size() + own_.size() > before;
}

bool PlainModel::has_group(GroupId group) const { return contains(groups_, group); }

Snapshot PlainModel::first_state() const {
  std::vector<Availability> own;
  for (const SituationPart::Own& entry : assumptions_.initially.behaviors) {
    own.push_back({catalog_.behaviors[entry.behavior].catalog_index, entry.available});
  }
  FirstOutcome listener;
  Coordinator coordinator(catalog_, plain_options(), listener);
  coordinator.begin(own, assumptions_.initially.variables);
  return as_state(coordinator.snapshot());
}

bool PlainModel::is_excluded(const Snapshot& state) const {
  return std::any_of(never_.begin(), never_.end(),
                     [&](const SituationPart& part) { return agrees(part, state); });
}

std::vector<Move> PlainModel::moves(const Snapshot& state) const {
  std::vector<Move> moves;
  add_starts(state, moves);
  add_finishes(state, moves);
  add_faults(state, moves);
  add_situations(state, moves);
  if (!state.queue.empty()) moves.push_back({Move::Kind::due, 0, 0});
  return moves;
}

void PlainModel::add_starts(const Snapshot& state, std::vector<Move>& moves) const {
  for (const TaskId task : tasks_) {
    for (const Assumptions::Start& start : assumptions_.start) {
      if (start.task != task) continue;
      for (const std::int32_t priority : start.priorities) {
        moves.push_back({Move::Kind::start, catalog_.tasks[task].catalog_index, priority});
      }
    }
  }
  for (const TaskId task : tasks_) {
    if (!contains(assumptions_.stop, task) || find_request(state, task) == nullptr) continue;
    moves.push_back({Move::Kind::stop, catalog_.tasks[task].catalog_index, 0});
  }
}

void PlainModel::add_finishes(const Snapshot& state, std::vector<Move>& moves) const {
  const auto may_succeed = [&](BehaviorId behavior) {
    return std::all_of(state.running.begin(), state.running.end(),
                       [&](const Snapshot::RunningTask& entry) {
                         return behavior_of(catalog_, entry) != behavior ||
                                catalog_.tasks[entry.task].keep_running == 0;
                       });
  };
  const auto add = [&](Move::Kind kind, auto&& may_finish) {
    for (const BehaviorId behavior : behaviors_) {
      if (!is_active(state, behavior) || !may_finish(behavior)) continue;
      moves.push_back({kind, catalog_.behaviors[behavior].catalog_index, 0});
    }
  };
  if (assumptions_.successes) add(Move::Kind::success, may_succeed);
  const bool has_room =
      !assumptions_.most_failed || state.failed.size() < *assumptions_.most_failed;
  if (assumptions_.failures) {
    add(Move::Kind::failure, [&](BehaviorId behavior) {
      return has_room || catalog_.retry_of(behavior) == Retry::at_events;
    });
  }
  add(Move::Kind::situation_change,
      [&](BehaviorId behavior) { return contains(state.denied, behavior); });
}

void PlainModel::add_faults(const Snapshot& state, std::vector<Move>& moves) const {
  for (const BehaviorId behavior : behaviors_) {
    if (contains(state.faulty, behavior) || state.faulty.size() >= assumptions_.faults) continue;
    const bool is_listed = contains(assumptions_.listed_for_faults, behavior);
    if (is_listed != assumptions_.only_listed_fail) continue;
    moves.push_back({Move::Kind::fault, catalog_.behaviors[behavior].catalog_index, 0});
  }
  for (const BehaviorId behavior : behaviors_) {
    if (!contains(state.faulty, behavior) && !has_failed(state, behavior)) continue;
    moves.push_back({Move::Kind::repair, catalog_.behaviors[behavior].catalog_index, 0});
  }
}

void PlainModel::add_situations(const Snapshot& state, std::vector<Move>& moves) const {
  for (const std::uint32_t variable : variables_) {
    if (!contains(assumptions_.variables, variable)) continue;
    for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
      if (value == state.variables[variable]) continue;
      Snapshot next = state;
      next.variables[variable] = value;
      if (is_excluded(next)) continue;
      moves.push_back({Move::Kind::variable, variable, static_cast<std::int32_t>(value)});
    }
  }
  for (const BehaviorId behavior : own_) {
    const bool available = contains(state.denied, behavior);
    Snapshot next = state;
    set_own(next, behavior, available);
    if (is_excluded(next)) continue;
    moves.push_back(
        {Move::Kind::own, catalog_.behaviors[behavior].catalog_index, available ? 1 : 0});
  }
  for (std::uint32_t list = 0; list < assumptions_.together.size(); ++list) {
    const auto all = combinations_of(catalog_, assumptions_.together[list]);
    for (std::size_t number = 0; number < all.size(); ++number) {
      if (!may_change_to(state, all[number])) continue;
      moves.push_back({Move::Kind::together, list, static_cast<std::int32_t>(number)});
    }
  }
}

/// Whether these values, and no fewer than two of the state, are others, and may be.
bool PlainModel::may_change_to(const Snapshot& state,
                               const std::vector<VariableValue>& values) const {
  Snapshot next = state;
  std::size_t changes = 0;
  for (const VariableValue& value : values) {
    if (state.variables[value.variable] == value.value) continue;
    if (!contains(variables_, value.variable)) return false;
    if (!contains(assumptions_.variables, value.variable)) return false;
    next.variables[value.variable] = value.value;
    ++changes;
  }
  return changes >= 2 && !is_excluded(next);
}

Step PlainModel::step(const Snapshot& state, const Move& move,
                      std::vector<Happening>* happenings) const {
  FirstOutcome listener;
  Coordinator coordinator(catalog_, plain_options(), listener);
  coordinator.resume(state);
  if (happenings != nullptr) {
    listener.model = this;
    listener.coordinator = &coordinator;
    listener.happenings = happenings;
  }
  if (move.kind == Move::Kind::due) {
    // Nothing is due before the first set, which is due then.
    demand(coordinator.advance_to(1) == Coordinator::Status::ok, coordinator.internal_error());
  }
  handle_move(catalog_, assumptions_, move, coordinator);
  const Snapshot saved = coordinator.snapshot();
  Step step;
  step.next = as_state(saved);
  step.exists =
      !assumptions_.most_suspended || step.next.suspended.size() <= *assumptions_.most_suspended;
  step.outcome = listener.outcome;
  for (const std::vector<TaskId>& set : sets_of_queue(step.next)) {
    const auto entry = std::find_if(saved.queue.begin(), saved.queue.end(),
                                    [&](const auto& one) { return one.first == set.front(); });
    if (entry->second < reactive_delay) {
      step.old_place.emplace_back(static_cast<std::size_t>(entry->second - 1));
    } else {
      step.old_place.emplace_back();
    }
  }
  return step;
}

VisibleState PlainModel::visible(const Snapshot& state) const {
  State restored(catalog_);
  restored.restore(state);
  return visible_part(catalog_, restored, tasks_);
}

Snapshot PlainModel::as_state(Snapshot saved) const {
  const auto is_foreign = [&](TaskId task) { return !has_group(catalog_.tasks[task].group); };
  erase_if(saved.queue, [&](const auto& entry) { return is_foreign(entry.first); });
  erase_if(saved.waiting, is_foreign);
  erase_if(saved.suspended, [&](const auto& entry) { return is_foreign(entry.first); });
  erase_if(saved.failed,
           [&](const auto& entry) { return !has_group(catalog_.group_of(entry.first)); });
  std::vector<Snapshot::RunningTask> running;
  std::vector<std::pair<BehaviorId, Microseconds>> active;
  for (Snapshot::RunningTask& entry : saved.running) {
    if (!is_foreign(entry.task)) running.push_back(std::move(entry));
  }
  for (const auto& entry : saved.active) {
    if (has_group(catalog_.group_of(entry.first))) active.push_back(entry);
  }
  saved.running = std::move(running);
  saved.active = std::move(active);

  std::map<std::uint64_t, std::uint64_t> events;
  std::map<Microseconds, Microseconds> times;
  for (const Snapshot::RunningTask& entry : saved.running) {
    if (entry.request) events.emplace(entry.request->event, 0);
  }
  for (const auto& entry : saved.suspended) events.emplace(entry.second.event, 0);
  for (const auto& entry : saved.queue) times.emplace(entry.second, 0);
  saved.events = 0;
  for (auto& entry : events) entry.second = ++saved.events;
  Microseconds time = 0;
  for (auto& entry : times) entry.second = ++time;

  saved.now = 0;
  saved.reactive_delay = reactive_delay;
  for (Snapshot::RunningTask& entry : saved.running) {
    entry.since = 0;
    if (entry.request) entry.request->event = events[entry.request->event];
  }
  for (auto& entry : saved.suspended) entry.second.event = events[entry.second.event];
  for (auto& entry : saved.failed) entry.second = 0;
  for (auto& entry : saved.active) entry.second = 0;
  for (auto& entry : saved.queue) entry.second = times[entry.second];
  return saved;
}

std::vector<std::vector<TaskId>> PlainModel::sets_of_queue(const Snapshot& state) {
  std::map<Microseconds, std::vector<TaskId>> sets;
  for (const auto& [task, due] : state.queue) sets[due].push_back(task);
  std::vector<std::vector<TaskId>> queue;
  for (auto& entry : sets) {
    std::sort(entry.second.begin(), entry.second.end());
    queue.push_back(std::move(entry.second));
  }
  return queue;
}

std::string PlainModel::key(const Snapshot& state) const {
  std::string key;
  const auto add = [&](auto number) { key += std::to_string(number) + ' '; };
  const auto open = [&](const char* part) { key += part; };
  open("values ");
  std::map<std::pair<std::int32_t, std::uint64_t>, TaskId> requests;
  for (const TaskId task : tasks_) {
    const Snapshot::RunningTask* const entry = find_running(state, task);
    entry == nullptr ? open("- ") : add(behavior_of(catalog_, *entry));
    const Request* const request = find_request(state, task);
    if (request != nullptr) requests.emplace(std::pair(request->priority, request->event), task);
  }
  open("requests ");
  for (const auto& [when, task] : requests) {
    add(when.first);
    add(task);
  }
  open("queue ");
  for (const std::vector<TaskId>& set : sets_of_queue(state)) {
    for (const TaskId task : set) add(task);
    open("; ");
  }
  open("waiting ");
  for (const TaskId task : tasks_) {
    if (contains(state.waiting, task)) add(task);
  }
  open("variables ");
  for (const std::uint32_t variable : variables_) add(state.variables[variable]);
  open("denied ");
  for (const BehaviorId behavior : own_) {
    if (contains(state.denied, behavior)) add(behavior);
  }
  open("faulty ");
  for (const BehaviorId behavior : behaviors_) {
    if (contains(state.faulty, behavior)) add(behavior);
  }
  open("failed ");
  for (const BehaviorId behavior : behaviors_) {
    if (has_failed(state, behavior)) add(behavior);
  }
  return key;
}

bool PlainModel::holds(const StateCondition& condition, const Snapshot& state) const {
  using Kind = StateCondition::Kind;
  const auto is_true = [&](const StateCondition& part) { return holds(part, state); };
  const auto& parts = condition.parts;
  switch (condition.kind) {
    case Kind::all:
      return std::all_of(parts.begin(), parts.end(), is_true);
    case Kind::any:
      return std::any_of(parts.begin(), parts.end(), is_true);
    case Kind::negated:
      return !is_true(parts.front());
    case Kind::only_active:
      return std::all_of(parts.begin(), parts.end(), is_true) &&
             std::all_of(state.active.begin(), state.active.end(), [&](const auto& entry) {
               return std::any_of(parts.begin(), parts.end(), [&](const StateCondition& part) {
                 return part.behavior == entry.first;
               });
             });
    case Kind::running: {
      const auto* const entry = find_running(state, condition.task);
      return entry != nullptr && (condition.behaviors.empty() ||
                                  contains(condition.behaviors, behavior_of(catalog_, *entry)));
    }
    case Kind::stopped:
      return find_running(state, condition.task) == nullptr;
    case Kind::active:
      return is_active(state, condition.behavior);
    case Kind::faulty:
      return contains(state.faulty, condition.behavior);
    case Kind::none_faulty:
      return state.faulty.empty();
    case Kind::failed:
      return has_failed(state, condition.behavior);
    case Kind::available:
      return !contains(state.denied, condition.behavior) &&
             !has_failed(state, condition.behavior) &&
             !catalog_.find_misfit(condition.behavior, state.variables);
    case Kind::requested: {
      const Request* const request = find_request(state, condition.task);
      return request != nullptr && request->priority >= condition.priority;
    }
    case Kind::suspended:
      return find_running(state, condition.task) == nullptr &&
             find_request(state, condition.task) != nullptr;
    case Kind::variable:
      return contains(condition.values, state.variables[condition.variable]);
    case Kind::own:
      return contains(state.denied, condition.behavior) != condition.wanted;
  }
  return false;
}

}  // namespace cbc::plain
