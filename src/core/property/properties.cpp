#include "core/property/properties.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

Assumptions default_assumptions(const CompiledCatalog& catalog) {
  Assumptions assumptions;
  for (const TaskId task : catalog.task_ids) {
    if (catalog.tasks[task].start_on_request == 0) continue;
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

std::set<std::uint32_t> variables_of(const Property& property) {
  std::set<std::uint32_t> variables;
  for (const VariableValue& value : property.condition.situation.variables) {
    variables.insert(value.variable);
  }
  if (!property.when) return variables;
  for (const VariableValue& value : property.when->situation.variables) {
    variables.insert(value.variable);
  }
  return variables;
}

}  // namespace cbc
