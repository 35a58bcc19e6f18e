#include "script/script_names.h"

#include <algorithm>
#include <utility>

namespace cbc {

ScriptNames names_of(const CompiledCatalog& catalog) {
  ScriptNames names;
  names.tasks.assign(catalog.task_names.begin(), catalog.task_names.end());
  names.behaviors.assign(catalog.behavior_names.begin(), catalog.behavior_names.end());
  names.parameters = catalog.task_parameters;
  for (const BehaviorId behavior : catalog.behavior_ids) {
    std::vector<std::uint32_t> tasks;
    for (const ValueId value : catalog.performs[behavior]) {
      tasks.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
    }
    std::sort(tasks.begin(), tasks.end());
    names.performs.push_back(std::move(tasks));
  }
  return names;
}

}  // namespace cbc
