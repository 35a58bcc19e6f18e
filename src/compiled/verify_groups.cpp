#include <fmt/format.h>

#include "compiled/known_costs.h"
#include "compiled/verify_parts.h"

namespace cbc::verify {
namespace {

/// `ids` gives the place of each entry by its place in the catalog, `entries` the inverse; `begin`
/// those of the groups. Within a group the catalog order is kept.
template <typename Entry>
Fault find_order_fault(std::string_view kind, std::span<const Entry> entries,
                       std::span<const std::uint32_t> ids, std::span<const std::uint32_t> begin) {
  for (std::size_t group = 0; group + 1 < begin.size(); ++group) {
    for (std::uint32_t id = begin[group]; id < begin[group + 1]; ++id) {
      const std::uint32_t index = entries[id].catalog_index;
      if (index >= ids.size()) {
        return fmt::format("{} {}: its place in the catalog is {} of {}", kind, id, index,
                           ids.size());
      }
      if (ids[index] != id) {
        return fmt::format("{} {}: place {} of the catalog is that of {} {}", kind, id, index, kind,
                           ids[index]);
      }
      if (id > begin[group] && index < entries[id - 1].catalog_index) {
        return fmt::format("{}s {} and {} are not in catalog order", kind, id - 1, id);
      }
    }
  }
  return std::nullopt;
}

bool is_timeout(Microseconds timeout) { return timeout >= 0 && timeout <= longest_time; }

Fault find_attribute_fault(const CompiledTask& task, TaskId id) {
  const auto is_flag = [](std::uint8_t flag) { return flag <= 1; };
  if (!is_flag(task.start_on_request) || !is_flag(task.reactive_start) ||
      !is_flag(task.keep_running) || !is_flag(task.has_performance_rules)) {
    return fmt::format("task {}: a flag is neither 0 nor 1", id);
  }
  if (task.start_on_request != 0 && task.reactive_start != 0) {
    return fmt::format("task {} has both reactive_start and start_on_request", id);
  }
  if (!is_timeout(task.timeout)) {
    return fmt::format("task {}: its timeout of {} us is out of range", id, task.timeout);
  }
  if (task.minimum_performance > one_million) {
    return fmt::format("task {}: its minimum performance of {} millionths is over 1", id,
                       task.minimum_performance);
  }
  return std::nullopt;
}

Fault find_task_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    const TaskId first = catalog.group_tasks[group];
    if (first == catalog.group_tasks[group + 1]) return fmt::format("group {} has no task", group);
    if (group > 0 && catalog.tasks[first].catalog_index <
                         catalog.tasks[catalog.group_tasks[group - 1]].catalog_index) {
      return fmt::format("groups {} and {} are not in the order of their first tasks", group - 1,
                         group);
    }
    for (TaskId id = first; id < catalog.group_tasks[group + 1]; ++id) {
      const CompiledTask& task = catalog.tasks[id];
      if (task.group != group) {
        return fmt::format("task {}: its group is {}, expected {}", id, task.group, group);
      }
      if (auto fault = find_attribute_fault(task, id)) return fault;
      if (task.minimum_cost != costs.of(task.minimum_performance)) {
        return fmt::format("task {}: the cost of its minimum performance is wrong", id);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Fault find_group_fault(const CompiledCatalog& catalog) {
  if (auto fault = find_order_fault("task", catalog.tasks, catalog.task_ids, catalog.group_tasks)) {
    return fault;
  }
  if (auto fault = find_order_fault("behavior", catalog.behaviors, catalog.behavior_ids,
                                    catalog.group_behaviors)) {
    return fault;
  }
  if (auto fault = find_task_fault(catalog)) return fault;
  for (BehaviorId id = 0; id < catalog.behaviors.size(); ++id) {
    if (is_timeout(catalog.behaviors[id].timeout)) continue;
    return fmt::format("behavior {}: its timeout of {} us is out of range", id,
                       catalog.behaviors[id].timeout);
  }
  return std::nullopt;
}

}  // namespace cbc::verify
