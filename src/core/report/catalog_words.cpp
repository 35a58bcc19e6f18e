#include "core/report/catalog_words.h"

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

double to_seconds(Microseconds time) {
  return static_cast<double>(time) / static_cast<double>(second);
}

std::string format_time(Microseconds time) {
  return fmt::format("{:.{}f}", to_seconds(time), time % 1000 == 0 ? 3 : 6);
}

std::string task_name(const CompiledCatalog& catalog, TaskId task) {
  const std::string_view name = catalog.name_of_task(task);
  return (catalog.find_behavior(name) ? "task " : "") + printable(name);
}

std::string behavior_name(const CompiledCatalog& catalog, BehaviorId behavior) {
  const std::string_view name = catalog.name_of_behavior(behavior);
  return (catalog.find_task(name) ? "behavior " : "") + printable(name);
}

std::vector<std::string> names_in_sentence(const CompiledCatalog& catalog,
                                           std::span<const TaskId> tasks) {
  std::vector<std::string> names;
  for (const TaskId task : tasks) names.push_back(task_name(catalog, task));
  return names;
}

std::vector<std::string> names_of_tasks(const CompiledCatalog& catalog,
                                        std::span<const TaskId> tasks) {
  std::vector<std::string> names;
  for (const TaskId task : tasks) names.push_back(printable(catalog.name_of_task(task)));
  return names;
}

std::vector<std::string> names_of_behaviors(const CompiledCatalog& catalog,
                                            std::span<const BehaviorId> behaviors) {
  std::vector<std::string> names;
  for (const BehaviorId id : behaviors) names.push_back(printable(catalog.name_of_behavior(id)));
  return names;
}

std::string describe_value(const CompiledCatalog& catalog, VariableValue value) {
  return fmt::format("{} is {}", printable(catalog.name_of_variable(value.variable)),
                     printable(catalog.name_of_value(value)));
}

std::string describe_running(const CompiledCatalog& catalog, TaskId task, BehaviorId behavior) {
  const std::string text = printable(catalog.name_of_task(task)) + " runs";
  return behavior == none ? text : text + " with " + printable(catalog.name_of_behavior(behavior));
}

std::string describe_situation(const CompiledCatalog& catalog, const Situation& situation) {
  std::vector<std::string> parts;
  for (const Availability& entry : situation.availability) {
    parts.push_back(fmt::format("{} {}", printable(catalog.behavior_names[entry.behavior]),
                                entry.available ? "available" : "unavailable"));
  }
  for (const VariableValue value : situation.variables) {
    parts.push_back(describe_value(catalog, value));
  }
  return parts.empty() ? "" : " " + join(parts, ", ");
}

}  // namespace cbc
