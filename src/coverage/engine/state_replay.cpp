#include "coverage/engine/state_replay.h"

#include <algorithm>

#include "core/script/runner.h"
#include "verify/engine/witness.h"

namespace cbc {
namespace {

/// The present instant. What is in the queue comes due in the microseconds after it, set by set.
constexpr Microseconds present_instant = second;

CoordinatorOptions without_times() {
  CoordinatorOptions options;
  options.timeouts = false;
  options.find_conflicts = false;
  return options;
}

}  // namespace

StateReplay::StateReplay(const Model& model, GoalWatch& watch)
    : model_(model), watch_(watch), coordinator_(model.catalog(), without_times(), *this) {}

void StateReplay::load(const Stepper& stepper) {
  const Model::Layout& layout = model_.layout();
  const CompiledCatalog& catalog = model_.catalog();
  const std::uint16_t* const cells = stepper.cells();
  state_ = {};
  state_.now = present_instant;
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
    if (set != 0) state_.queue.emplace_back(task, present_instant + set);
    if (cells[layout.waiting + reactive] != 0) state_.waiting.push_back(task);
  }
  coordinator_.resume(state_);
  watch_.begin(coordinator_.state());
}

void StateReplay::take(const Move& move) {
  coordinator_.resume(state_);
  watch_.begin(coordinator_.state());
  started_.clear();
  if (move.kind == Move::Kind::due) {
    // Before the second set.
    static_cast<void>(coordinator_.advance_to(present_instant + 2));
  } else {
    const Step step = step_of(move);
    static_cast<void>(coordinator_.handle(event_of(step)));
  }
  gave_way_.clear();
  for (const std::uint32_t task : model_.reactive()) {
    const TaskId id = model_.tasks()[task].id;
    if (watch_.has_given_way(id)) gave_way_.push_back(id);
  }
}

/// What was there before has been there since the beginning.
bool StateReplay::goes_on(TaskId task) const {
  const State& state = coordinator_.state();
  return std::max(state.taken_at(task), state.activated_at(state.behavior(task))) < present_instant;
}

void StateReplay::on_decision(const EventRecord& record, const Circumstances& circumstances,
                              const Assignment* solution) {
  watch_.on_decision(record, circumstances, solution);
  if (solution != nullptr && circumstances.trigger.is_reactive) {
    started_.push_back(circumstances.trigger.task);
  }
}

void StateReplay::on_event(const EventRecord& record) {
  watch_.on_event(record, coordinator_.state());
}

}  // namespace cbc
