#include <algorithm>

#include <fmt/format.h>

#include "compiled/known_costs.h"
#include "compiled/verify_parts.h"

namespace cbc::verify {
namespace {

/// In rank order, and in the arrays of the group.
Fault find_value_fault(const CompiledCatalog& catalog, TaskId task, ValueId id, KnownCosts& costs) {
  const Value& value = catalog.values.items[id];
  const std::uint32_t group = catalog.tasks[task].group;
  if (value.behavior < catalog.group_behaviors[group] ||
      value.behavior >= catalog.group_behaviors[group + 1]) {
    return fmt::format("value {} of task {}: its behavior {} is none of group {}", id, task,
                       value.behavior, group);
  }
  if (value.suitability > one_million) {
    return fmt::format("value {} of task {}: its suitability of {} millionths is over 1", id, task,
                       value.suitability);
  }
  if (value.cost != costs.of(value.suitability)) {
    return fmt::format("value {} of task {}: the cost of its suitability is wrong", id, task);
  }
  if (catalog.value_tasks[id] != task) {
    return fmt::format("value {} of task {}: 'value_tasks' says task {}", id, task,
                       catalog.value_tasks[id]);
  }
  if (id == catalog.values.begin[task]) return std::nullopt;
  const Value& before = catalog.values.items[id - 1];
  if (before.suitability < value.suitability ||
      (before.suitability == value.suitability && before.behavior >= value.behavior)) {
    return fmt::format("the values of task {} are not in rank order", task);
  }
  return std::nullopt;
}

/// There are as many places in `performs` as values, so each value has one if none has two.
Fault find_performs_fault(const CompiledCatalog& catalog) {
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const auto row = catalog.performs[behavior];
    if (row.empty()) return fmt::format("behavior {} performs no task", behavior);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const ValueId value = row[i];
      if (value >= catalog.values.items.size()) {
        return fmt::format("behavior {} performs value {} of {}", behavior, value,
                           catalog.values.items.size());
      }
      if (catalog.values.items[value].behavior != behavior) {
        return fmt::format("behavior {} performs value {}, which is of behavior {}", behavior,
                           value, catalog.values.items[value].behavior);
      }
      if (i > 0 && catalog.value_tasks[row[i - 1]] >= catalog.value_tasks[value]) {
        return fmt::format("the tasks that behavior {} performs do not ascend", behavior);
      }
    }
  }
  return std::nullopt;
}

Fault find_requirement_fault(const CompiledCatalog& catalog, std::uint32_t group, BehaviorId id,
                             KnownCosts& costs) {
  std::uint64_t level = 0;  // one more than a level may not fit in 32 bits
  TaskId next = catalog.group_tasks[group];
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    const TaskId task = requirement.task;
    if (task < catalog.group_tasks[group] || task >= catalog.group_tasks[group + 1]) {
      return fmt::format("behavior {} requires task {}, which is none of its group {}", id, task,
                         group);
    }
    if (task < next) return fmt::format("the tasks that behavior {} requires do not ascend", id);
    next = task + 1;
    if (requirement.minimum_performance > one_million) {
      return fmt::format("behavior {} requires {} millionths of task {}, which is over 1", id,
                         requirement.minimum_performance, task);
    }
    if (requirement.minimum_cost != costs.of(requirement.minimum_performance)) {
      return fmt::format("behavior {}: the cost of what it requires of task {} is wrong", id, task);
    }
    level = std::max(level, std::uint64_t{catalog.tasks[task].level} + 1);
  }
  if (catalog.behaviors[id].level == level) return std::nullopt;
  return fmt::format("behavior {}: its level is {}, expected {}", id, catalog.behaviors[id].level,
                     level);
}

}  // namespace

Fault find_value_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  std::uint64_t words = 0;
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (catalog.words[task] != words) {
      return fmt::format("task {}: its first domain word is {}, expected {}", task,
                         catalog.words[task], words);
    }
    const std::uint32_t end = catalog.values.begin[task + 1];
    for (ValueId id = catalog.values.begin[task]; id < end; ++id) {
      if (auto fault = find_value_fault(catalog, task, id, costs)) return fault;
    }
    words += (catalog.values[task].size() + 63) / 64;
  }
  if (catalog.words.back() != words) {
    return fmt::format("there are {} domain words, expected {}", catalog.words.back(), words);
  }
  return find_performs_fault(catalog);
}

/// That levels of tasks are the highest of their behaviors is find_graph_fault's. Both together
/// make levels fall along every requirement, so there is no cycle, and only these levels will do.
Fault find_requirement_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) {
    const BehaviorId end = catalog.group_behaviors[group + 1];
    for (BehaviorId id = catalog.group_behaviors[group]; id < end; ++id) {
      if (auto fault = find_requirement_fault(catalog, group, id, costs)) return fault;
    }
  }
  return std::nullopt;
}

}  // namespace cbc::verify
