#include "versions/difference/catalog_facts.h"

#include <algorithm>
#include <utility>

#include "core/catalog/allowed_values.h"
#include "core/catalog/situation.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

Attributes attributes_of_task(const CompiledCatalog& catalog, std::uint32_t index) {
  const CompiledTask& task = catalog.tasks[catalog.task_ids[index]];
  Attributes attributes{
      {"execution_goal", std::string(task.keep_running != 0 ? "keep_running" : "achieve_goal")},
      {"minimum_performance", unless_zero(task.minimum_performance)},
      {"reactive_start", task.reactive_start != 0},
      {"start_on_request", task.start_on_request != 0},
      {"timeout", unless_zero(task.timeout)}};
  const TaskRules rules = catalog.rules_of(catalog.task_ids[index]);
  const auto flag_unless = [](std::uint8_t flag, std::uint8_t by_default) {
    return flag == by_default ? AttributeValue() : AttributeValue(flag != 0);
  };
  attributes.push_back({"requestable", flag_unless(rules.requestable, 1)});
  attributes.push_back({"resume", flag_unless(rules.resume, 0)});
  attributes.push_back({"improve", rules.improve == Improve::at_events
                                       ? AttributeValue()
                                       : AttributeValue(std::string(word_of(rules.improve)))});
  attributes.push_back(
      {"reactive_priority", rules.reactive_priority == 0
                                ? AttributeValue()
                                : AttributeValue(std::to_string(rules.reactive_priority))});
  for (Parameter& parameter : parameters_of(catalog, index)) {
    std::string name = concat(parameter_prefix, parameter.name);
    attributes.push_back({std::move(name), describe_allowed(std::move(parameter))});
  }
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  return attributes;
}

/// "[far, near]"
std::string list_values(const std::vector<std::string_view>& values) {
  return "[" + join(values, ", ", spell_value) + "]";
}

/// Values of a situation variable, whose order does not count; they are shown in catalog order.
Attribute set_of_values(std::string name, std::vector<std::string_view> values) {
  std::string shown = list_values(values);
  std::sort(values.begin(), values.end());
  return {std::move(name), list_values(values), std::move(shown)};
}

/// True or false for a variable without values of its own.
Attribute attribute_of(const NamedCondition& condition) {
  std::string name = std::string(condition_prefix) + std::string(condition.variable);
  const bool is_truth = condition.is_boolean && condition.values.size() == 1;
  if (is_truth) return {std::move(name), condition.values.front() == "true"};
  return set_of_values(std::move(name), condition.values);
}

Attributes attributes_of_behavior(const NamedCatalog& named, std::uint32_t index) {
  const CompiledCatalog& catalog = named.catalog;
  const std::string_view package = catalog.texts[catalog.behavior_packages[index]];
  const BehaviorId id = catalog.behavior_ids[index];
  Attributes attributes{
      {"package", package.empty() ? AttributeValue() : AttributeValue(std::string(package))},
      {"timeout", unless_zero(catalog.behaviors[id].timeout)},
      {"retry", catalog.retry_of(id) == Retry::at_events
                    ? AttributeValue()
                    : AttributeValue(std::string(word_of(catalog.retry_of(id))))}};
  for (NamedCondition condition : conditions_of(catalog, id)) {
    condition.variable = named.variables[*catalog.find_variable(condition.variable)];
    attributes.push_back(attribute_of(condition));
  }
  std::sort(attributes.begin(), attributes.end(),
            [](const Attribute& a, const Attribute& b) { return a.name < b.name; });
  return attributes;
}

/// The order of the values does not count, apart from the first one.
Attributes attributes_of_variable(const CompiledCatalog& catalog, std::uint32_t index) {
  const CompiledVariable& variable = catalog.variables[index];
  std::vector<std::string_view> values;
  for (std::uint32_t value = 0; value < variable.value_count; ++value) {
    values.push_back(catalog.name_of_value({index, value}));
  }
  const std::string initial(values.front());
  const bool has_own = variable.is_boolean == 0;
  return {{"initial value", initial},
          has_own ? set_of_values("values", std::move(values)) : Attribute{"values", {}}};
}

void name_limits(NamedCatalog& named) {
  named.limits.clear();
  for (std::size_t limit = 0; limit < named.catalog.limits.size(); ++limit) {
    std::vector<std::string> tasks;
    for (const TaskId task : named.catalog.limited[limit]) tasks.emplace_back(named.tasks[task]);
    std::sort(tasks.begin(), tasks.end());
    named.limits.push_back(join(tasks, ", "));
  }
}

}  // namespace

NamedCatalog with_own_names(const CompiledCatalog& catalog) {
  NamedCatalog named{catalog, {}, {}, {}, {}};
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
    named.tasks.push_back(catalog.name_of_task(task));
  }
  for (BehaviorId behavior(0); behavior < catalog.behaviors.size(); ++behavior) {
    named.behaviors.push_back(catalog.name_of_behavior(behavior));
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    named.variables.push_back(catalog.name_of_variable(variable));
  }
  name_limits(named);
  return named;
}

NamedCatalog with_new_names(const CompiledCatalog& before, const CompiledCatalog& after,
                            const Renames& renames) {
  NamedCatalog named = with_own_names(before);
  for (const auto& [from, to] : renames.tasks) named.tasks[from] = after.name_of_task(to);
  for (const auto& [from, to] : renames.behaviors) {
    named.behaviors[from] = after.name_of_behavior(to);
  }
  for (const auto& [from, to] : renames.variables) {
    named.variables[from] = after.name_of_variable(to);
  }
  name_limits(named);
  return named;
}

bool precedes(const Fact& a, const Fact& b) {
  return std::pair(a.first, a.second) < std::pair(b.first, b.second);
}

std::vector<Fact> facts(const NamedCatalog& named, CatalogChange::Subject subject) {
  const CompiledCatalog& catalog = named.catalog;
  std::vector<Fact> result;
  const auto task_count = static_cast<std::uint32_t>(catalog.tasks.size());
  const auto behavior_count = static_cast<std::uint32_t>(catalog.behaviors.size());
  switch (subject) {
    case ChangeSubject::task:
      for (std::uint32_t task = 0; task < task_count; ++task) {
        result.push_back(
            {named.tasks[catalog.task_ids[task]], {}, attributes_of_task(catalog, task)});
      }
      break;
    case ChangeSubject::behavior:
      for (std::uint32_t behavior = 0; behavior < behavior_count; ++behavior) {
        result.push_back({named.behaviors[catalog.behavior_ids[behavior]],
                          {},
                          attributes_of_behavior(named, behavior)});
      }
      break;
    case ChangeSubject::performs:
      for (TaskId task(0); task < task_count; ++task) {
        for (const Value& value : catalog.values[task]) {
          result.push_back({named.behaviors[value.behavior],
                            named.tasks[task],
                            {{"suitability", value.suitability}}});
        }
      }
      break;
    case ChangeSubject::requirement:
      for (BehaviorId behavior(0); behavior < behavior_count; ++behavior) {
        for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
          result.push_back(
              {named.behaviors[behavior],
               named.tasks[requirement.task],
               {{"minimum_performance", unless_zero(requirement.minimum_performance)}}});
        }
      }
      break;
    case ChangeSubject::variable:
      for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
        result.push_back(
            {named.variables[variable], {}, attributes_of_variable(catalog, variable)});
      }
      break;
    case ChangeSubject::limit:
      for (std::size_t limit = 0; limit < catalog.limits.size(); ++limit) {
        result.push_back(
            {named.limits[limit], {}, {{"at_most", std::to_string(catalog.limits[limit].most)}}});
      }
      break;
    case ChangeSubject::exclusion:
      break;  // pairs of tasks are too many to be facts
  }
  std::sort(result.begin(), result.end(), precedes);
  return result;
}

}  // namespace cbc
