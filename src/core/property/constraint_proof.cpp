// What breaks a promise is a condition on a state, which becomes a formula. That a task is
// requested means only that it runs.

#include "core/property/constraint_proof.h"

#include <algorithm>

#include "ask/formula.h"

namespace cbc {

PossibleStates possible_states(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  PossibleStates states;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    if (may_change(assumptions, variable)) continue;
    states.constant.variables.push_back({variable, initial_value(assumptions, variable)});
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (may_change(assumptions, behavior)) continue;
    states.constant.behaviors.push_back({behavior, is_available_at_first(assumptions, behavior)});
  }
  states.never = assumptions.never;
  states.faults = assumptions.faults;
  states.can_fail = [&assumptions](BehaviorId behavior) {
    return can_become_faulty(assumptions, behavior);
  };
  return states;
}

bool is_proved_by_constraints(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                              const Assumptions& assumptions, const Property& property) {
  const bool is_always = property.kind == Property::Kind::always;
  if (!is_always && property.kind != Property::Kind::never) return false;
  const auto is_first = [&](const SituationPart& part) {
    return holds_at_first(assumptions, part);
  };
  if (std::any_of(assumptions.never.begin(), assumptions.never.end(), is_first)) return false;
  const ConditionFormula formulas(catalog, groups);
  const Formula broken = formulas.make(property.condition, !is_always);
  const Formula counted = property.when ? formulas.make(*property.when, true) : Formula{};
  constexpr std::uint64_t most_effort = 500'000'000;
  return StateAsk(catalog, possible_states(catalog, assumptions), most_effort)
             .find({&broken, &counted}) == Feasibility::no;
}

}  // namespace cbc
