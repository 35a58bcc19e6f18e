#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

// What has another name in a newer catalog, for comparisons of the two.

/// What was renamed: numbers of the old catalog and of the new one. Each number stands once.
struct Renames {
  std::vector<std::pair<TaskId, TaskId>> tasks;
  std::vector<std::pair<BehaviorId, BehaviorId>> behaviors;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> variables;
};

/// Adds what both names stand for: tasks, behaviors, variables. Returns what is wrong, or nothing.
[[nodiscard]] std::string add_rename(const CompiledCatalog& old_catalog,
                                     const CompiledCatalog& new_catalog, std::string_view old_name,
                                     std::string_view new_name, Renames& renames);

/// Adds what "OLD=NEW" entries of an option rename. Returns what is wrong, or nothing.
[[nodiscard]] std::string add_renames(const CompiledCatalog& old_catalog,
                                      const CompiledCatalog& new_catalog,
                                      const std::vector<std::string>& entries, Renames& renames);

// The number of a name in a catalog, or nothing.

inline constexpr auto task_called = [](const CompiledCatalog& catalog, std::string_view name) {
  const auto place = catalog.find_task(name);
  return place ? std::optional(catalog.task_ids[*place]) : std::nullopt;
};
inline constexpr auto behavior_called = [](const CompiledCatalog& catalog, std::string_view name) {
  const auto place = catalog.find_behavior(name);
  return place ? std::optional(catalog.behavior_ids[*place]) : std::nullopt;
};
inline constexpr auto variable_called = [](const CompiledCatalog& catalog, std::string_view name) {
  return catalog.find_variable(name);
};

}  // namespace cbc
