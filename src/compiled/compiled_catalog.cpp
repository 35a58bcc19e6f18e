#include "compiled/compiled_catalog.h"

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

}  // namespace cbc
