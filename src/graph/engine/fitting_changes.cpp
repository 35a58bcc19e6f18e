#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "core/support/wording.h"
#include "graph/engine/catalog_diff.h"
#include "graph/engine/catalog_facts.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// One of the catalogs.
class FittingBehaviors {
 public:
  explicit FittingBehaviors(NamedCatalog named) : named_(std::move(named)) {
    for (TaskId task(0); task < named_.tasks.size(); ++task)
      tasks_.emplace(named_.tasks[task], task);
    for (std::uint32_t place = 0; place < named_.variables.size(); ++place) {
      variables_.emplace(named_.variables[place], place);
    }
  }

  [[nodiscard]] std::optional<TaskId> find_task(std::string_view name) const {
    const auto found = tasks_.find(name);
    return found == tasks_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] std::optional<std::uint32_t> find_variable(std::string_view name) const {
    const auto found = variables_.find(name);
    return found == variables_.end() ? std::nullopt : std::optional(found->second);
  }
  [[nodiscard]] const NamedCatalog& named() const { return named_; }

  /// The variables that the behaviors of a task name, with these names.
  [[nodiscard]] std::set<std::string_view> variables_of(TaskId task) const {
    std::set<std::string_view> variables;
    for (const Value& value : named_.catalog.values[task]) {
      for (const FittingValue& fitting : named_.catalog.fitting_values_of(value.behavior)) {
        variables.insert(named_.variables[fitting.variable]);
      }
    }
    return variables;
  }

  /// A behavior, a variable and a value in which it fits, by their names.
  using Condition = std::array<std::string_view, 3>;
  /// Of all behaviors of a task; a behavior without any has one of empty names.
  [[nodiscard]] std::vector<Condition> conditions_of(TaskId task) const {
    std::vector<Condition> conditions;
    for (const Value& value : named_.catalog.values[task]) {
      const std::string_view behavior = named_.behaviors[value.behavior];
      conditions.push_back({behavior, {}, {}});
      for (const FittingValue& fitting : named_.catalog.fitting_values_of(value.behavior)) {
        conditions.push_back({behavior, named_.variables[fitting.variable],
                              named_.catalog.name_of_value({fitting.variable, fitting.value})});
      }
    }
    std::sort(conditions.begin(), conditions.end());
    return conditions;
  }
  [[nodiscard]] std::vector<std::string_view> sorted_values_of(std::uint32_t variable) const {
    std::vector<std::string_view> values;
    for (std::uint32_t value = 0; value < named_.catalog.variables[variable].value_count; ++value) {
      values.push_back(named_.catalog.name_of_value({variable, value}));
    }
    std::sort(values.begin(), values.end());
    return values;
  }

  struct Performing {
    std::string_view behavior;
    Millionths suitability = 0;
  };
  /// Those that fit in the value, the best first; nothing if there is no such value.
  [[nodiscard]] std::optional<std::vector<Performing>> of(TaskId task, std::uint32_t variable,
                                                          std::string_view name) const {
    const auto value = named_.catalog.find_value(variable, name);
    if (!value) return std::nullopt;
    std::vector<Performing> performing;
    for (const Value& each : named_.catalog.values[task]) {
      if (!fits(each.behavior, {variable, *value})) continue;
      performing.push_back({named_.behaviors[each.behavior], each.suitability});
    }
    std::sort(performing.begin(), performing.end(), [](const Performing& a, const Performing& b) {
      return std::pair(-a.suitability, a.behavior) < std::pair(-b.suitability, b.behavior);
    });
    return performing;
  }

 private:
  [[nodiscard]] bool fits(BehaviorId behavior, VariableValue in) const {
    bool is_named = false;
    for (const FittingValue& fitting : named_.catalog.fitting_values_of(behavior)) {
      if (fitting.variable != in.variable) continue;
      if (fitting.value == in.value) return true;
      is_named = true;
    }
    return !is_named;
  }

  NamedCatalog named_;
  std::map<std::string_view, TaskId> tasks_;
  std::map<std::string_view, std::uint32_t> variables_;
};

using Fitting = std::optional<std::vector<FittingBehaviors::Performing>>;

std::string describe(const Fitting& fitting) {
  if (!fitting) return "no such value";
  if (fitting->empty()) return "none";
  return join(*fitting, ", ", [](const FittingBehaviors::Performing& each) {
    return concat(printable(each.behavior), " ", format_percent(each.suitability));
  });
}

/// Suitabilities are told elsewhere.
bool have_same_behaviors(const Fitting& a, const Fitting& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  const auto names = [](const Fitting& fitting) {
    std::set<std::string_view> all;
    for (const FittingBehaviors::Performing& each : *fitting) all.insert(each.behavior);
    return all;
  };
  return names(a) == names(b);
}

/// The names of the values of a variable in either catalog, in the order of the newer one.
std::vector<std::string_view> values_of(const FittingBehaviors& before, std::uint32_t old_variable,
                                        const FittingBehaviors& after, std::uint32_t new_variable) {
  std::vector<std::string_view> values;
  const auto add = [&values](const CompiledCatalog& catalog, std::uint32_t variable) {
    for (std::uint32_t place = 0; place < catalog.variables[variable].value_count; ++place) {
      const std::string_view value = catalog.name_of_value({variable, place});
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  };
  add(after.named().catalog, new_variable);
  add(before.named().catalog, old_variable);
  return values;
}

}  // namespace

std::vector<FittingChange> compare_fitting(const CompiledCatalog& before,
                                           const CompiledCatalog& after, const Renames& renames) {
  const FittingBehaviors of_old(with_new_names(before, after, renames));
  const FittingBehaviors of_new(with_own_names(after));
  std::vector<FittingChange> changes;
  for (const TaskId task : after.task_ids) {
    const std::string_view name = after.name_of_task(task);
    const auto old_task = of_old.find_task(name);
    if (!old_task) continue;
    const bool is_same = of_old.conditions_of(*old_task) == of_new.conditions_of(task);
    std::set<std::string_view> variables = of_new.variables_of(task);
    variables.merge(of_old.variables_of(*old_task));
    for (const std::string_view variable : variables) {
      const auto old_variable = of_old.find_variable(variable);
      const auto new_variable = of_new.find_variable(variable);
      if (!old_variable || !new_variable) continue;
      if (is_same &&
          of_old.sorted_values_of(*old_variable) == of_new.sorted_values_of(*new_variable)) {
        continue;
      }
      for (const std::string_view value : values_of(of_old, *old_variable, of_new, *new_variable)) {
        const Fitting was = of_old.of(*old_task, *old_variable, value);
        const Fitting is = of_new.of(task, *new_variable, value);
        if (have_same_behaviors(was, is)) continue;
        changes.push_back({std::string(name), std::string(variable), std::string(value),
                           describe(was), describe(is)});
      }
    }
  }
  return changes;
}

}  // namespace cbc
