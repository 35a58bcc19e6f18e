#include <algorithm>
#include <cstdint>

#include "core/property/properties.h"

namespace cbc {

Assumptions default_assumptions(const CompiledCatalog& catalog) {
  Assumptions assumptions;
  for (const TaskId task : catalog.task_ids) {
    const bool is_requested = catalog.tasks[task].start_on_request != 0;
    if (!is_requested || catalog.rules_of(task).requestable == 0) continue;
    assumptions.start.push_back({task, {1}});
    assumptions.stop.push_back(task);
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    assumptions.variables.push_back(variable);
  }
  return assumptions;
}

std::uint32_t initial_value(const Assumptions& assumptions, std::uint32_t variable) {
  const auto& values = assumptions.initially.variables;
  const auto found =
      std::find_if(values.begin(), values.end(),
                   [variable](const VariableValue& value) { return value.variable == variable; });
  return found == values.end() ? 0 : found->value;
}

bool is_available_at_first(const Assumptions& assumptions, BehaviorId behavior) {
  const auto& behaviors = assumptions.initially.behaviors;
  const auto found =
      std::find_if(behaviors.begin(), behaviors.end(),
                   [behavior](const SituationPart::Own& own) { return own.behavior == behavior; });
  return found == behaviors.end() || found->available;
}

bool holds_at_first(const Assumptions& assumptions, const SituationPart& part) {
  return std::all_of(part.variables.begin(), part.variables.end(),
                     [&](const VariableValue& value) {
                       return initial_value(assumptions, value.variable) == value.value;
                     }) &&
         std::all_of(part.behaviors.begin(), part.behaviors.end(),
                     [&](const SituationPart::Own& own) {
                       return is_available_at_first(assumptions, own.behavior) == own.available;
                     });
}

std::uint32_t count_combinations(const CompiledCatalog& catalog,
                                 const std::vector<std::uint32_t>& variables) {
  std::uint64_t count = 1;
  for (const std::uint32_t variable : variables) {
    count *= catalog.variables[variable].value_count;
    if (count > most_values_together) return most_values_together + 1;
  }
  return static_cast<std::uint32_t>(count);
}

std::vector<VariableValue> combination_of(const CompiledCatalog& catalog,
                                          const std::vector<std::uint32_t>& variables,
                                          std::uint32_t number) {
  std::vector<VariableValue> values(variables.size());
  for (std::size_t place = variables.size(); place-- > 0;) {
    const std::uint32_t count = catalog.variables[variables[place]].value_count;
    values[place] = {variables[place], number % count};
    number /= count;
  }
  return values;
}

bool may_change(const Assumptions& assumptions, std::uint32_t variable) {
  const auto& changing = assumptions.variables;
  return std::find(changing.begin(), changing.end(), variable) != changing.end();
}

bool may_change(const Assumptions& assumptions, BehaviorId behavior) {
  const auto& changing = assumptions.behaviors;
  return std::find(changing.begin(), changing.end(), behavior) != changing.end();
}

bool can_become_faulty(const Assumptions& assumptions, BehaviorId behavior) {
  const auto& listed = assumptions.listed_for_faults;
  const bool is_listed = std::find(listed.begin(), listed.end(), behavior) != listed.end();
  return assumptions.faults > 0 && is_listed == assumptions.only_listed_fail;
}

}  // namespace cbc
