#include "verify/stepper.h"

#include <algorithm>

namespace cbc {

namespace {

/// Of a task that has joined the queue during the present move.
constexpr std::uint16_t joined_now = UINT16_MAX;

void clear_range(Word* words, BitRange range) {
  for (std::uint32_t bit = range.begin; bit < range.end;) {
    const std::uint32_t end = std::min(range.end, (bit / 64 + 1) * 64);
    const Word mask = end - bit == 64 ? ~Word{0} : ((Word{1} << (end - bit)) - 1);
    words[bit / 64] &= ~(mask << (bit % 64));
    bit = end;
  }
}

/// Copies the bits of the range, and none else.
void copy_range(const Word* from, std::vector<Word>& to, BitRange range) {
  std::fill(to.begin(), to.end(), 0);
  for (std::uint32_t bit = range.begin; bit < range.end;) {
    const std::uint32_t end = std::min(range.end, (bit / 64 + 1) * 64);
    const Word mask = end - bit == 64 ? ~Word{0} : ((Word{1} << (end - bit)) - 1);
    to[bit / 64] |= from[bit / 64] & (mask << (bit % 64));
    bit = end;
  }
}

}  // namespace

Stepper::Stepper(const Model& model) : model_(model), decisions_(model) {
  const std::size_t values = words_for(model.value_count());
  const std::size_t tasks = words_for(model.tasks().size());
  const std::size_t behaviors = words_for(model.behaviors().size());
  before_.cells.resize(model.layout().cells);
  before_.values.resize(values);
  before_.running.resize(tasks);
  before_.active.resize(behaviors);
  before_.fitting.resize(behaviors);
  before_.available.resize(behaviors);
  before_.available_values.resize(values);
  before_.fitting_values.resize(values);
  excluded_values_.resize(values);
  domains_.resize(values);
  present_.resize(values);
  must_run_.resize(tasks);
  was_active_.resize(behaviors);
  active_.resize(behaviors);
  wanted_.resize(behaviors);
  for (const Model::Group& group : model.groups()) {
    auto& order = deactivation_order_.emplace_back();
    for (std::uint32_t place = group.behaviors.begin; place < group.behaviors.end; ++place) {
      order.push_back(place);
    }
    const auto level = [&](std::uint32_t behavior) {
      return model.catalog().behaviors[model.behaviors()[behavior].id].level;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return level(a) > level(b); });
  }
}

// The state.

void Stepper::load(const std::uint32_t* packed) {
  model_.unpack(packed, before_.cells.data());
  derive(before_, true);
}

void Stepper::derive(State& state, bool situation_too) const {
  std::fill(state.values.begin(), state.values.end(), 0);
  std::fill(state.running.begin(), state.running.end(), 0);
  std::fill(state.active.begin(), state.active.end(), 0);
  const auto& tasks = model_.tasks();
  for (std::uint32_t task = 0; task < tasks.size(); ++task) {
    const std::uint16_t cell = state.cells[task];
    if (cell == 0) continue;
    const std::uint32_t value = tasks[task].values.begin + cell - 1;
    set_bit(state.values.data(), value);
    set_bit(state.running.data(), task);
    set_bit(state.active.data(), model_.behavior_of(value));
  }
  if (situation_too) derive_situation(state);
}

void Stepper::derive_situation(State& state) const {
  std::fill(state.fitting.begin(), state.fitting.end(), ~Word{0});
  for (std::uint32_t place = 0; place < model_.variables().size(); ++place) {
    const auto& misfits = model_.variables()[place].misfits[value_of(state, place)];
    for (std::size_t word = 0; word < misfits.size(); ++word) state.fitting[word] &= ~misfits[word];
  }
  const auto& behaviors = model_.behaviors();
  std::fill(state.available_values.begin(), state.available_values.end(), 0);
  std::fill(state.fitting_values.begin(), state.fitting_values.end(), 0);
  for (std::uint32_t place = 0; place < behaviors.size(); ++place) {
    const bool fits = has_bit(state.fitting.data(), place);
    const bool available = fits && !is_denied(state, place);
    available ? set_bit(state.available.data(), place) : clear_bit(state.available.data(), place);
    if (!fits) continue;
    for (const std::uint32_t value : behaviors[place].values) {
      set_bit(state.fitting_values.data(), value);
      if (available) set_bit(state.available_values.data(), value);
    }
  }
}

bool Stepper::is_denied(const State& state, std::uint32_t behavior) const {
  const std::uint32_t own = model_.behaviors()[behavior].own;
  return own == none ? has_bit(model_.denied().data(), behavior)
                     : state.cells[model_.layout().own + own] != 0;
}

std::uint32_t Stepper::value_of(const State& state, std::uint32_t variable) const {
  const Model::Variable& described = model_.variables()[variable];
  return described.cell == none ? described.initial : state.cells[described.cell];
}

Model::Rank Stepper::rank_in(const State& state, std::uint32_t task) const {
  const Model::Layout& layout = model_.layout();
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = state.cells[layout.requests + place];
    if (cell == 0) return 0;
    if (cell == task + 1) return static_cast<Model::Rank>(state.cells[layout.ranks + place] + 1);
  }
  return 0;
}

bool Stepper::is_settled() const {
  const auto first = before_.cells.begin() + model_.layout().queue;
  return std::all_of(first, first + model_.layout().reactive_count,
                     [](std::uint16_t set) { return set == 0; });
}

// Moves.

bool Stepper::has_move(const Model::Choice& choice) const {
  const std::uint32_t subject = choice.subject;
  const bool is_active = choice.move.kind > Move::Kind::stop &&
                         choice.move.kind < Move::Kind::fault &&
                         has_bit(before_.active.data(), subject);
  switch (choice.move.kind) {
    case Move::Kind::start:
      return true;
    case Move::Kind::stop:
      // Rank 0 is that of reactive starts.
      return before_.cells[subject] != 0 && request_of(subject) > 1;
    case Move::Kind::success: {
      if (!is_active) return false;
      const auto& values = model_.behaviors()[subject].values;
      return std::all_of(values.begin(), values.end(), [&](std::uint32_t value) {
        return !has_bit(before_.values.data(), value) ||
               model_.tasks()[model_.task_of(value)].achieves_goal;
      });
    }
    case Move::Kind::failure:
      return is_active;
    case Move::Kind::situation_change:
      return is_active && is_denied(subject);
    case Move::Kind::fault: {
      if (is_faulty(subject)) return false;
      const Model::Layout& layout = model_.layout();
      const auto first = before_.cells.begin() + layout.faulty;
      const auto faulty = std::count(first, first + layout.faulty_count, std::uint16_t{1});
      return static_cast<std::uint32_t>(faulty) < model_.assumptions().faults;
    }
    case Move::Kind::repair:
      return is_faulty(subject);
    case Move::Kind::variable:
      return value_of(subject) != choice.choice;
    case Move::Kind::own:
      return true;
    case Move::Kind::due:
      return !is_settled();
  }
  return false;
}

bool Stepper::take(const Model::Choice& choice) {
  now_ = before_;
  accepted_ = false;
  const Model::Layout& layout = model_.layout();
  const std::uint32_t subject = choice.subject;
  switch (choice.move.kind) {
    case Move::Kind::start: {
      const auto rank = static_cast<Model::Rank>(choice.choice);
      accepted_ = start(subject, static_cast<Model::Rank>(rank + 1), rank, false);
      break;
    }
    case Move::Kind::stop:
      accepted_ = stop(subject);
      break;
    case Move::Kind::success:
      finish(subject, FinishCause::goal_achieved, Origin::script);
      break;
    case Move::Kind::failure:
      finish(subject, FinishCause::process_failure, Origin::script);
      break;
    case Move::Kind::situation_change:
      finish(subject, FinishCause::situation_change, Origin::script);
      break;
    case Move::Kind::fault:
      now_.cells[layout.faulty + subject] = 1;
      break;
    case Move::Kind::repair:
      now_.cells[layout.faulty + subject] = 0;
      for (const std::uint32_t reactive :
           model_.groups()[model_.behaviors()[subject].group].reactive) {
        enqueue(reactive);
      }
      break;
    case Move::Kind::variable:
      if (!change_situation(model_.variables()[subject].cell,
                            static_cast<std::uint16_t>(choice.choice))) {
        return false;
      }
      break;
    case Move::Kind::own: {
      const std::uint32_t cell = layout.own + model_.behaviors()[subject].own;
      if (!change_situation(cell, now_.cells[cell] == 0 ? 1 : 0)) return false;
      break;
    }
    case Move::Kind::due:
      come_due();
      break;
  }
  close_event();
  settle_queue();
  return true;
}

void Stepper::stay(bool is_situation) {
  now_ = before_;
  joined_set_ = 0;
  if (is_situation) open_event(Verb::situation, Origin::script, none);
  close_event();
}

bool Stepper::would_start(std::uint32_t task, Model::Rank ranks) {
  now_ = before_;
  MoveTrace* const trace = std::exchange(trace_, nullptr);
  const bool accepted = start(task, ranks, 0, false);
  trace_ = trace;
  return accepted;
}

// Events.

bool Stepper::start(std::uint32_t task, Model::Rank ranks, Model::Rank rank, bool is_reactive) {
  open_event(Verb::start, is_reactive ? Origin::reactive : Origin::script, task);
  // A rank + 1, so that "at least ranks + 1" is "higher than all below ranks".
  if (rank_in(now_, task) > ranks) {
    note_outcome(Outcome::rejected);
    return false;
  }
  Trigger trigger;
  trigger.kind = Trigger::Kind::start;
  trigger.group = model_.tasks()[task].group;
  trigger.task = task;
  trigger.ranks = ranks;
  trigger.rank = rank;
  trigger.is_reactive = is_reactive;
  const bool accepted = coordinate(trigger);
  finish_lost();
  return accepted;
}

/// The stop has the priority of the task's request, 0 if it has none.
bool Stepper::stop(std::uint32_t task) {
  open_event(Verb::stop, Origin::script, task);
  if (now_.cells[task] == 0) return false;
  Trigger trigger;
  trigger.kind = Trigger::Kind::stop;
  trigger.group = model_.tasks()[task].group;
  trigger.task = task;
  trigger.ranks = std::max<Model::Rank>(1, rank_in(now_, task));
  const bool accepted = coordinate(trigger);
  finish_lost();
  return accepted;
}

void Stepper::finish(std::uint32_t behavior, FinishCause cause, Origin origin) {
  open_event(Verb::finish, origin, behavior);
  if (!has_bit(now_.active.data(), behavior)) return;
  Trigger trigger;
  trigger.kind = Trigger::Kind::finish;
  trigger.group = model_.behaviors()[behavior].group;
  trigger.behavior = behavior;
  trigger.cause = cause;
  accepted_ = coordinate(trigger);
}

/// Behaviors that a rollback could not activate again finish right after the rejected event.
void Stepper::finish_lost() {
  const bool accepted = accepted_;
  while (!lost_.empty()) {
    const std::uint32_t behavior = lost_.back();
    lost_.pop_back();
    finish(behavior, FinishCause::process_failure, Origin::fault);
  }
  accepted_ = accepted;
}

void Stepper::start_reactive(std::uint32_t reactive) {
  const Model::Layout& layout = model_.layout();
  const std::uint32_t task = model_.reactive()[reactive];
  now_.cells[layout.queue + reactive] = 0;
  std::uint16_t& waits = now_.cells[layout.waiting + reactive];
  const BitRange values = model_.tasks()[task].values;
  bool may_start = !has_bit(now_.running.data(), task) && !excludes_running_task(task);
  if (may_start) {
    may_start = false;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      if (has_bit(now_.available_values.data(), value)) may_start = true;
    }
  }
  if (!may_start) {
    waits = 0;
    return;
  }
  const bool waited = waits != 0;
  const std::size_t events = trace_ != nullptr ? trace_->events.size() : 0;
  // Whatever has a request is protected; see find_domains.
  const bool accepted = start(task, 1, 0, true);
  // An attempt that changes nothing is silent if the task waited before.
  if (!accepted && waited && trace_ != nullptr && trace_->events.size() == events + 1 &&
      trace_->events.back().changes.empty()) {
    trace_->events.pop_back();
  }
}

/// False if the situation is excluded.
bool Stepper::change_situation(std::uint32_t cell, std::uint16_t value) {
  now_.cells[cell] = value;
  if (model_.is_excluded(now_.cells.data())) return false;
  derive_situation(now_);
  open_event(Verb::situation, Origin::script, none);
  for (std::size_t group = 0; group < model_.groups().size(); ++group) {
    const BitRange behaviors = model_.groups()[group].behaviors;
    for (std::uint32_t place = behaviors.begin; place < behaviors.end; ++place) {
      if (!has_bit(now_.available.data(), place) || has_bit(before_.available.data(), place)) {
        continue;
      }
      for (const std::uint32_t reactive : model_.groups()[group].reactive) enqueue(reactive);
      break;
    }
  }
  for (const std::uint32_t behavior : model_.behaviors_in_order()) {
    if (!has_bit(now_.active.data(), behavior) || has_bit(now_.fitting.data(), behavior)) continue;
    finish(behavior, FinishCause::situation_change, Origin::situation);
  }
  return true;
}

/// The first set of the queue: its tasks one after the other in catalog order, as far as they are
/// still in it by then.
void Stepper::come_due() {
  for (const std::uint32_t task : model_.tasks_in_order()) {
    const std::uint32_t reactive = model_.tasks()[task].reactive;
    if (reactive == none || now_.cells[model_.layout().queue + reactive] != 1) continue;
    start_reactive(reactive);
  }
}

/// Counts the sets of the queue from 1 again; those that joined now are the last.
void Stepper::settle_queue() {
  const Model::Layout& layout = model_.layout();
  std::uint16_t* const sets = now_.cells.data() + layout.queue;
  std::uint16_t last = 0;
  joined_set_ = 0;
  for (;;) {
    std::uint16_t next = 0;
    for (std::uint32_t place = 0; place < layout.reactive_count; ++place) {
      if (sets[place] > last && (next == 0 || sets[place] < next)) next = sets[place];
    }
    if (next == 0) return;
    ++last;
    if (next == joined_now) joined_set_ = last;
    if (next == last) continue;
    for (std::uint32_t place = 0; place < layout.reactive_count; ++place) {
      if (sets[place] == next) sets[place] = last;
    }
  }
}

// Coordination (docs/semantics.md, "Domains").

bool Stepper::has_finished(const Trigger& trigger, std::uint32_t task) const {
  if (trigger.kind != Trigger::Kind::finish || now_.cells[task] == 0) return false;
  const std::uint32_t value = model_.tasks()[task].values.begin + now_.cells[task] - 1;
  return model_.behavior_of(value) == trigger.behavior;
}

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
    const Word* const solution = solve(trigger, first);
    if (solution == nullptr) {
      reject(trigger);
      return false;
    }
    find_wanted(solution);
    const std::uint32_t failing = first_failure();
    if (trace_ != nullptr) note_changes(wanted_.data(), trigger.group, failing);
    if (failing == none) {
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
  }
}

/// The first behavior that has to be activated and cannot be, as it is faulty; or none.
std::uint32_t Stepper::first_failure() const {
  if (model_.layout().faulty_count == 0) return none;
  const std::uint16_t* const faulty = now_.cells.data() + model_.layout().faulty;
  for (std::size_t word = 0; word < wanted_.size(); ++word) {
    for (Word bits = wanted_[word] & ~active_[word]; bits != 0; bits &= bits - 1) {
      const auto behavior =
          static_cast<std::uint32_t>(word * 64 + static_cast<unsigned>(std::countr_zero(bits)));
      if (faulty[behavior] != 0) return behavior;
    }
  }
  return none;
}

void Stepper::find_wanted(const Word* solution) {
  std::fill(wanted_.begin(), wanted_.end(), 0);
  for_each_bit(solution, present_.size(),
               [&](std::uint32_t value) { set_bit(wanted_.data(), model_.behavior_of(value)); });
}

/// Escalates the protection of a finish until there is a solution.
const Word* Stepper::solve(const Trigger& trigger, Model::Rank first_ranks) {
  find_domains(trigger);
  Model::Rank ranks = first_ranks;
  for (;;) {
    const Word* const solution = ask(trigger, ranks);
    if (solution != nullptr || trigger.kind != Trigger::Kind::finish) return solution;
    Model::Rank next = 0;
    const BitRange tasks = model_.groups()[trigger.group].tasks;
    for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
      if (has_finished(trigger, task)) continue;
      const Model::Rank rank = rank_in(now_, task);
      if (rank > ranks && (next == 0 || rank < next)) next = rank;
    }
    if (next == 0) return nullptr;
    ranks = next;
  }
}

const Word* Stepper::ask(const Trigger& trigger, Model::Rank ranks) {
  std::fill(must_run_.begin(), must_run_.end(), 0);
  const Model::Layout& layout = model_.layout();
  const BitRange tasks = model_.groups()[trigger.group].tasks;
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    const std::uint32_t task = cell - 1U;
    if (task < tasks.begin || task >= tasks.end || task == trigger.task) continue;
    if (has_finished(trigger, task)) continue;
    if (trigger.is_reactive || now_.cells[layout.ranks + place] >= ranks) {
      set_bit(must_run_.data(), task);
    }
  }
  if (trigger.kind == Trigger::Kind::start) set_bit(must_run_.data(), trigger.task);

  Question question;
  question.group = trigger.group;
  question.finished = trigger.behavior;
  question.domains = domains_.data();
  question.must_run = must_run_.data();
  question.present = present_.data();
  question.requests = requests_;
  return decisions_.find(question);
}

void Stepper::find_domains(const Trigger& trigger) {
  const Model::Group& group = model_.groups()[trigger.group];
  copy_range(now_.available_values.data(), domains_, group.values);
  for (std::size_t word = 0; word < domains_.size(); ++word) {
    domains_[word] |= present_[word] & now_.fitting_values[word];
  }
  if (trigger.kind == Trigger::Kind::finish) {
    // The behavior that has finished may be kept only if it is available.
    for (const std::uint32_t value : model_.behaviors()[trigger.behavior].values) {
      if (has_bit(present_.data(), value) && !has_bit(now_.available_values.data(), value)) {
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
      is_closed = described.start_on_request;
    } else if (has_finished(trigger, task)) {
      is_closed = trigger.cause == FinishCause::goal_achieved;
    }
    if (is_closed) clear_range(domains_.data(), described.values);
  }
  if (!has_excluded_) return;
  for (std::size_t word = 0; word < domains_.size(); ++word) {
    domains_[word] &= ~excluded_values_[word];
  }
}

/// The active requests of the group, the most important one first.
void Stepper::rank_requests(const Trigger& trigger) {
  requests_.clear();
  const Model::Layout& layout = model_.layout();
  const BitRange tasks = model_.groups()[trigger.group].tasks;
  const bool is_start = trigger.kind == Trigger::Kind::start;
  bool is_new_listed = !is_start;
  const auto list_new = [&] {
    requests_.push_back(static_cast<std::uint16_t>(trigger.task));
    is_new_listed = true;
  };
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    const std::uint32_t task = cell - 1U;
    if (!is_new_listed && now_.cells[layout.ranks + place] < trigger.ranks) list_new();
    if (task < tasks.begin || task >= tasks.end || task == trigger.task) continue;
    if (trigger.cause == FinishCause::goal_achieved && has_finished(trigger, task)) continue;
    requests_.push_back(static_cast<std::uint16_t>(task));
  }
  if (!is_new_listed) list_new();
}

/// Rolls back; what cannot be activated again is lost.
void Stepper::reject(const Trigger& trigger) {
  note_outcome(Outcome::rejected);
  if (model_.layout().faulty_count > 0) {
    const std::uint16_t* const faulty = now_.cells.data() + model_.layout().faulty;
    if (trace_ != nullptr) note_changes(was_active_.data(), trigger.group, none);
    for_each_bit(was_active_.data(), was_active_.size(), [&](std::uint32_t behavior) {
      if (!has_bit(active_.data(), behavior) && faulty[behavior] != 0) lost_.push_back(behavior);
    });
    std::sort(lost_.begin(), lost_.end(),
              [&](auto a, auto b) { return model_.behaviors()[a].id > model_.behaviors()[b].id; });
  }
  if (!trigger.is_reactive) return;
  now_.cells[model_.layout().waiting + model_.tasks()[trigger.task].reactive] = 1;
}

void Stepper::accept(const Trigger& trigger, const Word* solution) {
  note_outcome(Outcome::accepted);
  const Model::Group& group = model_.groups()[trigger.group];
  started_.clear();
  stopped_.clear();
  stopped_by_others_.clear();
  const auto& tasks = model_.tasks();
  for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
    const BitRange values = tasks[task].values;
    std::uint16_t after = 0;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      if (has_bit(solution, value)) after = static_cast<std::uint16_t>(value - values.begin + 1);
    }
    std::uint16_t& cell = now_.cells[task];
    if (after == 0 && cell != 0) {
      const bool finished = has_finished(trigger, task);
      stopped_.push_back(task);
      note_stop(task, finished ? trigger.cause : FinishCause::interrupted);
      const bool is_own_end =
          finished ? trigger.cause != FinishCause::situation_change : task == trigger.task;
      if (!is_own_end) stopped_by_others_.push_back(task);
    } else if (after != 0 && cell == 0) {
      started_.push_back(task);
    }
    cell = after;
  }
  derive(now_, false);
  update_requests(trigger);
  update_queue(trigger);
}

void Stepper::update_requests(const Trigger& trigger) {
  const Model::Layout& layout = model_.layout();
  std::uint16_t* const requests = now_.cells.data() + layout.requests;
  std::uint16_t* const ranks = now_.cells.data() + layout.ranks;
  std::uint32_t count = 0;
  const bool is_start = trigger.kind == Trigger::Kind::start;
  for (std::uint32_t place = 0; place < layout.request_count && requests[place] != 0; ++place) {
    const std::uint32_t task = requests[place] - 1U;
    if (now_.cells[task] == 0 || (is_start && task == trigger.task)) continue;
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

bool Stepper::excludes_running_task(std::uint32_t task) const {
  const auto& rivals = model_.tasks()[task].rivals;
  return std::any_of(rivals.begin(), rivals.end(),
                     [&](std::uint32_t rival) { return has_bit(now_.running.data(), rival); });
}

void Stepper::enqueue(std::uint32_t reactive) {
  std::uint16_t& set = now_.cells[model_.layout().queue + reactive];
  if (set == 0 && !has_bit(now_.running.data(), model_.reactive()[reactive])) set = joined_now;
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
    for (const std::uint32_t rival : tasks[task].reactive_rivals) queue[rival] = 0;
  }
  retry_waiting(trigger.group);
}

/// The tasks of the group that wait try again after an accepted event.
void Stepper::retry_waiting(std::uint32_t group) {
  for (const std::uint32_t reactive : model_.groups()[group].reactive) {
    std::uint16_t& waits = now_.cells[model_.layout().waiting + reactive];
    if (waits == 0) continue;
    const std::uint32_t task = model_.reactive()[reactive];
    if (has_bit(now_.running.data(), task) || excludes_running_task(task)) {
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
    const bool fails =
        is_rollback ? now_.cells[model_.layout().faulty + behavior] != 0 : behavior == failing;
    changes.push_back({behavior, true, !fails});
    if (fails && !is_rollback) return;
  }
}

void Stepper::note_stop(std::uint32_t task, FinishCause cause) {
  if (trace_ != nullptr) trace_->events.back().stopped.emplace_back(task, cause);
}

}  // namespace cbc
