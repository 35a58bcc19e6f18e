#include "verify/named_in_options.h"

#include <cstddef>
#include <cstdint>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

std::optional<std::vector<TaskId>> find_tasks(const CompiledCatalog& catalog,
                                              std::string_view option,
                                              const std::vector<std::string>& names) {
  std::vector<TaskId> tasks;
  for (const std::string& name : names) {
    const auto place = catalog.find_task(name);
    if (!place) {
      std::vector<std::string_view> known;
      for (const std::string_view task : catalog.task_names) known.push_back(task);
      complain("{}: catalog {} has no task {}{}", option, quote(catalog.file), quote(name),
               did_you_mean(nearest(name, known)));
      return std::nullopt;
    }
    tasks.push_back(catalog.task_ids[*place]);
  }
  return tasks;
}

std::string add_to_situation(const CompiledCatalog& catalog, const std::string& entry,
                             SituationPart& situation) {
  const std::size_t equals = entry.find('=');
  const std::string key = entry.substr(0, equals);
  const std::string value = entry.substr(equals + 1);
  if (const auto variable = catalog.find_variable(key)) {
    for (const VariableValue& given : situation.variables) {
      if (given.variable == *variable) return printable(key) + ": expected once, found twice";
    }
    if (const auto place = catalog.find_value(*variable, value)) {
      situation.variables.push_back({*variable, *place});
      return {};
    }
    std::vector<std::string> values;
    for (std::uint32_t place = 0; place < catalog.variables[*variable].value_count; ++place) {
      values.emplace_back(catalog.name_of_value({*variable, place}));
    }
    return fmt::format("{}: expected {}, found {}", printable(key), join_with_or(values),
                       quote(value));
  }
  if (const auto behavior = catalog.find_behavior(key)) {
    if (value != "true" && value != "false") {
      return fmt::format("{}: expected true or false, found {}", printable(key), quote(value));
    }
    situation.behaviors.push_back({catalog.behavior_ids[*behavior], value == "true"});
    return {};
  }
  std::vector<std::string_view> known;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    known.push_back(catalog.name_of_variable(variable));
  }
  for (const std::string_view behavior : catalog.behavior_names) known.push_back(behavior);
  return fmt::format("catalog {} has no situation variable or behavior {}{}", quote(catalog.file),
                     quote(key), did_you_mean(nearest(key, known)));
}

}  // namespace cbc::cli
