#include <algorithm>

#include "explore/moves/stepper.h"

// How a stepper decides an event, and what the answer changes.

namespace cbc {

namespace {

/// Calls `function` for each word of the range, with its bits in the range.
template <typename Function>
void for_each_word(BitRange range, Function&& function) {
  for (std::uint32_t bit = range.begin; bit < range.end;) {
    const std::uint32_t end = std::min(range.end, (bit / 64 + 1) * 64);
    const Word mask = end - bit == 64 ? ~Word{0} : ((Word{1} << (end - bit)) - 1);
    function(bit / 64, mask << (bit % 64));
    bit = end;
  }
}

void clear_range(Word* words, BitRange range) {
  for_each_word(range, [&](std::uint32_t word, Word mask) { words[word] &= ~mask; });
}

/// Copies the bits of the range, and none else.
void copy_range(const Word* from, std::vector<Word>& to, BitRange range) {
  std::fill(to.begin(), to.end(), 0);
  for_each_word(range, [&](std::uint32_t word, Word mask) { to[word] |= from[word] & mask; });
}

}  // namespace

// Coordination (docs/semantics.md, "Domains").

/// Of a finish: requests of ranks below this are not protected at first.
Model::Rank Stepper::first_protection(const Trigger& trigger) const {
  Model::Rank highest = 1;
  for (const std::uint32_t value : model_.behaviors()[trigger.behavior].values) {
    const std::uint32_t task = model_.task_of(value);
    if (has_finished(trigger, task)) highest = std::max(highest, rank_in(now_, task));
  }
  return highest;
}

bool Stepper::coordinate(const Trigger& trigger) {
  std::fill(excluded_values_.begin(), excluded_values_.end(), 0);
  has_excluded_ = false;
  const auto exclude = [&](std::uint32_t behavior) {
    for (const std::uint32_t value : model_.behaviors()[behavior].values) {
      set_bit(excluded_values_.data(), value);
    }
    has_excluded_ = true;
  };
  const Model::Group& group = model_.groups()[trigger.group];
  copy_range(now_.values.data(), present_, group.values);
  copy_range(now_.active.data(), was_active_, group.behaviors);
  const bool is_finish = trigger.kind == Trigger::Kind::finish;
  if (is_finish) {
    clear_bit(was_active_.data(), trigger.behavior);
    if (trigger.cause == FinishCause::process_failure) exclude(trigger.behavior);
  }
  active_ = was_active_;
  rank_requests(trigger);
  const Model::Rank first = is_finish ? first_protection(trigger) : trigger.ranks;
  for (;;) {
    Model::Rank ranks = first;
    const Word* const solution = solve(decisions_, trigger, ranks, true);
    const auto tell = [&] {
      if (listener_ != nullptr) listener_->on_answer(*this, {trigger, first, ranks, solution});
    };
    if (solution == nullptr) {
      if (!is_silent(trigger)) tell();
      reject(trigger);
      return false;
    }
    if (trigger.kind == Trigger::Kind::reconsider && !has_excluded_ &&
        !improves(trigger, solution)) {
      return false;
    }
    find_wanted(solution);
    const std::uint32_t failing = first_failure();
    if (trace_ != nullptr) note_changes(wanted_.data(), trigger.group, failing);
    if (failing == none) {
      tell();
      accept(trigger, solution);
      return true;
    }
    // The deactivations, and the activations before the one that fails.
    for (std::size_t word = 0; word < active_.size(); ++word) {
      Word before = 0;
      if (word < failing / 64) before = ~Word{0};
      if (word == failing / 64) before = (Word{1} << (failing % 64)) - 1;
      active_[word] = wanted_[word] & (active_[word] | before);
    }
    exclude(failing);
    note_failure(failing);
  }
}

/// Whether a solution resumes a task, or gives one a better behavior that may improve at once.
bool Stepper::improves(const Trigger& trigger, const Word* solution) const {
  for (std::size_t word = 0; word < present_.size(); ++word) {
    for (Word bits = solution[word] & ~present_[word]; bits != 0; bits &= bits - 1) {
      const auto value =
          static_cast<std::uint32_t>(word * 64 + static_cast<unsigned>(std::countr_zero(bits)));
      const std::uint32_t task = model_.task_of(value);
      if (model_.tasks()[task].group != trigger.group) continue;
      if (now_.cells[task] == 0) {
        if (rank_in(now_, task) > 0) return true;
        continue;
      }
      if (!may_improve(task)) continue;
      const auto& costs = model_.catalog().values[model_.tasks()[task].id];
      const std::uint32_t first = model_.tasks()[task].values.begin;
      if (costs[value - first].suitability > costs[now_.cells[task] - 1U].suitability) return true;
    }
  }
  return false;
}

/// The first behavior that has to be activated and cannot be, as it is faulty; or none.
std::uint32_t Stepper::first_failure() const {
  if (model_.layout().faulty_count == 0) return none;
  for (std::size_t word = 0; word < wanted_.size(); ++word) {
    for (Word bits = wanted_[word] & ~active_[word]; bits != 0; bits &= bits - 1) {
      const auto behavior =
          static_cast<std::uint32_t>(word * 64 + static_cast<unsigned>(std::countr_zero(bits)));
      if (is_faulty_now(behavior)) return behavior;
    }
  }
  return none;
}

void Stepper::find_wanted(const Word* solution) {
  std::fill(wanted_.begin(), wanted_.end(), 0);
  for_each_bit(solution, present_.size(),
               [&](std::uint32_t value) { set_bit(wanted_.data(), model_.behavior_of(value)); });
}

/// Whether it is no event that there is no answer: the task waited before, and nothing happened.
bool Stepper::is_silent(const Trigger& trigger) const {
  if (!trigger.is_reactive || has_excluded_) return false;
  return now_.cells[model_.layout().waiting + model_.tasks()[trigger.task].reactive] != 0;
}

/// Escalates the protection of a finish until there is a solution.
const Word* Stepper::solve(Decisions& decisions, const Trigger& trigger, Model::Rank& ranks,
                           bool is_asked) {
  find_domains(trigger);
  for (;;) {
    const Word* const solution = ask(decisions, trigger, ranks);
    if (solution != nullptr && is_asked && !is_possible(trigger, solution)) {
      find_domains(trigger);
      continue;
    }
    if (solution != nullptr || trigger.kind != Trigger::Kind::finish) return solution;
    Model::Rank next = 0;
    const BitRange tasks = model_.groups()[trigger.group].tasks;
    for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
      if (has_finished(trigger, task) || now_.cells[task] == 0) continue;
      const Model::Rank rank = rank_in(now_, task);
      if (rank > ranks && (next == 0 || rank < next)) next = rank;
    }
    if (next == 0) return nullptr;
    ranks = next;
  }
}

const Word* Stepper::answer_unprotected(const Trigger& trigger) {
  Model::Rank all = UINT16_MAX;
  return solve(decisions_, trigger, all, true);
}

const Word* Stepper::ask(Decisions& decisions, const Trigger& trigger, Model::Rank ranks) {
  std::fill(must_run_.begin(), must_run_.end(), 0);
  const Model::Layout& layout = model_.layout();
  const BitRange tasks = model_.groups()[trigger.group].tasks;
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    const std::uint32_t task = cell - 1U;
    if (task < tasks.begin || task >= tasks.end || task == trigger.task) continue;
    if (has_finished(trigger, task) || now_.cells[task] == 0) continue;
    const Model::Rank rank = now_.cells[layout.ranks + place];
    if (trigger.is_reactive ? rank >= trigger.rank : rank >= ranks) {
      set_bit(must_run_.data(), task);
    }
  }
  if (trigger.kind == Trigger::Kind::start) set_bit(must_run_.data(), trigger.task);

  GroupQuestion question;
  question.group = trigger.group;
  question.finished = trigger.behavior;
  question.domains = domains_.data();
  question.must_run = must_run_.data();
  question.present = present_.data();
  question.requests = requests_;
  question.suspended = static_cast<std::uint32_t>(suspended_requests_.size());
  question.unasked = static_cast<std::uint32_t>(unasked_requests_.size());
  question.must_not_make_worse = trigger.is_unasked();
  return decisions.find(question);
}

/// Whether all that the answer uses is possible; if not, the domains have changed.
bool Stepper::is_possible(const Trigger& trigger, const Word* solution) {
  for (std::size_t word = 0; word < present_.size(); ++word) {
    for (Word bits = solution[word]; bits != 0; bits &= bits - 1) {
      const auto value =
          static_cast<std::uint32_t>(word * 64 + static_cast<unsigned>(std::countr_zero(bits)));
      if (!may_have(trigger, value)) return false;
    }
  }
  return has_known_order(trigger, solution);
}

/// Whether a value of the domain is in it.
bool Stepper::may_have(const Trigger& trigger, std::uint32_t value) {
  const std::uint32_t behavior = model_.behavior_of(value);
  const bool is_kept = has_bit(present_.data(), value) &&
                       (trigger.kind != Trigger::Kind::finish || behavior != trigger.behavior);
  return is_kept ? fits(behavior) : is_available_now(behavior);
}

/// The canonical order of the values of a task that runs depends on whether one of the domain suits
/// it better than the present one (docs/semantics.md, "Objectives"). False: none does, where one
/// seemed to.
bool Stepper::has_known_order(const Trigger& trigger, const Word* solution) {
  const Model::Group& group = model_.groups()[trigger.group];
  for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
    if (now_.cells[task] == 0) continue;
    const BitRange values = model_.tasks()[task].values;
    const auto& costs = model_.catalog().values[model_.tasks()[task].id];
    const std::uint32_t present = values.begin + now_.cells[task] - 1;
    if (!has_bit(domains_.data(), present)) continue;
    bool seemed_better = false;
    bool is_better = false;
    for (std::uint32_t value = values.begin; value < present && !is_better; ++value) {
      if (!has_bit(domains_.data(), value) ||
          costs[value - values.begin].suitability == costs[present - values.begin].suitability) {
        continue;
      }
      seemed_better = true;
      is_better = has_bit(solution, value) || may_have(trigger, value);
    }
    if (seemed_better && !is_better) return false;
  }
  return true;
}

void Stepper::find_domains(const Trigger& trigger) {
  const Model::Group& group = model_.groups()[trigger.group];
  const Possible& possible = now_.possible;
  copy_range(possible.available_values.data(), domains_, group.values);
  for (std::size_t word = 0; word < domains_.size(); ++word) {
    domains_[word] |= present_[word] & possible.fitting_values[word];
  }
  if (trigger.kind == Trigger::Kind::finish) {
    // The behavior that has finished may be kept only if it is available.
    for (const std::uint32_t value : model_.behaviors()[trigger.behavior].values) {
      if (has_bit(present_.data(), value) && !has_bit(possible.available_values.data(), value)) {
        clear_bit(domains_.data(), value);
      }
    }
  }
  for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
    const Model::Task& described = model_.tasks()[task];
    bool is_closed = false;
    if (task == trigger.task) {
      is_closed = trigger.kind == Trigger::Kind::stop;
    } else if (now_.cells[task] == 0) {
      const bool waits = described.resumes && !trigger.is_unasked() && rank_in(now_, task) > 0;
      is_closed = described.start_on_request && !waits;
    } else if (has_finished(trigger, task)) {
      is_closed = trigger.cause == FinishCause::goal_achieved;
    }
    if (is_closed) clear_range(domains_.data(), described.values);
    const bool is_started =
        trigger.kind == Trigger::Kind::start && !trigger.is_reactive && task == trigger.task;
    if (described.improve == Improve::when_started && !is_started) remove_better(task);
  }
  if (trigger.kind == Trigger::Kind::reconsider) keep_what_was_not_asked_for(trigger.group);
  if (!has_excluded_) return;
  for (std::size_t word = 0; word < domains_.size(); ++word) {
    domains_[word] &= ~excluded_values_[word];
  }
}

/// Where a group is reconsidered, only what may improve at once, what waits, and what these may
/// need gets better.
void Stepper::keep_what_was_not_asked_for(std::uint32_t group) {
  const BitRange tasks = model_.groups()[group].tasks;
  needs_.clear();
  for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
    const bool waits = now_.cells[task] == 0 && rank_in(now_, task) > 0;
    if (may_improve(task) || waits) needs_.add(model_.tasks()[task].id);
  }
  for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
    if (!needs_.has(model_.tasks()[task].id)) remove_better(task);
  }
}

/// Removes the values of a running task that suit it better than its present one.
void Stepper::remove_better(std::uint32_t task) {
  if (now_.cells[task] == 0) return;
  const auto& costs = model_.catalog().values[model_.tasks()[task].id];
  const std::uint32_t first = model_.tasks()[task].values.begin;
  const std::uint32_t present = now_.cells[task] - 1U;
  for (std::uint32_t index = 0; index < present; ++index) {
    if (costs[index].suitability == costs[present].suitability) break;
    clear_bit(domains_.data(), first + index);
  }
}

/// The requests of the group, as in Problem.
void Stepper::rank_requests(const Trigger& trigger) {
  requests_.clear();
  suspended_requests_.clear();
  unasked_requests_.clear();
  const Model::Layout& layout = model_.layout();
  const BitRange tasks = model_.groups()[trigger.group].tasks;
  const bool is_start = trigger.kind == Trigger::Kind::start;
  bool is_new_listed = !is_start;
  const auto list_new = [&] {
    auto& list = trigger.is_unasked() ? unasked_requests_ : requests_;
    list.push_back(static_cast<std::uint16_t>(trigger.task));
    is_new_listed = true;
  };
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    const std::uint32_t task = cell - 1U;
    if (!is_new_listed && now_.cells[layout.ranks + place] < trigger.ranks) list_new();
    if (task < tasks.begin || task >= tasks.end || task == trigger.task) continue;
    if (trigger.cause == FinishCause::goal_achieved && has_finished(trigger, task)) continue;
    if (now_.cells[task] == 0) {
      if (!trigger.is_unasked()) suspended_requests_.push_back(static_cast<std::uint16_t>(task));
    } else if (now_.cells[layout.ranks + place] == 0) {
      unasked_requests_.push_back(static_cast<std::uint16_t>(task));
    } else {
      requests_.push_back(static_cast<std::uint16_t>(task));
    }
  }
  if (!is_new_listed) list_new();
  requests_.insert(requests_.end(), suspended_requests_.begin(), suspended_requests_.end());
  requests_.insert(requests_.end(), unasked_requests_.begin(), unasked_requests_.end());
}

/// Rolls back; what cannot be activated again is lost.
void Stepper::reject(const Trigger& trigger) {
  note_outcome(Outcome::rejected);
  if (model_.layout().faulty_count > 0) {
    if (trace_ != nullptr) note_changes(was_active_.data(), trigger.group, none);
    for_each_bit(was_active_.data(), was_active_.size(), [&](std::uint32_t behavior) {
      if (has_bit(active_.data(), behavior) || !is_faulty_now(behavior)) return;
      lost_.push_back(behavior);
      note_failure(behavior);
    });
    std::sort(lost_.begin(), lost_.end(),
              [&](auto a, auto b) { return model_.behaviors()[a].id > model_.behaviors()[b].id; });
  }
  if (!trigger.is_reactive) return;
  const bool waits = trigger.is_unasked() || !has_excluded_;
  now_.cells[model_.layout().waiting + model_.tasks()[trigger.task].reactive] = waits ? 1 : 0;
}

void Stepper::accept(const Trigger& trigger, const Word* solution) {
  note_outcome(Outcome::accepted);
  const Model::Group& group = model_.groups()[trigger.group];
  started_.clear();
  stopped_.clear();
  stopped_by_others_.clear();
  suspended_.clear();
  std::fill(values_after_.begin(), values_after_.end(), std::uint16_t{0});
  for_each_bit(solution, present_.size(), [&](std::uint32_t value) {
    const std::uint32_t task = model_.task_of(value);
    values_after_[task] = static_cast<std::uint16_t>(value - model_.tasks()[task].values.begin + 1);
  });
  for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
    const std::uint16_t after = values_after_[task];
    std::uint16_t& cell = now_.cells[task];
    if (after == 0 && cell != 0) {
      const bool finished = has_finished(trigger, task);
      stopped_.push_back(task);
      note_stop(task, finished ? trigger.cause : FinishCause::interrupted);
      const bool is_own_end =
          finished ? trigger.cause != FinishCause::situation_change : task == trigger.task;
      if (!is_own_end) stopped_by_others_.push_back(task);
      if (suspends(trigger, task)) suspended_.push_back(task);
    } else if (after != 0 && cell == 0) {
      started_.push_back(task);
    }
    cell = after;
  }
  derive(now_);
  update_requests(trigger);
  update_queue(trigger);
}

/// Whether a task that stops keeps its request.
bool Stepper::suspends(const Trigger& trigger, std::uint32_t task) const {
  if (!model_.tasks()[task].resumes || trigger.kind == Trigger::Kind::stop) return false;
  return !has_finished(trigger, task) || trigger.cause == FinishCause::situation_change;
}

/// Of tasks that do not run, those requests remain that are suspended, now or before.
void Stepper::update_requests(const Trigger& trigger) {
  const Model::Layout& layout = model_.layout();
  std::uint16_t* const requests = now_.cells.data() + layout.requests;
  std::uint16_t* const ranks = now_.cells.data() + layout.ranks;
  std::uint32_t count = 0;
  const bool is_start = trigger.kind == Trigger::Kind::start;
  for (std::uint32_t place = 0; place < layout.request_count && requests[place] != 0; ++place) {
    const std::uint32_t task = requests[place] - 1U;
    if (is_start && task == trigger.task) continue;
    const auto is_in = [task](const std::vector<std::uint32_t>& list) {
      return std::find(list.begin(), list.end(), task) != list.end();
    };
    if (now_.cells[task] == 0 && is_in(stopped_) && !is_in(suspended_)) continue;
    requests[count] = requests[place];
    ranks[count++] = ranks[place];
  }
  std::fill(requests + count, requests + layout.request_count, std::uint16_t{0});
  std::fill(ranks + count, ranks + layout.request_count, std::uint16_t{0});
  if (!is_start || count == layout.request_count) return;
  std::uint32_t place = count;
  for (; place > 0 && ranks[place - 1] <= trigger.rank; --place) {
    requests[place] = requests[place - 1];
    ranks[place] = ranks[place - 1];
  }
  requests[place] = static_cast<std::uint16_t>(trigger.task + 1);
  ranks[place] = trigger.rank;
}

/// Whether a task stands in the way of a reactive start with a priority of this rank.
bool Stepper::counts_for(std::uint32_t task, Model::Rank rank) const {
  return has_bit(now_.running.data(), task) && (rank == 0 || rank_in(now_, task) > rank);
}

bool Stepper::is_full(const Model::Limit& limit, std::uint32_t task, Model::Rank rank) const {
  const auto running =
      std::count_if(limit.tasks.begin(), limit.tasks.end(),
                    [&](std::uint32_t other) { return other != task && counts_for(other, rank); });
  return running >= limit.most;
}

/// Of a reactive task.
bool Stepper::is_blocked(std::uint32_t task) const {
  const Model::Task& described = model_.tasks()[task];
  const Model::Rank rank = described.reactive_rank;
  const auto counts = [&](std::uint32_t rival) { return counts_for(rival, rank); };
  return std::any_of(described.rivals.begin(), described.rivals.end(), counts) ||
         std::any_of(described.limits.begin(), described.limits.end(), [&](std::uint32_t limit) {
           return is_full(model_.limits()[limit], task, rank);
         });
}

/// The same, by lists in which a rival counts.
bool Stepper::is_blocked_by(std::uint32_t task, std::uint32_t rival) const {
  const Model::Task& described = model_.tasks()[task];
  const Model::Rank rank = described.reactive_rank;
  if (!counts_for(rival, rank)) return false;
  if (std::binary_search(described.rivals.begin(), described.rivals.end(), rival)) return true;
  return std::any_of(described.limits.begin(), described.limits.end(), [&](std::uint32_t number) {
    const Model::Limit& limit = model_.limits()[number];
    return std::find(limit.tasks.begin(), limit.tasks.end(), rival) != limit.tasks.end() &&
           is_full(limit, task, rank);
  });
}

bool Stepper::may_enqueue(std::uint32_t reactive) const {
  return now_.cells[model_.layout().queue + reactive] == 0 &&
         !has_bit(now_.running.data(), model_.reactive()[reactive]);
}

void Stepper::enqueue(std::uint32_t reactive) {
  if (may_enqueue(reactive)) now_.cells[model_.layout().queue + reactive] = joined_now;
}

void Stepper::update_queue(const Trigger& trigger) {
  if (model_.layout().reactive_count == 0) return;
  const auto& tasks = model_.tasks();
  std::uint16_t* const queue = now_.cells.data() + model_.layout().queue;
  for (const std::uint32_t task : stopped_) {
    for (const std::uint32_t rival : tasks[task].reactive_rivals) enqueue(rival);
  }
  for (const std::uint32_t task : stopped_by_others_) {
    if (tasks[task].reactive != none) enqueue(tasks[task].reactive);
  }
  for (const std::uint32_t task : started_) {
    if (tasks[task].reactive != none) queue[tasks[task].reactive] = 0;
    for (const std::uint32_t rival : tasks[task].reactive_rivals) {
      if (is_blocked_by(model_.reactive()[rival], task)) queue[rival] = 0;
    }
  }
  retry_waiting(trigger.group);
}

/// The tasks of the group that wait try again after an accepted event.
void Stepper::retry_waiting(std::uint32_t group) {
  for (const std::uint32_t reactive : model_.groups()[group].reactive) {
    std::uint16_t& waits = now_.cells[model_.layout().waiting + reactive];
    if (waits == 0) continue;
    const std::uint32_t task = model_.reactive()[reactive];
    if (has_bit(now_.running.data(), task) || is_blocked(task)) {
      waits = 0;
    } else {
      enqueue(reactive);
    }
  }
}

// What a comparison of two catalogs observes.

void Stepper::open_event(Verb verb, Origin origin, std::uint32_t subject) {
  if (trace_ == nullptr) return;
  close_event();
  MoveTrace::Happening& event = trace_->events.emplace_back();
  event.verb = verb;
  event.origin = origin;
  event.subject = subject;
}

/// Notes what the last event has left in the queue.
void Stepper::close_event() {
  if (trace_ == nullptr || trace_->events.empty() || trace_->events.back().is_closed) return;
  MoveTrace::Happening& event = trace_->events.back();
  const Model::Layout& layout = model_.layout();
  const auto cells = now_.cells.begin();
  event.queue.assign(cells + layout.queue, cells + layout.queue + layout.reactive_count);
  event.waiting.assign(cells + layout.waiting, cells + layout.waiting + layout.reactive_count);
  event.suspended.clear();
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    if (now_.cells[cell - 1U] != 0) continue;
    event.suspended.emplace_back(cell - 1U, now_.cells[layout.ranks + place]);
  }
  event.is_closed = true;
}

void Stepper::note_outcome(Outcome outcome) {
  if (trace_ != nullptr) trace_->events.back().outcome = outcome;
}

/// Deactivations from the highest level down, then activations from the lowest up, to the first
/// that fails, which is `failing`.
void Stepper::note_changes(const Word* wanted, std::uint32_t group, std::uint32_t failing) {
  auto& changes = trace_->events.back().changes;
  for (const std::uint32_t behavior : deactivation_order_[group]) {
    if (has_bit(active_.data(), behavior) && !has_bit(wanted, behavior)) {
      changes.push_back({behavior, false, true});
    }
  }
  const bool is_rollback = wanted == was_active_.data();
  const BitRange behaviors = model_.groups()[group].behaviors;
  for (std::uint32_t behavior = behaviors.begin; behavior < behaviors.end; ++behavior) {
    if (has_bit(active_.data(), behavior) || !has_bit(wanted, behavior)) continue;
    const bool fails = is_rollback ? is_faulty_now(behavior) : behavior == failing;
    changes.push_back({behavior, true, !fails});
    if (fails && !is_rollback) return;
  }
}

void Stepper::note_stop(std::uint32_t task, FinishCause cause) {
  if (trace_ != nullptr) trace_->events.back().stopped.emplace_back(task, cause);
}

}  // namespace cbc
