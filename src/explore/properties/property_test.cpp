// Temporal properties by their shape: invariants, and their scopes, as M. B. Dwyer, G. S. Avrunin
// and J. C. Corbett, "Patterns in property specifications for finite-state verification", ICSE
// 1999, name them, are looked for in states; what a task keeps doing, in moves; and what stays
// possible (AG EF, E. M. Clarke and E. A. Emerson, "Design and synthesis of synchronization
// skeletons using branching time temporal logic", 1981) by going backward from where it holds.

#include "explore/properties/property_test.h"

#include <algorithm>
#include <utility>

#include "explore/moves/move_kinds.h"

namespace cbc {

namespace {

using Kind = Property::Kind;
using Set = StatePart::Set;

}  // namespace

PropertyTest::PropertyTest(const Property& property, CatalogSystem& system, StatePart& part)
    : property_(property), system_(system), model_(system.model()), part_(part), met_(part) {
  if (property.when) when_.emplace(system.make_test(*property.when));
}

void PropertyTest::visit(const States& states, std::uint32_t /*depth*/) {
  if (!has_counted_) has_counted_ = counted(states) != Diagrams::empty;
}

void PropertyTest::on_refusal(std::uint32_t /*action*/, const States& /*states*/,
                              std::uint32_t /*depth*/) {}

void PropertyTest::on_result(std::uint32_t /*action*/, const States& /*states*/,
                             Controls::NumberedResult /*result*/, std::uint32_t /*depth*/) {}

Set PropertyTest::counted(const States& states) {
  if (property_.settled && !control().is_settled()) return Diagrams::empty;
  Set set = states.environments;
  if (when_) set = sets().both(set, when_->holds_in(control(), sets()));
  if (property_.after) set = sets().both(set, system_.marked());
  return set;
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
  ConditionTest(const Property& property, CatalogSystem& system, StatePart& part)
      : PropertyTest(property, system, part), condition_(system.make_test(property.condition)) {}

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
  StartTest(const Property& property, CatalogSystem& system, StatePart& part)
      : PropertyTest(property, system, part),
        action_(system.find_start(model_.find_task(property.task),
                                  model_.ranks_up_to(property.priority))) {}

  void on_refusal(std::uint32_t action, const States& states, std::uint32_t depth) override {
    if (action == action_) note({states.control, counted(states)}, depth);
  }

 private:
  std::uint32_t action_ = 0;
};

/// Of keeps_running: whether an action of the loaded control may not end the task, by its number in
/// the model, which runs there.
bool may_not_end(const Property& property, std::uint32_t task, const CatalogSystem& system,
                 std::uint32_t action) {
  const Model& model = system.model();
  const Model::Choice& choice = system.choice_of(action);
  const Stepper& control = system.stepper();
  // Rank 0 is that of reactive starts.
  if (control.cells()[task] == 0 || control.request_of(task) <= 1) return false;
  if (property.by && !is_of_kinds(*property.by, choice, model)) return false;
  switch (choice.move.kind) {
    case Move::Kind::stop:
      return choice.subject != task;
    case Move::Kind::success:
    case Move::Kind::failure:
    case Move::Kind::situation_change: {
      const std::uint32_t value = model.tasks()[task].values.begin + control.cells()[task] - 1U;
      return model.behavior_of(value) != choice.subject;
    }
    default:
      return true;
  }
}

/// Of keeps_running: the first move that ends the task in the state where a walker is.
Move find_ending(const Property& property, const CatalogSystem& system, StateWalker& walker) {
  const std::uint32_t task = system.model().find_task(property.task);
  walker.load();
  const auto& moves = system.moves();
  const auto ends = [&](const ControlSystem::StateMove& move) {
    // Faults and repairs end nothing.
    return move.action != none && may_not_end(property, task, system, move.action) &&
           walker.try_move(static_cast<std::size_t>(&move - moves.data())) &&
           !system.runs_in(walker.control_after(), task);
  };
  return std::find_if(moves.begin(), moves.end(), ends)->move;
}

/// keeps_running: looks for the states before the task stops.
class KeepTest final : public PropertyTest {
 public:
  KeepTest(const Property& property, CatalogSystem& system, StatePart& part)
      : PropertyTest(property, system, part), task_(model_.find_task(property.task)) {}

  [[nodiscard]] bool looks_at_moves() const override { return true; }
  void on_result(std::uint32_t action, const States& states, Controls::NumberedResult result,
                 std::uint32_t depth) override {
    if (!may_not_end(property_, task_, system_, action)) return;
    if (system_.runs_in(part_.controls().packed(result.control), task_)) return;
    note({states.control, counted(states)}, depth);
  }

 private:
  std::uint32_t task_ = 0;
};

/// always_possible: goes backward once all states are known.
class PossibilityTest final : public PropertyTest {
 public:
  PossibilityTest(const Property& property, CatalogSystem& system, StatePart& part)
      : PropertyTest(property, system, part), condition_(system.make_test(property.condition)) {}

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

std::unique_ptr<PropertyTest> make_property_test(const Property& property, CatalogSystem& system,
                                                 StatePart& part) {
  switch (property.kind) {
    case Kind::can_start:
      return std::make_unique<StartTest>(property, system, part);
    case Kind::keeps_running:
      return std::make_unique<KeepTest>(property, system, part);
    case Kind::always_possible:
      return std::make_unique<PossibilityTest>(property, system, part);
    case Kind::always:
    case Kind::never:
    case Kind::reachable:
      break;
  }
  return std::make_unique<ConditionTest>(property, system, part);
}

namespace {

MoveSelection select_moves(const MoveKinds& kinds, const CatalogSystem& system) {
  MoveSelection selection;
  for (std::uint32_t action = 0; action < system.actions().size(); ++action) {
    const bool is_selected = is_of_kinds(kinds, system.choice_of(action), system.model());
    selection.actions.push_back(is_selected ? 1 : 0);
  }
  selection.has_fault = kinds.fault;
  selection.has_repair = kinds.repair;
  return selection;
}

/// Goes backward from the states that satisfy the condition. False if a limit ends it.
bool find_stuck(const Property& property, StateSpace& space,
                const std::vector<PropertyTest*>& tests) {
  std::vector<StatePart::Layer> goals;
  goals.reserve(tests.size());
  for (PropertyTest* const test : tests) goals.push_back(test->goals());
  std::optional<MoveSelection> selection;
  if (property.by) selection = select_moves(*property.by, tests.front()->system());
  const auto can_reach = space.can_reach(goals, selection ? &*selection : nullptr, property.within);
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

Verdict find_verdict(const Property& property, StateSpace& space,
                     const std::vector<PropertyTest*>& tests) {
  Verdict verdict;
  if (property.kind == Kind::always_possible) {
    if (!space.is_complete() || !find_stuck(property, space, tests)) return verdict;
  }
  const bool is_reachable = property.kind == Kind::reachable;
  const auto if_seen = is_reachable ? Verdict::Result::proved : Verdict::Result::violated;
  const auto if_not = is_reachable ? Verdict::Result::violated : Verdict::Result::proved;
  std::vector<const FirstStates*> met;
  met.reserve(tests.size());
  for (const PropertyTest* const test : tests) met.push_back(&test->met());
  if (StateSpace::least_depth(met) == FirstStates::never) {
    if (!space.is_complete()) return verdict;
    verdict.result = if_not;
    const bool has_counted = std::any_of(tests.begin(), tests.end(),
                                         [](const auto* test) { return test->has_counted(); });
    verdict.is_vacuous = !is_reachable && !has_counted && (property.when || property.after);
    return verdict;
  }
  verdict.result = if_seen;
  verdict.has_script = true;
  StateSpace::Path path = space.path_to(met);
  if (property.kind == Kind::can_start) {
    const CompiledCatalog& catalog = tests.front()->system().model().catalog();
    const std::uint32_t index = catalog.tasks[property.task].catalog_index;
    path.moves.push_back({Move::Kind::start, index, property.priority});
  } else if (property.kind == Kind::keeps_running) {
    path.moves.push_back(find_ending(property, tests.front()->system(), path.end));
  }
  verdict.script = std::move(path.moves);
  return verdict;
}

}  // namespace cbc
