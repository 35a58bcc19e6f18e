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

PropertyTest::PropertyTest(const Property& property, const Model& model, StatePart& part)
    : property_(property), model_(model), part_(part) {
  if (!property.when) return;
  when_.emplace(model, *property.when, part.environments());
  part.keep(*when_);
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
  if (when_) set = sets().both(set, when_->holds_in(control(), sets()));
  if (property_.after) set = sets().both(set, part_.environments().marked());
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
  part_.keep(met_.back());
}

void PropertyTest::note_stuck(const States& states, const std::vector<Set>& can_reach,
                              std::uint32_t depth) {
  const Set reaching =
      states.control < can_reach.size() ? can_reach[states.control] : Diagrams::empty;
  note({states.control, sets().without(counted(states), reaching)}, depth);
}

namespace {

/// always, never and reachable.
class ConditionTest final : public PropertyTest {
 public:
  ConditionTest(const Property& property, const Model& model, StatePart& part)
      : PropertyTest(property, model, part),
        condition_(model, property.condition, part.environments()) {
    part.keep(condition_);
  }

  void visit(const States& states, std::uint32_t depth) override {
    PropertyTest::visit(states, depth);
    const Set holds = condition_.holds_in(control(), sets());
    const Set all = counted(states);
    const bool is_always = property_.kind == Kind::always;
    note({states.control, is_always ? sets().without(all, holds) : sets().both(all, holds)}, depth);
  }

 private:
  StateTest condition_;
};

class StartTest final : public PropertyTest {
 public:
  StartTest(const Property& property, const Model& model, StatePart& part)
      : PropertyTest(property, model, part),
        action_(part.controls().find_start(model.find_task(property.task),
                                           model.ranks_up_to(property.priority))) {}

  void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth) override {
    if (action == action_) note({states.control, counted(states)}, depth);
  }

 private:
  std::uint32_t action_ = 0;
};

/// Of keeps_running: whether a move of the loaded state may not end the task, by its number in the
/// model, which runs there.
bool may_not_end(const Property& property, std::uint32_t task, const Model& model,
                 const Model::Choice& choice, const Stepper& state) {
  // Rank 0 is that of reactive starts.
  if (state.cells()[task] == 0 || state.request_of(task) <= 1) return false;
  if (property.by && !is_of_kinds(*property.by, choice, model)) return false;
  switch (choice.move.kind) {
    case Move::Kind::stop:
      return choice.subject != task;
    case Move::Kind::success:
    case Move::Kind::failure:
    case Move::Kind::situation_change: {
      const std::uint32_t value = model.tasks()[task].values.begin + state.cells()[task] - 1U;
      return model.behavior_of(value) != choice.subject;
    }
    default:
      return true;
  }
}

/// Of keeps_running: the first move of a packed state that ends the task.
Move find_ending(const Property& property, const Model& model,
                 const std::vector<std::uint32_t>& state) {
  const std::uint32_t task = model.find_task(property.task);
  Stepper stepper(model);
  stepper.load(state.data());
  const auto& moves = model.moves();
  const auto ends = [&](const Model::Choice& choice) {
    return may_not_end(property, task, model, choice, stepper) && stepper.try_move(choice) &&
           stepper.cells_after()[task] == 0;
  };
  return stepper.move_of(*std::find_if(moves.begin(), moves.end(), ends));
}

/// keeps_running: looks for the states before the task stops.
class KeepTest final : public PropertyTest {
 public:
  KeepTest(const Property& property, const Model& model, StatePart& part)
      : PropertyTest(property, model, part), task_(model.find_task(property.task)) {}

  [[nodiscard]] bool looks_at_moves() const override { return true; }
  void on_outcome(std::uint32_t action, const States& states, Controls::Outcome outcome,
                  std::uint32_t depth) override {
    const Model::Choice& choice = part_.controls().actions()[action].choice;
    if (!may_not_end(property_, task_, model_, choice, control())) return;
    if (part_.controls().runs_in(outcome.control, task_)) return;
    note({states.control, counted(states)}, depth);
  }

 private:
  std::uint32_t task_ = 0;
};

/// always_possible: goes backward once all states are known.
class PossibilityTest final : public PropertyTest {
 public:
  PossibilityTest(const Property& property, const Model& model, StatePart& part)
      : PropertyTest(property, model, part),
        condition_(model, property.condition, part.environments()) {
    part.keep(condition_);
  }

  [[nodiscard]] Layer goals() override {
    Layer goals;
    for (Controls::Number number = 0; number < part_.controls().size(); ++number) {
      if (!part_.is_own(number) || part_.visited(number) == Diagrams::empty) continue;
      part_.controls().load(number);
      const Set set = sets().both(part_.visited(number), condition_.holds_in(control(), sets()));
      if (set != Diagrams::empty) goals.push_back({number, set});
    }
    return goals;
  }

 private:
  StateTest condition_;
};

}  // namespace

std::unique_ptr<PropertyTest> make_property_test(const Property& property, const Model& model,
                                                 StatePart& part) {
  switch (property.kind) {
    case Kind::can_start:
      return std::make_unique<StartTest>(property, model, part);
    case Kind::keeps_running:
      return std::make_unique<KeepTest>(property, model, part);
    case Kind::always_possible:
      return std::make_unique<PossibilityTest>(property, model, part);
    case Kind::always:
    case Kind::never:
    case Kind::reachable:
      break;
  }
  return std::make_unique<ConditionTest>(property, model, part);
}

namespace {

/// Goes backward from the states that satisfy the condition. False if a limit ends it.
bool find_stuck(const Property& property, StateSpace& space,
                const std::vector<PropertyTest*>& tests) {
  std::vector<StatePart::Layer> goals;
  goals.reserve(tests.size());
  for (PropertyTest* const test : tests) goals.push_back(test->goals());
  const auto can_reach =
      space.can_reach(goals, property.by ? &*property.by : nullptr, property.within);
  if (!can_reach) return false;
  for (std::size_t place = 0; place < tests.size(); ++place) {
    StatePart& part = *space.parts()[place];
    for (std::uint32_t depth = 0; depth < part.layers().size(); ++depth) {
      for (const auto& states : part.layers()[depth]) {
        part.controls().load(states.control);
        tests[place]->note_stuck(states, (*can_reach)[place], depth);
      }
    }
  }
  return true;
}

}  // namespace

Verdict find_verdict(const Property& property, const Model& model, StateSpace& space,
                     const std::vector<PropertyTest*>& tests) {
  Verdict verdict;
  if (property.kind == Kind::always_possible) {
    if (!space.is_complete() || !find_stuck(property, space, tests)) return verdict;
  }
  const bool is_reachable = property.kind == Kind::reachable;
  const auto if_seen = is_reachable ? Verdict::Result::proved : Verdict::Result::violated;
  const auto if_not = is_reachable ? Verdict::Result::violated : Verdict::Result::proved;
  std::uint32_t first = PropertyTest::never_seen;
  for (const PropertyTest* const test : tests) first = std::min(first, test->first());
  if (first == PropertyTest::never_seen) {
    if (!space.is_complete()) return verdict;
    verdict.result = if_not;
    const bool has_counted = std::any_of(tests.begin(), tests.end(),
                                         [](const auto* test) { return test->has_counted(); });
    verdict.is_vacuous = !is_reachable && !has_counted && (property.when || property.after);
    return verdict;
  }
  verdict.result = if_seen;
  verdict.has_script = true;
  std::vector<StatePart::Layer> targets;
  for (const PropertyTest* const test : tests) {
    targets.push_back(test->first() == first ? test->met() : StatePart::Layer());
  }
  StateSpace::Path path = space.path_to(targets, first);
  if (property.kind == Kind::can_start) {
    const std::uint32_t index = model.catalog().tasks[property.task].catalog_index;
    path.moves.push_back({Move::Kind::start, index, property.priority});
  } else if (property.kind == Kind::keeps_running) {
    path.moves.push_back(find_ending(property, model, path.end));
  }
  verdict.script = std::move(path.moves);
  return verdict;
}

}  // namespace cbc
