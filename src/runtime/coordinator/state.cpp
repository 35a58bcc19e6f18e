#include "runtime/coordinator/state.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "runtime/base/text.h"
#include "runtime/solver/checker.h"

namespace cbc {

Timers::Timers(std::size_t items, std::vector<std::uint32_t> ranks)
    : position_(items, absent), ranks_(std::move(ranks)) {
  heap_.reserve(items);
}

void Timers::set(Item item, Microseconds due) {
  if (!has(item)) {
    heap_.emplace_back(due, item);
    position_[item] = static_cast<std::uint32_t>(heap_.size() - 1);
  } else {
    heap_[position_[item]].first = due;
  }
  sift_up(position_[item]);
  sift_down(position_[item]);
}

void Timers::remove(Item item) {
  if (!has(item)) return;
  const std::uint32_t position = position_[item];
  position_[item] = absent;
  const auto last = heap_.back();
  heap_.pop_back();
  if (position == heap_.size()) return;
  put(position, last);
  sift_up(position);
  sift_down(position_[last.second]);
}

void Timers::clear() {
  for (const auto& [due, item] : heap_) position_[item] = absent;
  heap_.clear();
}

void Timers::put(std::uint32_t position, const Entry& entry) {
  heap_[position] = entry;
  position_[entry.second] = position;
}

void Timers::sift_up(std::uint32_t position) {
  const auto entry = heap_[position];
  while (position > 0 && is_before(entry, heap_[(position - 1) / 2])) {
    put(position, heap_[(position - 1) / 2]);
    position = (position - 1) / 2;
  }
  put(position, entry);
}

void Timers::sift_down(std::uint32_t position) {
  const auto entry = heap_[position];
  for (;;) {
    std::uint32_t child = 2 * position + 1;
    if (child >= heap_.size()) break;
    if (child + 1 < heap_.size() && is_before(heap_[child + 1], heap_[child])) ++child;
    if (!is_before(heap_[child], entry)) break;
    put(position, heap_[child]);
    position = child;
  }
  put(position, entry);
}

Microseconds timeout_of(const CompiledCatalog& catalog, TaskId task, BehaviorId behavior) {
  const CompiledTask& compiled = catalog.tasks[task];
  if (compiled.keep_running) return 0;
  const Microseconds own = catalog.behaviors[behavior].timeout;
  return own > 0 ? own : compiled.timeout;
}

namespace {

/// Of reactive starts that are due together those of a higher priority come first, then those that
/// are earlier in the catalog. By catalog index; empty if all have the same priority.
std::vector<std::uint32_t> ranks_of_reactions(const CompiledCatalog& catalog) {
  if (catalog.task_rules.empty()) return {};
  std::vector<std::uint32_t> order(catalog.tasks.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto priority_of = [&](std::uint32_t index) {
    return catalog.task_rules[catalog.task_ids[index]].reactive_priority;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return priority_of(a) > priority_of(b);
  });
  std::vector<std::uint32_t> ranks(order.size());
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

}  // namespace

State::State(const CompiledCatalog& catalog)
    : catalog_(catalog),
      assignment_(catalog.tasks.size(), none),
      taken_at_(catalog.tasks.size(), 0),
      request_states_(catalog.tasks.size(), RequestState::absent),
      requests_(catalog.tasks.size()),
      running_((catalog.tasks.size() + 63) / 64, 0),
      denied_(catalog.behaviors.size(), 0),
      failed_(catalog.behaviors.size(), 0),
      failed_at_(catalog.behaviors.size(), 0),
      misfits_(catalog.behaviors.size(), 0),
      available_words_(catalog.words.back(), 0),
      values_(catalog.variables.size(), 0),
      fitting_(catalog.variables.size()),
      faulty_(catalog.behaviors.size(), 0),
      active_(catalog.behaviors.size(), 0),
      activated_at_(catalog.behaviors.size(), 0),
      timeouts_(catalog.tasks.size()),
      queue_(catalog.tasks.size(), ranks_of_reactions(catalog)),
      waiting_(catalog.tasks.size(), 0) {
  for (const CompiledTask& task : catalog.tasks) {
    if (!task.start_on_request) ++idle_total_;
  }
  const FittingValue* before = nullptr;
  for (const FittingValue& fitting : catalog.fitting_values) {
    const bool is_next = before != nullptr && before->behavior == fitting.behavior &&
                         before->variable == fitting.variable;
    if (!is_next) ++misfits_[fitting.behavior];
    // All variables have their first value, which is the first of those in which a behavior fits.
    if (fitting.value == 0) --misfits_[fitting.behavior];
    fitting_[fitting.variable].push_back(fitting);
    before = &fitting;
  }
  for (BehaviorId behavior(0); behavior < catalog.behaviors.size(); ++behavior) {
    update_available(behavior);
  }
}

void State::clear() {
  for (const std::uint32_t index : running()) set_value(catalog_.task_ids[index], none, 0);
  for (TaskId task(0); suspended_count_ > 0; ++task) {
    if (is_suspended(task)) end_suspended_request(task);
  }
  for (BehaviorId behavior(0); behavior < catalog_.behaviors.size(); ++behavior) {
    if (is_denied(behavior)) set_denied(behavior, false);
    clear_failed(behavior);
  }
  std::fill(faulty_.begin(), faulty_.end(), std::uint8_t{0});
  std::fill(active_.begin(), active_.end(), std::uint8_t{0});
  std::fill(waiting_.begin(), waiting_.end(), std::uint8_t{0});
  waiting_count_ = 0;
  timeouts_.clear();
  queue_.clear();
}

void State::restore(const Snapshot& snapshot) {
  clear();
  for (const BehaviorId behavior : snapshot.denied) set_denied(behavior, true);
  for (std::uint32_t variable = 0; variable < snapshot.variables.size(); ++variable) {
    set_variable({variable, snapshot.variables[variable]});
  }
  for (const BehaviorId behavior : snapshot.faulty) set_faulty(behavior, true);
  for (const auto& [behavior, time] : snapshot.active) set_active(behavior, time);
  for (const Snapshot::RunningTask& entry : snapshot.running) {
    set_value(entry.task, entry.value_index, entry.since);
    if (const auto& request = entry.request) {
      set_request(entry.task, request->priority, request->event, request->parameters,
                  request->time);
    }
    // At an instant before all others, so that even a timeout that is due right now is set.
    if (entry.waits_for_timeout) update_timeout(entry.task, -1);
  }
  for (const auto& [task, due] : snapshot.queue) enqueue(task, due);
  for (const TaskId task : snapshot.waiting) set_waiting(task, true);
  for (const auto& [behavior, time] : snapshot.failed) set_failed(behavior, time);
  for (const auto& [task, request] : snapshot.suspended) suspend_request(task, request);
}

void State::set_value(TaskId task, std::uint32_t index, Microseconds now, bool suspends) {
  if (assignment_[task] == index) return;
  const bool was_running = is_running(task);
  assignment_[task] = index;
  taken_at_[task] = now;
  if (was_running == is_running(task)) return;

  const CompiledTask& compiled = catalog_.tasks[task];
  running_[compiled.catalog_index / 64] ^= std::uint64_t{1} << (compiled.catalog_index % 64);
  if (was_running) {
    if (!compiled.start_on_request) --idle_running_;
    if (has_request(task)) {
      set_request_state(task, suspends ? RequestState::suspended : RequestState::absent);
    }
  } else {
    if (!compiled.start_on_request) ++idle_running_;
    if (is_suspended(task)) set_request_state(task, RequestState::active);
  }
}

std::vector<std::uint32_t> State::running() const {
  std::size_t count = 0;
  for (const std::uint64_t word : running_) count += static_cast<std::size_t>(std::popcount(word));
  std::vector<std::uint32_t> tasks;
  tasks.reserve(count);
  for (std::uint32_t word = 0; word < running_.size(); ++word) {
    for (std::uint64_t bits = running_[word]; bits != 0; bits &= bits - 1) {
      tasks.push_back(word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }
  return tasks;
}

void State::set_request_state(TaskId task, RequestState state) {
  if (is_counted(task)) --request_count_;
  if (is_suspended(task)) --suspended_count_;
  request_states_[task] = state;
  if (is_counted(task)) ++request_count_;
  if (is_suspended(task)) ++suspended_count_;
}

void State::set_request(TaskId task, std::int32_t priority, std::uint64_t event,
                        std::string_view parameters, std::optional<Microseconds> time) {
  set_request_state(task, RequestState::absent);
  requests_[task].priority = priority;
  requests_[task].event = event;
  requests_[task].parameters = parameters;
  requests_[task].time = time;
  set_request_state(task, RequestState::active);
}

void State::suspend_request(TaskId task, const Request& request) {
  requests_[task] = request;
  set_request_state(task, RequestState::suspended);
}

void State::end_suspended_request(TaskId task) { set_request_state(task, RequestState::absent); }

void State::set_denied(BehaviorId behavior, bool denied) {
  denied_[behavior] = denied ? 1 : 0;
  update_available(behavior);
}

void State::set_failed(BehaviorId behavior, Microseconds time) {
  if (!has_failed(behavior)) ++failed_count_;
  failed_[behavior] = 1;
  failed_at_[behavior] = time;
  update_available(behavior);
}

void State::clear_failed(BehaviorId behavior) {
  if (!has_failed(behavior)) return;
  --failed_count_;
  failed_[behavior] = 0;
  update_available(behavior);
}

void State::change_situation(std::span<const Availability> availability,
                             std::span<const VariableValue> variables) {
  for (const Availability& entry : availability) {
    set_denied(catalog_.behavior_ids[entry.behavior], !entry.available);
  }
  for (const VariableValue& value : variables) set_variable(value);
}

void State::set_variable(VariableValue value) {
  const std::uint32_t before = std::exchange(values_[value.variable], value.value);
  const std::vector<FittingValue>& all = fitting_[value.variable];
  for (auto next = all.begin(); next != all.end();) {
    const BehaviorId behavior = next->behavior;
    bool was_fitting = false;
    bool is_fitting = false;
    for (; next != all.end() && next->behavior == behavior; ++next) {
      was_fitting |= next->value == before;
      is_fitting |= next->value == value.value;
    }
    if (was_fitting == is_fitting) continue;
    is_fitting ? --misfits_[behavior] : ++misfits_[behavior];
    update_available(behavior);
  }
}

void State::update_available(BehaviorId behavior) {
  const bool available = is_available(behavior);
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t index = value - catalog_.values.begin[task];
    const std::uint64_t bit = std::uint64_t{1} << (index % 64);
    std::uint64_t& word = available_words_[catalog_.words[task] + index / 64];
    word = available ? word | bit : word & ~bit;
  }
}

bool State::has_available_behavior(TaskId task) const {
  const auto first = available_words_.begin() + catalog_.words[task];
  const auto end = available_words_.begin() + catalog_.words[task + 1];
  return std::any_of(first, end, [](std::uint64_t word) { return word != 0; });
}

void State::set_active(BehaviorId behavior, Microseconds now) {
  active_[behavior] = 1;
  activated_at_[behavior] = now;
}

void State::update_timeout(TaskId task, Microseconds now) {
  const std::uint32_t item = catalog_.tasks[task].catalog_index;
  const Microseconds timeout = is_running(task) ? timeout_of(catalog_, task, behavior(task)) : 0;
  if (timeout == 0) {
    timeouts_.remove(item);
    return;
  }
  const Microseconds due = std::max(activated_at_[behavior(task)], taken_at_[task]) + timeout;
  // A timeout that is due by now and has no timer was handled.
  if (due > now || timeouts_.has(item)) timeouts_.set(item, due);
}

void State::enqueue(TaskId task, Microseconds due) {
  const std::uint32_t item = catalog_.tasks[task].catalog_index;
  if (!is_running(task) && !queue_.has(item)) queue_.set(item, due);
}

void State::set_waiting(TaskId task, bool waiting) {
  if (waiting == is_waiting(task)) return;
  waiting_[task] = waiting ? 1 : 0;
  waiting ? ++waiting_count_ : --waiting_count_;
}

bool State::is_blocked(TaskId task, std::int32_t least) const {
  const auto cliques = catalog_.task_cliques[task];
  const auto limits = catalog_.limits_of(task);
  return std::any_of(cliques.begin(), cliques.end(),
                     [&](std::uint32_t clique) {
                       return is_full(catalog_.cliques[clique], 1, task, least);
                     }) ||
         std::any_of(limits.begin(), limits.end(), [&](std::uint32_t limit) {
           return is_full(catalog_.limited[limit], catalog_.limits[limit].most, task, least);
         });
}

bool State::is_blocked_by(TaskId task, std::int32_t least, TaskId rival) const {
  if (!counts_for(rival, least)) return false;
  const auto has_rival = [rival](std::span<const TaskId> list) {
    return std::binary_search(list.begin(), list.end(), rival);
  };
  const auto cliques = catalog_.task_cliques[task];
  const auto limits = catalog_.limits_of(task);
  return std::any_of(cliques.begin(), cliques.end(),
                     [&](std::uint32_t clique) { return has_rival(catalog_.cliques[clique]); }) ||
         std::any_of(limits.begin(), limits.end(), [&](std::uint32_t limit) {
           return has_rival(catalog_.limited[limit]) &&
                  is_full(catalog_.limited[limit], catalog_.limits[limit].most, task, least);
         });
}

bool State::is_full(std::span<const TaskId> list, std::uint32_t most, TaskId task,
                    std::int32_t least) const {
  std::uint32_t running = 0;
  for (const TaskId other : list) {
    if (other != task && counts_for(other, least) && ++running == most) return true;
  }
  return false;
}

namespace {

class SnapshotCheck {
 public:
  SnapshotCheck(const CompiledCatalog& catalog, const Snapshot& snapshot)
      : catalog_(catalog),
        snapshot_(snapshot),
        assignment_(catalog.tasks.size(), none),
        activated_at_(catalog.behaviors.size(), never) {}

  std::optional<std::string> run() && {
    check_clock();
    check_variables();
    for (const auto& [behavior, time] : snapshot_.active) check_activation(behavior, time);
    for (const Snapshot::RunningTask& entry : snapshot_.running) check_task(entry);
    check_active();
    check_repetitions(snapshot_.denied, "unavailable");
    check_repetitions(snapshot_.faulty, "faulty");
    for (const auto& [task, due] : snapshot_.queue) check_queued(task, due);
    for (const TaskId task : snapshot_.waiting) check_waiting(task);
    for (const auto& [behavior, time] : snapshot_.failed) check_failed(behavior, time);
    for (const auto& [task, request] : snapshot_.suspended) check_suspended(task, request);
    if (problem_.empty()) check_constraints();
    if (problem_.empty()) return std::nullopt;
    return std::move(problem_);
  }

 private:
  static constexpr Microseconds never = -1;

  /// Keeps the first problem.
  void refuse(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }
  [[nodiscard]] BehaviorId behavior_of(const Snapshot::RunningTask& entry) const {
    return catalog_.values[entry.task][entry.value_index].behavior;
  }
  [[nodiscard]] bool is_past(Microseconds time) const { return time >= 0 && time <= snapshot_.now; }
  [[nodiscard]] static std::string seconds(Microseconds time) {
    return format_decimal(time, 6) + " s";
  }

  void check_clock() {
    if (snapshot_.now < 0 || snapshot_.now > longest_time) {
      refuse("its time is not between 0 and " + seconds(longest_time));
    }
    if (snapshot_.reactive_delay <= 0 || snapshot_.reactive_delay > longest_time) {
      refuse("its reactive delay is not above 0 and at most " + seconds(longest_time));
    }
    if (snapshot_.events > UINT64_MAX / 2) refuse("its number of events is too large");
  }

  void check_variables() {
    const auto variables = catalog_.variables;
    for (std::uint32_t variable = 0; variable < variables.size(); ++variable) {
      if (snapshot_.variables[variable] >= variables[variable].value_count) {
        refuse(
            concat("variable ", quote(catalog_.name_of_variable(variable)), " has no such value"));
      }
    }
  }

  void check_activation(BehaviorId behavior, Microseconds time) {
    const std::string name = quote(catalog_.name_of_behavior(behavior));
    if (activated_at_[behavior] != never) refuse(concat("behavior ", name, " is active twice"));
    if (!is_past(time)) {
      refuse(concat("behavior ", name, " became active after the time of the state, or before 0"));
      return;
    }
    activated_at_[behavior] = time;
  }

  void check_task(const Snapshot::RunningTask& entry) {
    const std::string name = quote(catalog_.name_of_task(entry.task));
    const BehaviorId behavior = behavior_of(entry);
    if (assignment_[entry.task] != none) refuse(concat("task ", name, " runs twice"));
    assignment_[entry.task] = entry.value_index;
    if (!is_past(entry.since)) {
      refuse(concat("task ", name, " runs since a time after that of the state, or before 0"));
      return;
    }
    if (activated_at_[behavior] == never) {
      refuse(concat("task ", name, " runs with ", quote(catalog_.name_of_behavior(behavior)),
                    ", which is not active"));
    }
    if (entry.request) {
      check_request(name, *entry.request);
    } else if (catalog_.tasks[entry.task].start_on_request != 0) {
      refuse(concat("task ", name, " starts only on request, but runs without one"));
    }
    check_timeout(name, entry);
  }

  void check_request(const std::string& name, const Request& request) {
    if (request.priority < 0) refuse(concat("the request of ", name, " has no priority"));
    if (request.event == 0 || request.event > snapshot_.events) {
      refuse(concat("the request of ", name, " is from an event that never happened"));
    } else if (!events_.insert(request.event).second) {
      refuse(concat("the request of ", name, " is from the same event as another one"));
    }
  }

  void check_timeout(const std::string& name, const Snapshot::RunningTask& entry) {
    const BehaviorId behavior = behavior_of(entry);
    const Microseconds timeout =
        snapshot_.timeouts ? timeout_of(catalog_, entry.task, behavior) : 0;
    const Microseconds due =
        timeout == 0 ? never : std::max(entry.since, activated_at_[behavior]) + timeout;
    if (entry.waits_for_timeout ? due < snapshot_.now : due > snapshot_.now) {
      refuse(concat("task ", name, " ", entry.waits_for_timeout ? "cannot wait" : "does not wait",
                    " for a timeout"));
    }
  }

  void check_active() {
    std::vector<std::uint8_t> is_used(catalog_.behaviors.size(), 0);
    for (const Snapshot::RunningTask& entry : snapshot_.running) {
      is_used[behavior_of(entry)] = 1;
    }
    for (const auto& [behavior, time] : snapshot_.active) {
      if (is_used[behavior] != 0) continue;
      refuse(concat("behavior ", quote(catalog_.name_of_behavior(behavior)),
                    " is active, but performs no task"));
    }
    for (const auto& [behavior, time] : snapshot_.active) {
      const auto variable = catalog_.find_misfit(behavior, snapshot_.variables);
      if (!variable) continue;
      refuse(concat("behavior ", quote(catalog_.name_of_behavior(behavior)),
                    " is active, but does not fit the value of ",
                    quote(catalog_.name_of_variable(*variable))));
    }
  }

  void check_repetitions(const std::vector<BehaviorId>& behaviors, std::string_view what) {
    std::set<BehaviorId> known;
    for (const BehaviorId behavior : behaviors) {
      if (known.insert(behavior).second) continue;
      refuse(
          concat("behavior ", quote(catalog_.name_of_behavior(behavior)), " is ", what, " twice"));
    }
  }

  void check_queued(TaskId task, Microseconds due) {
    const std::string name = quote(catalog_.name_of_task(task));
    if (catalog_.tasks[task].reactive_start == 0) {
      refuse(concat("task ", name, " is in the queue, but does not start reactively"));
    }
    if (assignment_[task] != none) refuse(concat("task ", name, " is in the queue, but runs"));
    if (!queued_.insert(task).second) {
      refuse(concat("task ", name, " is in the queue twice"));
    }
    if (due < snapshot_.now || due - snapshot_.now > snapshot_.reactive_delay) {
      refuse(concat("task ", name, " is in the queue for an impossible time"));
    }
  }

  void check_waiting(TaskId task) {
    const std::string name = quote(catalog_.name_of_task(task));
    if (catalog_.tasks[task].reactive_start == 0) {
      refuse(concat("task ", name, " waits, but does not start reactively"));
    }
    if (assignment_[task] != none) refuse(concat("task ", name, " waits, but runs"));
    if (!waiting_.insert(task).second) refuse(concat("task ", name, " waits twice"));
  }

  void check_failed(BehaviorId behavior, Microseconds time) {
    const std::string name = quote(catalog_.name_of_behavior(behavior));
    if (!failed_.insert(behavior).second) {
      refuse(concat("behavior ", name, " is remembered as failed twice"));
    }
    if (!is_past(time)) {
      refuse(concat("behavior ", name, " failed after the time of the state, or before 0"));
    }
    if (catalog_.retry_of(behavior) == Retry::at_events) {
      refuse(concat("behavior ", name, " is remembered as failed, but is tried again"));
    }
    if (activated_at_[behavior] != never) {
      refuse(concat("behavior ", name, " is remembered as failed, but active"));
    }
  }

  void check_suspended(TaskId task, const Request& request) {
    const std::string name = quote(catalog_.name_of_task(task));
    if (catalog_.rules_of(task).resume == 0) {
      refuse(concat("the request of ", name, " is suspended, but it does not resume"));
    }
    if (assignment_[task] != none) refuse(concat("the request of ", name, " waits, but it runs"));
    if (request.priority < 1) refuse(concat("the request of ", name, " has no priority"));
    if (!suspended_.insert(task).second) {
      refuse(concat("the request of ", name, " is suspended twice"));
    }
    check_request(name, request);
  }

  /// Checks the constraints as for an answer of the solver.
  void check_constraints() {
    Checker checker(catalog_);
    for (GroupId group(0); group < catalog_.group_count(); ++group) {
      const TaskId first = catalog_.group_tasks[group];
      const TaskId end = catalog_.group_tasks[group + 1];
      Problem anything;
      anything.group = group;
      anything.domains.assign(catalog_.words[end] - catalog_.words[first], ~std::uint64_t{0});
      anything.may_stop.assign(end - first, 1);
      const Assignment answer(assignment_.begin() + first, assignment_.begin() + end);
      if (auto violation = checker.find_violation(anything, answer)) refuse(std::move(*violation));
    }
  }

  const CompiledCatalog& catalog_;
  const Snapshot& snapshot_;
  Assignment assignment_;                   ///< by task
  std::vector<Microseconds> activated_at_;  ///< by behavior
  std::set<std::uint64_t> events_;          ///< those of the requests
  std::set<TaskId> queued_;
  std::set<TaskId> waiting_;
  std::set<TaskId> suspended_;
  std::set<BehaviorId> failed_;
  std::string problem_;
};

}  // namespace

std::optional<std::string> find_inconsistency(const CompiledCatalog& catalog,
                                              const Snapshot& snapshot) {
  return SnapshotCheck(catalog, snapshot).run();
}

}  // namespace cbc
