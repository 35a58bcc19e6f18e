// What the coordinator does with one event, as a function from a packed state to the next one: no
// records, no names, no clock. Time is only an order. All reactive tasks wait equally long, so it
// is enough to know in which order they joined the queue; and a timeout is a failure, which may
// come at any moment. To keep the clocks, as timed automata do (R. Alur and D. L. Dill, "A theory
// of timed automata", Theoretical Computer Science 126 (1994)), would rule out timeouts that cannot
// come, for very many times as many states.
//
// A coordinator that resumes a snapshot could make each move as well, and nothing would be written
// twice. But explorations make millions of moves, most of which need no more than a few words and
// an answer that Decisions remembers. Property tests explore with coordinators, and compare.

#include "explore/moves/stepper.h"

#include <algorithm>

namespace cbc {

Stepper::Stepper(const Model& model, const Options& options)
    : model_(model),
      reduce_(options.reduce),
      decisions_(model, options.decision_bytes, options.on_decision),
      in_x_(model.layout().failed_count, InX::as_before),
      needs_(model.catalog()),
      needs_of_others_(model.catalog()) {
  const std::size_t values = words_for(model.value_count());
  const std::size_t tasks = words_for(model.tasks().size());
  const std::size_t behaviors = words_for(model.behaviors().size());
  before_.cells.resize(model.layout().cells);
  before_.values.resize(values);
  before_.running.resize(tasks);
  before_.active.resize(behaviors);
  before_.possible.clear(model);
  excluded_values_.resize(values);
  domains_.resize(values);
  present_.resize(values);
  must_run_.resize(tasks);
  values_after_.resize(model.tasks().size());
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
  // Those of a higher priority first, then those that are earlier in the catalog.
  for (const std::uint32_t task : model.tasks_in_order()) {
    const std::uint32_t reactive = model.tasks()[task].reactive;
    if (reactive != none) order_of_reactions_.push_back(reactive);
  }
  const auto rank = [&](std::uint32_t reactive) {
    return model.tasks()[model.reactive()[reactive]].reactive_rank;
  };
  std::stable_sort(order_of_reactions_.begin(), order_of_reactions_.end(),
                   [&](auto a, auto b) { return rank(a) > rank(b); });
}

// The state.

void Stepper::load(const std::uint32_t* packed) {
  model_.unpack(packed, before_.cells.data());
  derive(before_);
}

void Stepper::derive(State& state) const {
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
}

void Stepper::Possible::clear(const Model& model) {
  for (std::vector<Word>* const behaviors : {&fitting, &available}) {
    behaviors->assign(words_for(model.behaviors().size()), 0);
  }
  for (std::vector<Word>* const values : {&fitting_values, &available_values}) {
    values->assign(words_for(model.value_count()), 0);
  }
}

void Stepper::Possible::add(const Model& model, std::uint32_t behavior, bool is_available) {
  set_bit(fitting.data(), behavior);
  if (is_available) set_bit(available.data(), behavior);
  for (const std::uint32_t value : model.behaviors()[behavior].values) {
    set_bit(fitting_values.data(), value);
    if (is_available) set_bit(available_values.data(), value);
  }
}

void Stepper::Possible::remove_available(const Model& model, std::uint32_t behavior) {
  clear_bit(available.data(), behavior);
  for (const std::uint32_t value : model.behaviors()[behavior].values) {
    clear_bit(available_values.data(), value);
  }
}

void Stepper::Possible::remove(const Model& model, std::uint32_t behavior) {
  remove_available(model, behavior);
  clear_bit(fitting.data(), behavior);
  for (const std::uint32_t value : model.behaviors()[behavior].values) {
    clear_bit(fitting_values.data(), value);
  }
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

bool Stepper::may_have(const Model::Choice& choice) const {
  const std::uint32_t subject = choice.subject;
  const bool is_active = choice.move.kind > Move::Kind::stop &&
                         choice.move.kind < Move::Kind::fault &&
                         has_bit(before_.active.data(), subject);
  switch (choice.move.kind) {
    case Move::Kind::start:
      return true;
    case Move::Kind::stop:
      return request_of(subject) > 0;
    case Move::Kind::success: {
      if (!is_active) return false;
      const auto& values = model_.behaviors()[subject].values;
      return std::all_of(values.begin(), values.end(), [&](std::uint32_t value) {
        return !has_bit(before_.values.data(), value) ||
               model_.tasks()[model_.task_of(value)].achieves_goal;
      });
    }
    case Move::Kind::failure:
    case Move::Kind::situation_change:
      return is_active;
    case Move::Kind::due:
      return !is_settled();
    default:
      return true;
  }
}

void Stepper::take(const Model::Choice& choice, const Possible& possible,
                   EnvironmentOracle& environment) {
  now_ = before_;
  now_.possible = possible;
  accepted_ = false;
  environment_ = &environment;
  std::fill(in_x_.begin(), in_x_.end(), InX::as_before);
  make(choice);
  note_changes_of_x();
  environment_ = nullptr;
}

/// What comes of a move in the environment that it leads to.
void Stepper::make(const Model::Choice& choice) {
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
      break;
    case Move::Kind::repair:
      if (!is_confirmed(EnvironmentQuery::Kind::is_broken, subject)) break;
      for (const std::uint32_t reactive :
           model_.groups()[model_.behaviors()[subject].group].reactive) {
        enqueue(reactive);
      }
      reconsider(model_.behaviors()[subject].group, Origin::repair);
      break;
    case Move::Kind::variable:
    case Move::Kind::own:
    case Move::Kind::together:
      adapt();
      break;
    case Move::Kind::due:
      come_due();
      break;
  }
  close_event();
  settle_queue();
  if (reduce_) merge_orders();
}

void Stepper::stay() {
  now_ = before_;
  joined_set_ = 0;
  changes_of_x_.clear();
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
  if (!is_reactive) forgive(task);
  const bool accepted = coordinate(trigger);
  end_forgiving();
  finish_lost();
  return accepted;
}

/// The stop has the priority of the task's request, 0 if it has none.
bool Stepper::stop(std::uint32_t task) {
  open_event(Verb::stop, Origin::script, task);
  if (now_.cells[task] == 0) {
    if (rank_in(now_, task) == 0) return false;
    end_suspended_request(task);
    note_outcome(Outcome::accepted);
    return true;
  }
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
  if (cause == FinishCause::process_failure) note_failure(behavior);
  accepted_ = coordinate(trigger);
}

/// Decides a group anew if a task of it may improve at once, or waits to be resumed.
void Stepper::reconsider(std::uint32_t group, Origin origin) {
  if (!has_reason_to_reconsider(group)) return;
  open_event(Verb::reconsider, origin, none);
  Trigger trigger;
  trigger.kind = Trigger::Kind::reconsider;
  trigger.group = group;
  trigger.ranks = 1;
  const bool accepted = coordinate(trigger);
  if (!accepted && !has_excluded_ && trace_ != nullptr) trace_->events.pop_back();
  finish_lost();
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
  bool may_start = false;
  if (!has_bit(now_.running.data(), task) && !is_blocked(task)) {
    for (std::uint32_t value = values.begin; value < values.end && !may_start; ++value) {
      may_start = has_bit(now_.possible.available_values.data(), value) &&
                  is_available_now(model_.behavior_of(value));
    }
  }
  if (!may_start) {
    waits = 0;
    return;
  }
  const bool waited = waits != 0;
  const std::size_t events = trace_ != nullptr ? trace_->events.size() : 0;
  // What has a request as high is protected; see ask().
  const Model::Rank rank = model_.tasks()[task].reactive_rank;
  const bool accepted = start(task, static_cast<Model::Rank>(rank + 1), rank, true);
  // An attempt that changes nothing is silent if the task waited before.
  if (!accepted && waited && trace_ != nullptr && trace_->events.size() == events + 1 &&
      trace_->events.back().changes.empty()) {
    trace_->events.pop_back();
  }
}

/// What follows a change of the situation.
void Stepper::adapt() {
  open_event(Verb::situation, Origin::script, none);
  for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
    const auto& reactive = model_.groups()[group].reactive;
    const bool matters = std::any_of(reactive.begin(), reactive.end(),
                                     [&](std::uint32_t one) { return may_enqueue(one); });
    if (!matters || !gains(group)) continue;
    for (const std::uint32_t one : reactive) enqueue(one);
  }
  for (const std::uint32_t behavior : model_.behaviors_in_order()) {
    if (!has_bit(now_.active.data(), behavior) || fits(behavior)) continue;
    finish(behavior, FinishCause::situation_change, Origin::situation);
  }
  for (std::uint32_t group = 0; group < model_.groups().size(); ++group) {
    if (has_reason_to_reconsider(group) && gains(group)) reconsider(group, Origin::situation);
  }
}

// The environment.

bool Stepper::fits(std::uint32_t behavior) {
  if (!has_bit(now_.possible.fitting.data(), behavior)) return false;
  if (is_confirmed(EnvironmentQuery::Kind::fits, behavior)) return true;
  now_.possible.remove(model_, behavior);
  return false;
}

bool Stepper::is_available_now(std::uint32_t behavior) {
  if (!has_bit(now_.possible.available.data(), behavior)) return false;
  const std::uint32_t failed = model_.behaviors()[behavior].failed;
  const bool is_out_of_x =
      failed != none && (in_x_[failed] == InX::no || in_x_[failed] == InX::forgiven);
  if (is_confirmed(
          is_out_of_x ? EnvironmentQuery::Kind::permitted : EnvironmentQuery::Kind::available,
          behavior)) {
    return true;
  }
  now_.possible.remove_available(model_, behavior);
  return false;
}

bool Stepper::is_confirmed(EnvironmentQuery::Kind kind, std::uint32_t behavior) const {
  return environment_->holds({kind, behavior});
}

bool Stepper::is_faulty_now(std::uint32_t behavior) const {
  return model_.behaviors()[behavior].fault != none &&
         environment_->holds({EnvironmentQuery::Kind::faulty, behavior});
}

/// Whether a behavior of the group has become available.
bool Stepper::gains(std::uint32_t group) const {
  return environment_->holds({EnvironmentQuery::Kind::gains, group});
}

/// The first set of the queue: its tasks one after the other, as far as they are still in it by
/// then.
void Stepper::come_due() {
  for (const std::uint32_t reactive : order_of_reactions_) {
    if (now_.cells[model_.layout().queue + reactive] != 1) continue;
    close_event();  // before this one leaves the queue, perhaps silently
    start_reactive(reactive);
  }
}

// Failures that are remembered.

/// The behavior joins X, unless it is tried again at any event.
void Stepper::note_failure(std::uint32_t behavior) {
  const std::uint32_t failed = model_.behaviors()[behavior].failed;
  if (failed == none) return;
  in_x_[failed] = InX::yes;
  now_.possible.remove_available(model_, behavior);
}

/// See Coordinator::forgive(). Whether they were in X need not be known.
void Stepper::forgive(std::uint32_t task) {
  if (in_x_.empty()) return;
  const CompiledCatalog& catalog = model_.catalog();
  const Model::Group& group = model_.groups()[model_.tasks()[task].group];
  const TaskId id = model_.tasks()[task].id;
  const auto of_task = catalog.task_cliques[id];
  const auto excludes = [&](TaskId other) {
    const auto of_other = catalog.task_cliques[other];
    return other != id && std::find_first_of(of_task.begin(), of_task.end(), of_other.begin(),
                                             of_other.end()) != of_task.end();
  };
  needs_.clear();
  needs_.add(id);
  needs_of_others_.clear();
  for (std::uint32_t other = group.tasks.begin; other < group.tasks.end; ++other) {
    const TaskId other_id = model_.tasks()[other].id;
    if (now_.cells[other] != 0 && !excludes(other_id)) needs_of_others_.add(other_id);
  }
  for (std::uint32_t behavior = group.behaviors.begin; behavior < group.behaviors.end; ++behavior) {
    const Model::Behavior& one = model_.behaviors()[behavior];
    if (one.failed == none || one.retry != Retry::when_started) continue;
    bool is_needed = false;
    bool is_used = false;
    for (const std::uint32_t value : one.values) {
      const std::uint32_t performed = model_.task_of(value);
      const TaskId performed_id = model_.tasks()[performed].id;
      is_needed |= needs_.has(performed_id);
      is_used |= now_.cells[performed] != 0 || needs_of_others_.has(performed_id);
    }
    if (is_needed && !is_used) in_x_[one.failed] = InX::forgiven;
  }
}

/// Those that are not active now are in X as before.
void Stepper::end_forgiving() {
  if (in_x_.empty()) return;
  for (std::uint32_t behavior = 0; behavior < model_.behaviors().size(); ++behavior) {
    const std::uint32_t failed = model_.behaviors()[behavior].failed;
    if (failed == none || in_x_[failed] != InX::forgiven) continue;
    in_x_[failed] = has_bit(now_.active.data(), behavior) ? InX::no : InX::as_before;
  }
}

void Stepper::note_changes_of_x() {
  changes_of_x_.clear();
  for (std::uint32_t failed = 0; failed < in_x_.size(); ++failed) {
    if (in_x_[failed] != InX::as_before) {
      changes_of_x_.emplace_back(failed, in_x_[failed] == InX::yes);
    }
  }
}

// Suspended requests.

std::uint32_t Stepper::suspended_after() const {
  const Model::Layout& layout = model_.layout();
  std::uint32_t count = 0;
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    const std::uint16_t cell = now_.cells[layout.requests + place];
    if (cell == 0) break;
    if (now_.cells[cell - 1U] == 0) ++count;
  }
  return count;
}

void Stepper::end_suspended_request(std::uint32_t task) {
  const Model::Layout& layout = model_.layout();
  std::uint16_t* const requests = now_.cells.data() + layout.requests;
  std::uint16_t* const ranks = now_.cells.data() + layout.ranks;
  std::uint32_t count = 0;
  for (std::uint32_t place = 0; place < layout.request_count; ++place) {
    if (requests[place] == task + 1) continue;
    requests[count] = requests[place];
    ranks[count++] = ranks[place];
  }
  std::fill(requests + count, requests + layout.request_count, std::uint16_t{0});
  std::fill(ranks + count, ranks + layout.request_count, std::uint16_t{0});
}

bool Stepper::may_improve(std::uint32_t task) const {
  return now_.cells[task] != 0 && model_.tasks()[task].improve == Improve::at_once;
}

bool Stepper::has_reason_to_reconsider(std::uint32_t group) const {
  if (!model_.groups()[group].is_reconsidered) return false;
  const BitRange tasks = model_.groups()[group].tasks;
  for (std::uint32_t task = tasks.begin; task < tasks.end; ++task) {
    if (may_improve(task)) return true;
    if (now_.cells[task] == 0 && rank_in(now_, task) > 0) return true;
  }
  return false;
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

/// Sorts requests of equal priority by interaction class, and keeps the order in each class.
void Stepper::merge_orders() {
  const Model::Layout& layout = model_.layout();
  const auto& classes = model_.interaction_classes();
  std::uint16_t* const requests = now_.cells.data() + layout.requests;
  const std::uint16_t* const ranks = now_.cells.data() + layout.ranks;
  for (std::uint32_t end = 1; end < layout.request_count && requests[end] != 0; ++end) {
    for (std::uint32_t place = end;
         place > 0 && ranks[place] == ranks[place - 1] &&
         classes[requests[place] - 1U] < classes[requests[place - 1] - 1U];
         --place) {
      std::swap(requests[place], requests[place - 1]);
    }
  }
}

}  // namespace cbc
