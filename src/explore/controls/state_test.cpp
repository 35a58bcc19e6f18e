#include "explore/controls/state_test.h"

#include <algorithm>

namespace cbc {

StateTest::StateTest(const Model& model, const StateCondition& condition,
                     Environments& environments) {
  for (const StateCondition::Running& running : condition.running) add_running(model, running);
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
  add_environments(model, condition, environments);
  for (const StateCondition& part : condition.negated)
    negated_.emplace_back(model, part, environments);
  for (const StateCondition& part : condition.any) any_.emplace_back(model, part, environments);
  for (const StateCondition& part : condition.all) all_.emplace_back(model, part, environments);
}

void StateTest::add_running(const Model& model, const StateCondition::Running& running) {
  const std::uint32_t task = model.find_task(running.task);
  if (running.behaviors.empty()) {
    add([](const Stepper& state, Part part) { return state.cells()[part.subject] != 0; }, task);
    return;
  }
  const BitRange values = model.tasks()[task].values;
  auto& wanted = values_.emplace_back();
  for (std::uint32_t value = values.begin; value < values.end; ++value) {
    const BehaviorId behavior = model.behaviors()[model.behavior_of(value)].id;
    const auto& listed = running.behaviors;
    if (std::find(listed.begin(), listed.end(), behavior) != listed.end()) wanted.push_back(value);
  }
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

void StateTest::add_environments(const Model& model, const StateCondition& condition,
                                 Environments& environments) {
  Diagrams& sets = environments.sets();
  const auto demand = [&](Set set) { in_environment_ = sets.both(in_environment_, set); };
  for (const StateCondition::Situated& situated : condition.variables) {
    const std::uint32_t variable = model.find_variable(situated.variable);
    Set one_of = Diagrams::empty;
    for (const std::uint32_t value : situated.values) {
      one_of = sets.either(one_of, environments.with_value(variable, value));
    }
    demand(one_of);
  }
  for (const SituationPart::Own& own : condition.own) {
    const Set denied = environments.denied(model.find_behavior(own.behavior));
    demand(own.available ? sets.complement(denied) : denied);
  }
  for (const BehaviorId behavior : condition.faulty) {
    demand(environments.faulty(model.find_behavior(behavior)));
  }
  if (condition.none_faulty) {
    // From the last bit to the first, which keeps each step small.
    for (std::size_t behavior = model.behaviors().size(); behavior-- > 0;) {
      const auto number = static_cast<std::uint32_t>(behavior);
      demand(sets.complement(environments.faulty(number)));
    }
  }
  for (const BehaviorId behavior : condition.available) {
    demand(environments.available(model.find_behavior(behavior)));
  }
}

StateTest::Set StateTest::holds_in(const Stepper& control, Diagrams& sets) const {
  const bool may_hold =
      std::all_of(tests_.begin(), tests_.end(),
                  [&](const Test& test) { return test.holds(control, test.part); }) &&
      std::all_of(values_.begin(), values_.end(), [&](const std::vector<std::uint32_t>& wanted) {
        return std::any_of(wanted.begin(), wanted.end(), [&](std::uint32_t value) {
          return has_bit(control.values().data(), value);
        });
      });
  Set set = may_hold ? in_environment_ : Diagrams::empty;
  for (const StateTest& part : negated_) {
    if (set == Diagrams::empty) return set;
    set = sets.without(set, part.holds_in(control, sets));
  }
  for (const StateTest& part : all_) {
    if (set == Diagrams::empty) return set;
    set = sets.both(set, part.holds_in(control, sets));
  }
  if (any_.empty() || set == Diagrams::empty) return set;
  Set one_of = Diagrams::empty;
  for (const StateTest& part : any_) one_of = sets.either(one_of, part.holds_in(control, sets));
  return sets.both(set, one_of);
}

}  // namespace cbc
