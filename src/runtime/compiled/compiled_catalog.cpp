#include "runtime/compiled/compiled_catalog.h"

#include <algorithm>

namespace cbc {
namespace {

std::optional<std::uint32_t> find(const Texts& names, std::span<const std::uint32_t> by_name,
                                  std::string_view name) {
  const auto found = std::lower_bound(
      by_name.begin(), by_name.end(), name,
      [&](std::uint32_t place, std::string_view wanted) { return names[place] < wanted; });
  if (found == by_name.end() || names[*found] != name) return std::nullopt;
  return *found;
}

}  // namespace

std::optional<std::uint32_t> CompiledCatalog::find_task(std::string_view name) const {
  return find(task_names, tasks_by_name, name);
}

std::optional<std::uint32_t> CompiledCatalog::find_behavior(std::string_view name) const {
  return find(behavior_names, behaviors_by_name, name);
}

std::optional<std::uint32_t> CompiledCatalog::find_variable(std::string_view name) const {
  for (std::uint32_t variable = 0; variable < variables.size(); ++variable) {
    if (name_of_variable(variable) == name) return variable;
  }
  return std::nullopt;
}

bool CompiledCatalog::can_perform(BehaviorId behavior, TaskId task) const {
  const auto performed = performs[behavior];
  return std::any_of(performed.begin(), performed.end(),
                     [&](ValueId value) { return task_of(value) == task; });
}

std::optional<std::uint32_t> CompiledCatalog::find_value(std::uint32_t variable,
                                                         std::string_view text) const {
  for (std::uint32_t value = 0; value < variables[variable].value_count; ++value) {
    if (name_of_value({variable, value}) == text) return value;
  }
  return std::nullopt;
}

std::span<const FittingValue> CompiledCatalog::fitting_values_of(BehaviorId behavior) const {
  const auto [first, end] = std::equal_range(
      fitting_values.begin(), fitting_values.end(), FittingValue{behavior, 0, 0},
      [](const FittingValue& a, const FittingValue& b) { return a.behavior < b.behavior; });
  return {first, end};
}

std::optional<std::uint32_t> CompiledCatalog::find_misfit(std::span<const FittingValue> fitting,
                                                          std::span<const std::uint32_t> present) {
  for (auto next = fitting.begin(); next != fitting.end();) {
    const std::uint32_t variable = next->variable;
    bool is_fitting = false;
    for (; next != fitting.end() && next->variable == variable; ++next) {
      is_fitting |= next->value == present[variable];
    }
    if (!is_fitting) return variable;
  }
  return std::nullopt;
}

}  // namespace cbc
