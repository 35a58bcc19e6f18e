// Temporal properties by their shape: invariants, and their scopes, as M. B. Dwyer, G. S. Avrunin
// and J. C. Corbett, "Patterns in property specifications for finite-state verification", ICSE
// 1999, name them, are looked for in states; what a task keeps doing, in moves; and what stays
// possible (AG EF, E. M. Clarke and E. A. Emerson, "Design and synthesis of synchronization
// skeletons using branching time temporal logic", 1981) by going backward from where it holds.

#include "verify/engine/property_test.h"

#include <algorithm>
#include <utility>

#include "verify/engine/move_kinds.h"

namespace cbc {

namespace {

using Kind = Property::Kind;
using Set = Environments::Set;

}  // namespace

PropertyTest::PropertyTest(const Property& property, const Model& model, StateSpace& space)
    : property_(property), model_(model), space_(space) {
  if (!property.when) return;
  when_.emplace(model, space.environments(), *property.when);
  space.keep({0, when_->in_environment()});
}

void PropertyTest::visit(const States& states, std::uint32_t /*depth*/) {
  if (!has_counted_) has_counted_ = counted(states) != Diagrams::empty;
}

void PropertyTest::on_refusal(std::uint32_t /*action*/, const States& /*states*/,
                              std::uint32_t /*depth*/) {}

void PropertyTest::on_outcome(std::uint32_t /*action*/, const States& /*states*/,
                              Controls::Outcome /*outcome*/, std::uint32_t /*depth*/) {}

Set PropertyTest::counted(const States& states) {
  if (property_.settled && !control().is_settled()) return Diagrams::empty;
  Set set = states.environments;
  if (when_) set = sets().both(set, when_->holds_in(control()));
  if (property_.after) set = sets().both(set, space_.environments().marked());
  return set;
}

void PropertyTest::note(const States& states, std::uint32_t depth) {
  if (states.environments == Diagrams::empty || first_ < depth) return;
  first_ = depth;
  if (met_.empty() || met_.back().control != states.control) {
    met_.push_back({states.control, Diagrams::empty});
  }
  Set& known = met_.back().environments;
  known = sets().either(known, states.environments);
  space_.keep(met_.back());
}

Verdict PropertyTest::undecided_or(Verdict::Result result) const {
  Verdict verdict;
  if (!space_.is_complete()) return verdict;
  verdict.result = result;
  verdict.is_vacuous =
      result == Verdict::Result::proved && !has_counted_ && (property_.when || property_.after);
  return verdict;
}

void PropertyTest::write_script(Verdict& verdict) {
  verdict.has_script = true;
  verdict.script = space_.path_to(met_, first_);
}

Verdict PropertyTest::verdict() {
  if (!is_decided()) return undecided_or(Verdict::Result::proved);
  Verdict verdict;
  verdict.result = Verdict::Result::violated;
  write_script(verdict);
  return verdict;
}

namespace {

/// always, never and reachable.
class ConditionTest final : public PropertyTest {
 public:
  ConditionTest(const Property& property, const Model& model, StateSpace& space)
      : PropertyTest(property, model, space),
        condition_(model, space.environments(), property.condition) {
    space.keep({0, condition_.in_environment()});
  }

  void visit(const States& states, std::uint32_t depth) override {
    PropertyTest::visit(states, depth);
    const Set holds = condition_.holds_in(control());
    const Set all = counted(states);
    const bool is_always = property_.kind == Kind::always;
    note({states.control, is_always ? sets().without(all, holds) : sets().both(all, holds)}, depth);
  }

  [[nodiscard]] Verdict verdict() override {
    if (property_.kind != Kind::reachable) return PropertyTest::verdict();
    if (!is_decided()) return undecided_or(Verdict::Result::violated);
    Verdict verdict;
    verdict.result = Verdict::Result::proved;
    write_script(verdict);
    return verdict;
  }

 private:
  StateTest condition_;
};

class StartTest final : public PropertyTest {
 public:
  StartTest(const Property& property, const Model& model, StateSpace& space)
      : PropertyTest(property, model, space),
        action_(space.controls().find_start(model.find_task(property.task),
                                            model.ranks_up_to(property.priority))) {}

  void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth) override {
    if (action == action_) note({states.control, counted(states)}, depth);
  }

  [[nodiscard]] Verdict verdict() override {
    Verdict verdict = PropertyTest::verdict();
    if (!verdict.has_script) return verdict;
    const std::uint32_t index = model_.catalog().tasks[property_.task].catalog_index;
    verdict.script.push_back({Move::Kind::start, index, property_.priority});
    return verdict;
  }

 private:
  std::uint32_t action_ = 0;
};

/// keeps_running: looks for the states before the task stops.
class KeepTest final : public PropertyTest {
 public:
  KeepTest(const Property& property, const Model& model, StateSpace& space)
      : PropertyTest(property, model, space), task_(model.find_task(property.task)) {}

  [[nodiscard]] bool looks_at_moves() const override { return true; }
  void on_outcome(std::uint32_t action, const States& states, Controls::Outcome outcome,
                  std::uint32_t depth) override {
    const Model::Choice& choice = space_.controls().actions()[action].choice;
    if (!counts(choice, control()) || space_.controls().runs_in(outcome.control, task_)) return;
    note({states.control, counted(states)}, depth);
  }

  [[nodiscard]] Verdict verdict() override {
    Verdict verdict = PropertyTest::verdict();
    if (!verdict.has_script) return verdict;
    Stepper stepper(model_);
    space_.follow(verdict.script, stepper);
    for (const Model::Choice& choice : model_.moves()) {
      if (!counts(choice, stepper) || !stepper.try_move(choice)) continue;
      if (stepper.cells_after()[task_] != 0) continue;
      verdict.script.push_back(stepper.move_of(choice));
      break;
    }
    return verdict;
  }

 private:
  /// Whether a move of the loaded state may not end the task.
  [[nodiscard]] bool counts(const Model::Choice& choice, const Stepper& state) const {
    // Rank 0 is that of reactive starts.
    if (state.cells()[task_] == 0 || state.request_of(task_) <= 1) return false;
    if (property_.by && !is_of_kinds(*property_.by, choice, model_)) return false;
    switch (choice.move.kind) {
      case Move::Kind::stop:
        return choice.subject != task_;
      case Move::Kind::success:
      case Move::Kind::failure:
      case Move::Kind::situation_change: {
        const std::uint32_t value = model_.tasks()[task_].values.begin + state.cells()[task_] - 1U;
        return model_.behavior_of(value) != choice.subject;
      }
      default:
        return true;
    }
  }

  std::uint32_t task_ = 0;
};

/// always_possible: goes backward once all states are known.
class PossibilityTest final : public PropertyTest {
 public:
  PossibilityTest(const Property& property, const Model& model, StateSpace& space)
      : PropertyTest(property, model, space),
        condition_(model, space.environments(), property.condition) {
    space.keep({0, condition_.in_environment()});
  }

  [[nodiscard]] Verdict verdict() override {
    if (!space_.is_complete()) return {};
    const std::optional<std::vector<Set>> possible =
        space_.can_reach(condition_, property_.by, property_.within);
    if (!possible) return {};
    space_.for_each_layer([&](const States& states, std::uint32_t depth) {
      note({states.control, sets().without(counted(states), (*possible)[states.control])}, depth);
      return !is_decided();
    });
    return PropertyTest::verdict();
  }

 private:
  StateTest condition_;
};

}  // namespace

std::unique_ptr<PropertyTest> make_property_test(const Property& property, const Model& model,
                                                 StateSpace& space) {
  switch (property.kind) {
    case Kind::can_start:
      return std::make_unique<StartTest>(property, model, space);
    case Kind::keeps_running:
      return std::make_unique<KeepTest>(property, model, space);
    case Kind::always_possible:
      return std::make_unique<PossibilityTest>(property, model, space);
    case Kind::always:
    case Kind::never:
    case Kind::reachable:
      break;
  }
  return std::make_unique<ConditionTest>(property, model, space);
}

}  // namespace cbc
