#include "catalog/conditions.h"

#include <algorithm>
#include <cstdint>

#include "base/text.h"

namespace cbc {

std::vector<NamedCondition> conditions_of(const CompiledCatalog& catalog, BehaviorId behavior) {
  std::vector<NamedCondition> conditions;
  std::uint32_t variable = none;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable != variable) {
      variable = fitting.variable;
      NamedCondition& condition = conditions.emplace_back();
      condition.variable = catalog.name_of_variable(variable);
      condition.is_boolean = catalog.variables[variable].is_boolean != 0;
    }
    conditions.back().values.push_back(catalog.name_of_value({variable, fitting.value}));
  }
  return conditions;
}

std::vector<NamedCondition> conditions_of(const Catalog& catalog, const Behavior& behavior) {
  std::vector<Condition> sorted = behavior.situation;
  std::sort(sorted.begin(), sorted.end(),
            [](const Condition& a, const Condition& b) { return a.variable < b.variable; });
  std::vector<NamedCondition> conditions;
  for (const Condition& from : sorted) {
    const Variable& variable = catalog.variables[from.variable];
    NamedCondition& condition = conditions.emplace_back();
    condition.variable = variable.name;
    condition.is_boolean = variable.is_boolean;
    for (const std::uint32_t value : from.values) {
      condition.values.emplace_back(variable.values[value]);
    }
  }
  return conditions;
}

std::string describe(const NamedCondition& condition) {
  const std::string variable = printable(condition.variable);
  if (condition.is_boolean && condition.values.size() == 1) {
    return condition.values.front() == "true" ? variable : "not " + variable;
  }
  if (condition.values.empty()) return variable + ": no value";
  std::string text = variable + ":";
  for (const std::string_view value : condition.values) {
    text += text.back() == ':' ? " " : ", ";
    text += printable(value);
  }
  return text;
}

}  // namespace cbc
