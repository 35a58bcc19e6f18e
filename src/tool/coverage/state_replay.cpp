#include "coverage/state_replay.h"

#include <algorithm>

namespace cbc {
namespace {

/// The present instant. What is in the queue comes due in the microseconds after it, set by set.
constexpr Microseconds present = second;

class WatchedMove final : public EventListener {
 public:
  explicit WatchedMove(GoalWatch& watch) : watch_(watch) {}

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override {
    watch_.on_decision(record, circumstances, solution);
    if (solution != nullptr && circumstances.trigger.is_reactive) {
      started.push_back(circumstances.trigger.task);
    }
  }
  void on_event(const EventRecord& record) override {
    watch_.on_event(record, coordinator->state());
  }

  const Coordinator* coordinator = nullptr;
  std::vector<TaskId> started;

 private:
  GoalWatch& watch_;
};

}  // namespace

void StateReplay::load(const Stepper& stepper) {
  const Model::Layout& layout = model_.layout();
  const CompiledCatalog& catalog = model_.catalog();
  const std::uint16_t* const cells = stepper.cells();
  state_ = {};
  state_.now = present;
  state_.reactive_delay = CoordinatorOptions{}.reactive_delay;
  state_.timeouts = false;
  state_.events = layout.request_count;
  for (std::uint32_t task = 0; task < model_.tasks().size(); ++task) {
    if (cells[task] == 0) continue;
    Snapshot::RunningTask& entry = state_.running.emplace_back();
    entry.task = model_.tasks()[task].id;
    entry.value_index = cells[task] - 1U;
    for (std::uint32_t place = 0; place < layout.request_count; ++place) {
      if (cells[layout.requests + place] != task + 1) continue;
      // The later one is the more important one of two with the same priority.
      entry.request = Request{
          model_.priority_of(cells[layout.ranks + place]), layout.request_count - place, {}};
    }
  }
  for_each_bit(stepper.active().data(), stepper.active().size(), [&](std::uint32_t behavior) {
    state_.active.emplace_back(model_.behaviors()[behavior].id, 0);
  });
  for (std::uint32_t behavior = 0; behavior < model_.behaviors().size(); ++behavior) {
    if (stepper.is_denied(behavior)) state_.denied.push_back(model_.behaviors()[behavior].id);
    if (stepper.is_faulty(behavior)) state_.faulty.push_back(model_.behaviors()[behavior].id);
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    const std::uint32_t known = model_.find_variable(variable);
    state_.variables.push_back(known == none ? initial_value(model_.assumptions(), variable)
                                             : stepper.value_of(known));
  }
  for (std::uint32_t reactive = 0; reactive < layout.reactive_count; ++reactive) {
    const TaskId task = model_.tasks()[model_.reactive()[reactive]].id;
    const std::uint16_t set = cells[layout.queue + reactive];
    if (set != 0) state_.queue.emplace_back(task, present + set);
    if (cells[layout.waiting + reactive] != 0) state_.waiting.push_back(task);
  }
}

void StateReplay::take(const Move& move) {
  WatchedMove watched(watch_);
  CoordinatorOptions options;
  options.timeouts = false;
  options.find_conflicts = false;
  Coordinator coordinator(model_.catalog(), options, watched);
  watched.coordinator = &coordinator;
  coordinator.resume(state_);
  watch_.begin(coordinator.state());
  const VariableValue value{move.subject, static_cast<std::uint32_t>(move.choice)};
  const Availability availability{move.subject, move.choice != 0};
  Event event;
  event.subject = move.subject;
  event.verb = Verb::finish;
  switch (move.kind) {
    case Move::Kind::start:
      event.verb = Verb::start;
      event.priority = move.choice;
      break;
    case Move::Kind::stop:
      event.verb = Verb::stop;
      break;
    case Move::Kind::success:
      event.cause = FinishCause::goal_achieved;
      break;
    case Move::Kind::failure:
      event.cause = FinishCause::process_failure;
      break;
    case Move::Kind::situation_change:
      event.cause = FinishCause::situation_change;
      break;
    case Move::Kind::fault:
      event.verb = Verb::fault;
      break;
    case Move::Kind::repair:
      event.verb = Verb::repair;
      break;
    case Move::Kind::variable:
      event.verb = Verb::situation;
      event.variables = {&value, 1};
      break;
    case Move::Kind::own:
      event.verb = Verb::situation;
      event.situation = {&availability, 1};
      break;
    case Move::Kind::due:
      // Before the second set.
      static_cast<void>(coordinator.advance_to(present + 2));
      break;
  }
  if (move.kind != Move::Kind::due) static_cast<void>(coordinator.handle(event));
  started_ = std::move(watched.started);
  gave_way_.clear();
  for (const std::uint32_t task : model_.reactive()) {
    const TaskId id = model_.tasks()[task].id;
    if (watch_.has_given_way(id)) gave_way_.push_back(id);
  }
}

}  // namespace cbc
