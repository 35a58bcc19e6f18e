// A state is explored by hand in the plainest way: a coordinator takes it up, takes one event, and
// the states before and after are compared; then it takes up the state again for the next event.
// So whatever a move does is what the same event would do in a mission. To solve only the problem
// of the event would be quicker, but would not tell what a failed activation, or a behavior that no
// longer fits, leads to.
#include "solve/engine/what_if.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

namespace cbc {

KeptEvent::KeptEvent(const ExplainedRecord& of, const Step* its_step) : record(of), step(its_step) {
  if (of.search == nullptr) return;
  search = std::make_unique<const SearchRecord>(*of.search);
  record.search = search.get();
}

namespace {

/// Keeps the state after an event.
class MomentKeeper final : public RunListener {
 public:
  explicit MomentKeeper(std::optional<std::uint64_t> wanted) : wanted_(wanted) {}

  void watch(const Runner& runner) { runner_ = &runner; }

  void on_event(const ExplainedRecord& record, const Step* step, const State& /*state*/) override {
    const bool is_part = moment_ && moment_->event && follows_at_once(record) &&
                         moment_->event->record.index + 1 == record.index;
    if (!wanted_) {
      last_.emplace(record, step);
    } else if (record.index == *wanted_ || is_part) {
      keep(KeptEvent(record, step));
    }
  }

  /// The present state; after the last event if none is wanted.
  void keep_present() { keep(std::move(last_)); }

  [[nodiscard]] bool has_moment() const { return moment_.has_value(); }
  [[nodiscard]] std::optional<MissionMoment> take() { return std::move(moment_); }

 private:
  void keep(std::optional<KeptEvent> event) {
    moment_.emplace(MissionMoment{runner_->snapshot(), std::move(event)});
  }

  const std::optional<std::uint64_t> wanted_;
  const Runner* runner_ = nullptr;
  std::optional<KeptEvent> last_;
  std::optional<MissionMoment> moment_;
};

}  // namespace

MomentSearch find_moment(const CompiledCatalog& catalog, const Script& script,
                         const CoordinatorOptions& options, std::optional<std::uint64_t> event) {
  MomentKeeper keeper(event);
  CoordinatorOptions until_moment = options_of(script, options);
  // The answer is there: what the clock brings later need not be waited for.
  until_moment.is_stopped = [&keeper] { return keeper.has_moment(); };
  Runner runner(catalog, until_moment, keeper, {.rejections = true});
  keeper.watch(runner);
  runner.begin(script.situation);
  bool goes_on = true;
  if (event == 0) keeper.keep_present();
  for (const Step& step : script.steps) {
    if (!goes_on || keeper.has_moment()) break;
    goes_on = runner.take(step);
  }
  if (goes_on && !keeper.has_moment()) goes_on = runner.settle();
  if (goes_on && !event) keeper.keep_present();
  return {keeper.take(), runner.result()};
}

MoveChoice choice_of(const CompiledCatalog& catalog, const Script& script) {
  std::set<std::uint32_t> tasks;
  std::set<std::int32_t> priorities;
  std::set<std::uint32_t> behaviors;
  const auto add = [&behaviors](const Situation& situation) {
    for (const Availability& entry : situation.availability) behaviors.insert(entry.behavior);
  };
  for (const TaskId task : catalog.task_ids) {
    if (catalog.tasks[task].start_on_request != 0 && catalog.rules_of(task).requestable) {
      tasks.insert(catalog.tasks[task].catalog_index);
    }
  }
  add(script.situation);
  for (const Step& step : script.steps) {
    if (step.expect) continue;
    add(step.situation);
    if (step.verb != Verb::start) continue;
    tasks.insert(step.subject);
    priorities.insert(step.priority.value_or(1));
  }
  if (priorities.empty()) priorities.insert(1);
  return {{tasks.begin(), tasks.end()},
          {priorities.begin(), priorities.end()},
          {behaviors.begin(), behaviors.end()}};
}

namespace {

Step make_step(Verb verb, std::uint32_t subject) {
  Step step;
  step.verb = verb;
  step.subject = subject;
  return step;
}

/// Whether the behavior can end with success: all tasks that it performs have goals.
bool has_goal(const CompiledCatalog& catalog, const State& state, BehaviorId behavior) {
  return std::all_of(
      catalog.performs[behavior].begin(), catalog.performs[behavior].end(), [&](ValueId value) {
        const TaskId task = catalog.task_of(value);
        return state.behavior(task) != behavior || catalog.tasks[task].keep_running == 0;
      });
}

void add_finishes(const CompiledCatalog& catalog, const State& state, FinishCause cause,
                  std::vector<Step>& steps) {
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (!state.is_active(behavior)) continue;
    if (cause == FinishCause::goal_achieved && !has_goal(catalog, state, behavior)) continue;
    if (cause == FinishCause::situation_change && !state.is_denied(behavior)) continue;
    Step step = make_step(Verb::finish, catalog.behaviors[behavior].catalog_index);
    step.cause = cause;
    steps.push_back(std::move(step));
  }
}

void add_situations(const CompiledCatalog& catalog, const State& state, const MoveChoice& choice,
                    std::vector<Step>& steps) {
  const auto add = [&](Situation situation) {
    Step step = make_step(Verb::situation, 0);
    step.situation = std::move(situation);
    steps.push_back(std::move(step));
  };
  for (const std::uint32_t index : choice.behaviors) {
    add({{{index, state.is_denied(catalog.behavior_ids[index])}}, {}});
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    for (std::uint32_t value = 0; value < catalog.variables[variable].value_count; ++value) {
      if (value != state.value_of(variable)) add({{}, {{variable, value}}});
    }
  }
}

}  // namespace

std::vector<Step> list_moves(const CompiledCatalog& catalog, const State& state,
                             const MoveChoice& choice) {
  std::vector<Step> steps;
  for (const std::uint32_t task : choice.tasks) {
    for (const std::int32_t priority : choice.priorities) {
      steps.push_back(make_step(Verb::start, task));
      steps.back().priority = priority;
    }
  }
  for (std::uint32_t index = 0; index < catalog.task_ids.size(); ++index) {
    const TaskId task = catalog.task_ids[index];
    if (state.is_running(task) || state.is_suspended(task)) {
      steps.push_back(make_step(Verb::stop, index));
    }
  }
  for (const FinishCause cause :
       {FinishCause::goal_achieved, FinishCause::process_failure, FinishCause::situation_change}) {
    add_finishes(catalog, state, cause, steps);
  }
  for (std::uint32_t index = 0; index < catalog.behaviors.size(); ++index) {
    const BehaviorId behavior = catalog.behavior_ids[index];
    if (state.is_active(behavior) && !state.is_faulty(behavior)) {
      steps.push_back(make_step(Verb::fault, index));
    }
  }
  for (std::uint32_t index = 0; index < catalog.behaviors.size(); ++index) {
    const BehaviorId behavior = catalog.behavior_ids[index];
    if (state.is_faulty(behavior) || state.has_failed(behavior)) {
      steps.push_back(make_step(Verb::repair, index));
    }
  }
  add_situations(catalog, state, choice, steps);
  return steps;
}

namespace {

/// Whether a task that goes on running has a request that it did not have before.
bool is_requested_anew(const Request* before, const Request* after) {
  return after != nullptr && (before == nullptr || before->priority != after->priority);
}

bool fails(const PossibleMove& move, BehaviorId behavior) {
  return std::any_of(move.events.begin(), move.events.end(), [behavior](const auto& event) {
    const std::vector<Change>& changes = event.record.changes;
    return std::any_of(changes.begin(), changes.end(), [behavior](const Change& change) {
      return change.behavior == behavior && !change.success;
    });
  });
}

}  // namespace

MoveEffects effects_of(const CompiledCatalog& catalog, const PossibleMove& move) {
  MoveEffects effects;
  const State& state = move.after();
  for (std::uint32_t index = 0; index < catalog.task_ids.size(); ++index) {
    const TaskId task = catalog.task_ids[index];
    const BehaviorId before = move.before.behavior(task);
    const BehaviorId after = state.behavior(task);
    if (before == none && after != none) effects.started.push_back(task);
    if (before != none && after == none) effects.stopped.push_back(task);
    if (before != none && after != none) {
      if (before != after) effects.changed.push_back(task);
      if (is_requested_anew(move.before.find_request(task), state.find_request(task))) {
        effects.requested.push_back(task);
      }
    }
    if (state.is_suspended(task) && !move.before.is_suspended(task)) {
      effects.suspended.push_back(task);
    }
    if (move.before.is_suspended(task) && !state.is_suspended(task) && after == none) {
      effects.ended.push_back(task);
    }
    if (state.queue().has(index) && !move.before.queue().has(index)) effects.queued.push_back(task);
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (fails(move, behavior)) effects.failed.push_back(behavior);
    if (state.has_failed(behavior) && !move.before.has_failed(behavior)) {
      effects.not_retried.push_back(behavior);
    }
    if (move.before.has_failed(behavior) && !state.has_failed(behavior)) {
      effects.forgiven.push_back(behavior);
    }
  }
  return effects;
}

namespace {

/// Makes moves of events: each with those that follow from it at once.
class MoveRecorder final : public EventListener {
 public:
  MoveRecorder(const CompiledCatalog& catalog, const TakeMove& take)
      : take_(take), inquiry_(catalog, {.rejections = true}) {}

  /// The next events happen from here on. `step`: the scripted one, or null.
  void begin(const Coordinator& coordinator, const Step* step) {
    coordinator_ = &coordinator;
    step_ = step;
    count_ = 0;
    before_.emplace(coordinator.state());
  }

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    inquiry_.on_decision(record, circumstances, solution);
  }
  void on_event(const EventRecord& record) override {
    if (!follows_at_once(record)) end();
    const State& state = coordinator_->state();
    events_.emplace_back(inquiry_.on_event(record, state),
                         record.origin == Origin::script ? step_ : nullptr, state);
    ++count_;
  }

  /// Passes on what has not been passed on yet.
  void end() {
    if (events_.empty()) return;
    take_({*before_, events_});
    before_.emplace(events_.back().after);
    events_.clear();
  }

  /// Events since the beginning.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  const TakeMove& take_;
  Inquiry inquiry_;
  const Coordinator* coordinator_ = nullptr;
  const Step* step_ = nullptr;
  std::size_t count_ = 0;
  std::optional<State> before_;
  std::vector<PossibleMove::Event> events_;
};

}  // namespace

RunResult try_moves(const CompiledCatalog& catalog, const CoordinatorOptions& options,
                    const Snapshot& snapshot, std::span<const Step> steps, const TakeMove& take) {
  using Status = Coordinator::Status;
  MoveRecorder recorder(catalog, take);
  Coordinator coordinator(catalog, options, recorder);
  Status status = Status::ok;
  for (const Step& step : steps) {
    coordinator.resume(snapshot);
    recorder.begin(coordinator, &step);
    status = coordinator.handle(event_of(step));
    if (options.is_stopped && options.is_stopped()) status = Status::stopped;
    if (status != Status::ok) break;
    recorder.end();
  }
  if (status == Status::ok) {
    coordinator.resume(snapshot);
    recorder.begin(coordinator, nullptr);
    // What comes due may be dropped, which is no event.
    while (status == Status::ok && recorder.count() == 0 && coordinator.next_due()) {
      status = coordinator.advance_to(*coordinator.next_due());
      if (status == Status::ok) status = coordinator.settle();
    }
    recorder.end();
  }
  RunResult result;
  result.status = status;
  result.internal_error = coordinator.internal_error();
  return result;
}

}  // namespace cbc
