#include "explore/controls/state_test.h"

#include <algorithm>

namespace cbc {

StateTest::StateTest(const Model& model, const StateCondition& condition,
                     Environments& environments) {
  add(model, condition, environments);
}

void StateTest::add(const Model& model, const StateCondition& condition,
                    Environments& environments) {
  using Kind = StateCondition::Kind;
  Diagrams& sets = environments.sets();
  switch (condition.kind) {
    case Kind::all:
      for (const StateCondition& part : condition.parts) add(model, part, environments);
      break;
    case Kind::any:
      any_.emplace_back();
      for (const StateCondition& part : condition.parts) {
        any_.back().emplace_back(model, part, environments);
      }
      break;
    case Kind::negated:
      negated_.emplace_back(model, condition.parts.front(), environments);
      break;
    case Kind::running:
      add_running(model, condition);
      break;
    case Kind::stopped:
      add([](const Stepper& state, Part part) { return state.cells()[part.subject] == 0; },
          model.find_task(condition.task));
      break;
    case Kind::active:
      add([](const Stepper& state,
             Part part) { return has_bit(state.active().data(), part.subject); },
          model.find_behavior(condition.behavior));
      break;
    case Kind::only_active:
      for (const StateCondition& part : condition.parts) add(model, part, environments);
      add_others(model, condition);
      break;
    case Kind::requested:
      add([](const Stepper& state,
             Part part) { return state.request_of(part.subject) >= part.wanted; },
          model.find_task(condition.task), model.rank_of(condition.priority) + 1U);
      break;
    case Kind::variable: {
      const std::uint32_t variable = model.find_variable(condition.variable);
      Set one_of = Diagrams::empty;
      for (const std::uint32_t value : condition.values) {
        one_of = sets.either(one_of, environments.with_value(variable, value));
      }
      demand(one_of, sets);
      break;
    }
    case Kind::own: {
      const Set denied = environments.denied(model.find_behavior(condition.behavior));
      demand(condition.wanted ? sets.complement(denied) : denied, sets);
      break;
    }
    case Kind::suspended:
      add([](const Stepper& state, Part part) { return state.is_suspended(part.subject); },
          model.find_task(condition.task));
      break;
    case Kind::failed:
      demand(environments.failed(model.find_behavior(condition.behavior)), sets);
      break;
    case Kind::faulty:
      demand(environments.faulty(model.find_behavior(condition.behavior)), sets);
      break;
    case Kind::none_faulty:
      // From the last bit to the first, which keeps each step small.
      for (std::size_t behavior = model.behaviors().size(); behavior-- > 0;) {
        const auto number = static_cast<std::uint32_t>(behavior);
        demand(sets.complement(environments.faulty(number)), sets);
      }
      break;
    case Kind::available:
      demand(environments.available(model.find_behavior(condition.behavior)), sets);
      break;
  }
}

void StateTest::add_running(const Model& model, const StateCondition& running) {
  const std::uint32_t task = model.find_task(running.task);
  const auto& listed = running.behaviors;
  if (listed.empty()) {
    add([](const Stepper& state, Part part) { return state.cells()[part.subject] != 0; }, task);
    return;
  }
  const BitRange values = model.tasks()[task].values;
  auto& wanted = values_.emplace_back();
  for (std::uint32_t value = values.begin; value < values.end; ++value) {
    const BehaviorId behavior = model.behaviors()[model.behavior_of(value)].id;
    if (std::find(listed.begin(), listed.end(), behavior) != listed.end()) wanted.push_back(value);
  }
}

/// The behaviors that are not listed are not active.
void StateTest::add_others(const Model& model, const StateCondition& only_active) {
  for (std::uint32_t behavior = 0; behavior < model.behaviors().size(); ++behavior) {
    const bool is_listed = std::any_of(only_active.parts.begin(), only_active.parts.end(),
                                       [&](const StateCondition& part) {
                                         return part.behavior == model.behaviors()[behavior].id;
                                       });
    if (is_listed) continue;
    add([](const Stepper& state,
           Part part) { return !has_bit(state.active().data(), part.subject); },
        behavior);
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
  for (const std::vector<StateTest>& alternatives : any_) {
    if (set == Diagrams::empty) return set;
    Set one_of = Diagrams::empty;
    for (const StateTest& part : alternatives) {
      one_of = sets.either(one_of, part.holds_in(control, sets));
    }
    set = sets.both(set, one_of);
  }
  return set;
}

}  // namespace cbc
