#include "explore/model/state_situation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "runtime/base/disjoint_sets.h"

namespace cbc {

namespace {

/// Adds what entries of `never` name together with something that is in the set, directly or
/// through others.
void add_ties(const CompiledCatalog& catalog, const Assumptions& assumptions,
              StateSituation& situation) {
  const auto variables = static_cast<std::uint32_t>(catalog.variables.size());
  const auto behaviors = static_cast<std::uint32_t>(catalog.behaviors.size());
  std::vector<bool> may_change(behaviors, false);
  for (const BehaviorId behavior : assumptions.behaviors) may_change[behavior] = true;
  DisjointSets ties(std::size_t{variables} + behaviors);
  for (const SituationPart& part : assumptions.never) {
    std::uint32_t first = none;
    const auto tie = [&](std::uint32_t member) {
      if (first == none) first = member;
      ties.join(first, member);
    };
    for (const VariableValue& value : part.variables) tie(value.variable);
    for (const SituationPart::Own& own : part.behaviors) {
      if (may_change[own.behavior]) tie(variables + own.behavior);
    }
  }
  const std::vector<std::uint32_t> numbers = ties.numbers();
  std::vector<bool> is_wanted(numbers.size(), false);
  for (const std::uint32_t variable : situation.variables) is_wanted[numbers[variable]] = true;
  for (const BehaviorId behavior : situation.behaviors) {
    is_wanted[numbers[variables + behavior]] = true;
  }
  for (std::uint32_t variable = 0; variable < variables; ++variable) {
    if (is_wanted[numbers[variable]]) situation.variables.insert(variable);
  }
  for (const BehaviorId behavior : assumptions.behaviors) {
    if (is_wanted[numbers[variables + behavior]]) situation.behaviors.insert(behavior);
  }
}

}  // namespace

std::set<std::uint32_t> variables_named_by(const CompiledCatalog& catalog, GroupId group) {
  std::set<std::uint32_t> variables;
  for (BehaviorId behavior = catalog.group_behaviors[group];
       behavior < catalog.group_behaviors[group + 1]; ++behavior) {
    for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
      variables.insert(fitting.variable);
    }
  }
  return variables;
}

StateSituation situation_of_states(const CompiledCatalog& catalog,
                                   const std::vector<GroupId>& groups,
                                   const Assumptions& assumptions,
                                   const std::set<std::uint32_t>& watched) {
  StateSituation situation;
  situation.variables = watched;
  for (const GroupId group : groups) situation.variables.merge(variables_named_by(catalog, group));
  for (const BehaviorId behavior : assumptions.behaviors) {
    if (std::binary_search(groups.begin(), groups.end(), catalog.group_of(behavior))) {
      situation.behaviors.insert(behavior);
    }
  }
  if (!assumptions.never.empty()) add_ties(catalog, assumptions, situation);
  return situation;
}

}  // namespace cbc
