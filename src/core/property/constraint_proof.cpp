// What breaks a promise is a condition on a state, which becomes a formula. That a task is
// requested means only that it runs.

#include "core/property/constraint_proof.h"

#include <algorithm>

#include "ask/formula.h"

namespace cbc {

namespace {

/// Makes formulas of conditions, and of their negations.
class ConditionFormula {
 public:
  ConditionFormula(const CompiledCatalog& catalog, const std::vector<GroupId>& groups)
      : maker_(catalog) {
    for (const BehaviorId behavior : catalog.behavior_ids) {
      if (std::binary_search(groups.begin(), groups.end(), catalog.group_of(behavior))) {
        behaviors_.push_back(behavior);
      }
    }
  }

  /// `holds`: of the condition, or else of its negation.
  [[nodiscard]] Formula make(const StateCondition& condition, bool holds) const {
    Formula formula = FormulaMaker::join(holds);
    auto& parts = formula.parts;
    for (const auto& running : condition.running) {
      parts.push_back(maker_.runs(running.task, running.behaviors, holds));
    }
    for (const TaskId task : condition.stopped) parts.push_back(maker_.runs(task, {}, !holds));
    for (const BehaviorId behavior : condition.active) {
      parts.push_back(maker_.active(behavior, holds));
    }
    if (condition.only_active) add_others(condition.active, holds, parts);
    for (const auto& requested : condition.requested) {
      // A task without such a request may run or not.
      if (holds) parts.push_back(maker_.runs(requested.task, {}, true));
      if (!holds) parts.push_back(FormulaMaker::join(true));
    }
    for (const auto& situated : condition.variables) {
      parts.push_back(maker_.has_value(situated.variable, situated.values, holds));
    }
    for (const auto& own : condition.own) {
      parts.push_back(FormulaMaker::own(own.behavior, own.available == holds));
    }
    for (const BehaviorId behavior : condition.faulty) {
      parts.push_back(FormulaMaker::faulty(behavior, holds));
    }
    if (condition.none_faulty) parts.push_back(FormulaMaker::none_faulty(behaviors_, holds));
    for (const BehaviorId behavior : condition.available) {
      parts.push_back(maker_.available(behavior, holds));
    }
    for (const StateCondition& part : condition.negated) parts.push_back(make(part, !holds));
    for (const StateCondition& part : condition.all) parts.push_back(make(part, holds));
    if (condition.any.empty()) return formula;
    Formula& one_of = parts.emplace_back(FormulaMaker::join(!holds));
    for (const StateCondition& part : condition.any) one_of.parts.push_back(make(part, holds));
    return formula;
  }

 private:
  /// No behavior of the groups is active that is not listed, or else some is.
  void add_others(const std::vector<BehaviorId>& listed, bool holds,
                  std::vector<Formula>& parts) const {
    for (const BehaviorId behavior : behaviors_) {
      if (std::find(listed.begin(), listed.end(), behavior) != listed.end()) continue;
      parts.push_back(maker_.active(behavior, !holds));
    }
  }

  const FormulaMaker maker_;
  std::vector<BehaviorId> behaviors_;  ///< of the groups
};

template <typename Item>
bool is_listed(const std::vector<Item>& list, Item item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

PossibleStates limits_of(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  PossibleStates limits;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    if (is_listed(assumptions.variables, variable)) continue;
    limits.constant.variables.push_back({variable, initial_value(assumptions, variable)});
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (is_listed(assumptions.behaviors, behavior)) continue;
    limits.constant.behaviors.push_back({behavior, is_available_at_first(assumptions, behavior)});
  }
  limits.never = assumptions.never;
  limits.faults = assumptions.faults;
  limits.can_fail = [&assumptions](BehaviorId behavior) {
    return can_become_faulty(assumptions, behavior);
  };
  return limits;
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
  Formula broken = FormulaMaker::join(true);
  broken.parts.push_back(formulas.make(property.condition, !is_always));
  if (property.when) broken.parts.push_back(formulas.make(*property.when, true));
  constexpr std::uint64_t most_effort = 500'000'000;
  return StateAsk(catalog, limits_of(catalog, assumptions), most_effort).find(broken) ==
         Feasibility::no;
}

}  // namespace cbc
