#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "versions/difference/catalog_diff.h"
#include "versions/difference/catalog_facts.h"
#include "versions/names/translation.h"

namespace cbc {
namespace {

/// The behaviors that perform a task in a value, with their suitabilities; nothing if there is no
/// such value.
using Fitting = std::optional<std::map<std::string_view, Millionths>>;

bool fits(const CompiledCatalog& catalog, BehaviorId behavior, VariableValue in) {
  bool is_named = false;
  for (const FittingValue& fitting : catalog.fitting_values_of(behavior)) {
    if (fitting.variable != in.variable) continue;
    if (fitting.value == in.value) return true;
    is_named = true;
  }
  return !is_named;
}

Fitting fitting_in(const NamedCatalog& named, TaskId task, std::uint32_t variable,
                   std::string_view name) {
  const auto value = named.catalog.find_value(variable, name);
  if (!value) return std::nullopt;
  Fitting::value_type found;
  for (const Value& each : named.catalog.values[task]) {
    if (!fits(named.catalog, each.behavior, {variable, *value})) continue;
    found.emplace(named.behaviors[each.behavior], each.suitability);
  }
  return found;
}

std::string describe(const Fitting& fitting) {
  if (!fitting) return "no such value";
  if (fitting->empty()) return "none";
  std::vector<std::pair<std::string_view, Millionths>> best_first(fitting->begin(), fitting->end());
  std::stable_sort(best_first.begin(), best_first.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return join(best_first, ", ", [](const auto& each) {
    return concat(printable(each.first), " ", format_percent(each.second));
  });
}

/// Suitabilities are told elsewhere.
bool have_same_behaviors(const Fitting& a, const Fitting& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::equal(a->begin(), a->end(), b->begin(), b->end(),
                    [](const auto& one, const auto& other) { return one.first == other.first; });
}

/// The names of the values of a variable in either catalog, in the order of the newer one.
std::vector<std::string_view> values_of(const CompiledCatalog& before, std::uint32_t old_variable,
                                        const CompiledCatalog& after, std::uint32_t new_variable) {
  std::vector<std::string_view> values;
  const auto add = [&values](const CompiledCatalog& catalog, std::uint32_t variable) {
    for (std::uint32_t place = 0; place < catalog.variables[variable].value_count; ++place) {
      const std::string_view value = catalog.name_of_value({variable, place});
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  };
  add(after, new_variable);
  add(before, old_variable);
  return values;
}

}  // namespace

std::vector<FittingChange> compare_fitting(const CompiledCatalog& before,
                                           const CompiledCatalog& after, const Renames& renames) {
  const NamedCatalog of_old = with_new_names(before, after, renames);
  const NamedCatalog of_new = with_own_names(after);
  const TranslationPair translations(before, after, renames);
  std::vector<FittingChange> changes;
  for (const TaskId task : after.task_ids) {
    const TaskId old_task = translations.to_old.tasks[task];
    if (old_task == none) continue;
    // Those that a behavior of the task names, in either catalog.
    std::map<std::string_view, std::pair<std::uint32_t, std::uint32_t>> variables;
    const auto add = [&](std::uint32_t of_before, std::uint32_t of_after) {
      if (of_before == none || of_after == none) return;
      variables.emplace(after.name_of_variable(of_after), std::pair(of_before, of_after));
    };
    for (const Value& value : after.values[task]) {
      for (const FittingValue& fitting : after.fitting_values_of(value.behavior)) {
        add(translations.to_old.variables[fitting.variable], fitting.variable);
      }
    }
    for (const Value& value : before.values[old_task]) {
      for (const FittingValue& fitting : before.fitting_values_of(value.behavior)) {
        add(fitting.variable, translations.to_new.variables[fitting.variable]);
      }
    }
    for (const auto& [name, numbers] : variables) {
      const auto [old_variable, variable] = numbers;
      for (const std::string_view value : values_of(before, old_variable, after, variable)) {
        const Fitting was = fitting_in(of_old, old_task, old_variable, value);
        const Fitting is = fitting_in(of_new, task, variable, value);
        if (have_same_behaviors(was, is)) continue;
        changes.push_back({std::string(after.name_of_task(task)), std::string(name),
                           std::string(value), describe(was), describe(is)});
      }
    }
  }
  return changes;
}

}  // namespace cbc
