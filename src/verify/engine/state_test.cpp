#include "verify/engine/state_test.h"

#include <algorithm>

namespace cbc {

namespace {

/// None, which no cell has, if the behavior does not perform the task.
std::uint32_t cell_of(const Model& model, std::uint32_t task, std::uint32_t behavior) {
  const BitRange values = model.tasks()[task].values;
  for (std::uint32_t value = values.begin; value < values.end; ++value) {
    if (model.behavior_of(value) == behavior) return value - values.begin + 1;
  }
  return none;
}

}  // namespace

StateTest::StateTest(const Model& model, Environments& environments,
                     const StateCondition& condition)
    : environments_(environments) {
  for (const StateCondition::Running& running : condition.running) {
    const std::uint32_t task = model.find_task(running.task);
    if (running.behavior == none) {
      add([](const Stepper& state, Part part) { return state.cells()[part.subject] != 0; }, task);
    } else {
      add([](const Stepper& state,
             Part part) { return state.cells()[part.subject] == part.wanted; },
          task, cell_of(model, task, model.find_behavior(running.behavior)));
    }
  }
  for (const TaskId task : condition.stopped) {
    add([](const Stepper& state, Part part) { return state.cells()[part.subject] == 0; },
        model.find_task(task));
  }
  for (const BehaviorId behavior : condition.active) {
    add([](const Stepper& state,
           Part part) { return has_bit(state.active().data(), part.subject); },
        model.find_behavior(behavior));
  }
  if (condition.only_active) add_others(model, condition.active);
  for (const StateCondition::Requested& requested : condition.requested) {
    add([](const Stepper& state,
           Part part) { return state.request_of(part.subject) >= part.wanted; },
        model.find_task(requested.task), model.rank_of(requested.priority) + 1U);
  }
  for (const VariableValue& value : condition.situation.variables) {
    add(environments.with_value(model.find_variable(value.variable), value.value));
  }
  for (const SituationPart::Own& own : condition.situation.behaviors) {
    const Set denied = environments.denied(model.find_behavior(own.behavior));
    add(own.available ? environments.sets().complement(denied) : denied);
  }
  for (const BehaviorId behavior : condition.faulty) {
    add(environments.faulty(model.find_behavior(behavior)));
  }
  for (const BehaviorId behavior : condition.available) {
    add(environments.available(model.find_behavior(behavior)));
  }
}

StateTest::Set StateTest::holds_in(const Stepper& control) const {
  const bool may_hold = std::all_of(tests_.begin(), tests_.end(), [&](const Test& test) {
    return test.holds(control, test.part);
  });
  return may_hold ? in_environment_ : Diagrams::empty;
}

/// The behaviors that are not listed are not active.
void StateTest::add_others(const Model& model, const std::vector<BehaviorId>& listed) {
  for (std::uint32_t behavior = 0; behavior < model.behaviors().size(); ++behavior) {
    const BehaviorId id = model.behaviors()[behavior].id;
    if (std::find(listed.begin(), listed.end(), id) != listed.end()) continue;
    add([](const Stepper& state,
           Part part) { return !has_bit(state.active().data(), part.subject); },
        behavior);
  }
}

}  // namespace cbc
