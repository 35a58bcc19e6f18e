#include "versions/names/renames.h"

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

template <typename Number>
using Pairs = std::vector<std::pair<Number, Number>>;

/// "a task and a behavior": what a catalog has under a name; empty if it has nothing.
std::string kinds_of(const CompiledCatalog& catalog, std::string_view name) {
  std::vector<std::string> kinds;
  if (task_called(catalog, name)) kinds.emplace_back("a task");
  if (behavior_called(catalog, name)) kinds.emplace_back("a behavior");
  if (variable_called(catalog, name)) kinds.emplace_back("a situation variable");
  return list_with_and(kinds);
}

std::string describe_unknown(const CompiledCatalog& catalog, std::string_view name) {
  std::vector<std::string_view> known;
  for (const std::string_view task : catalog.task_names) known.push_back(task);
  for (const std::string_view behavior : catalog.behavior_names) known.push_back(behavior);
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    known.push_back(catalog.name_of_variable(variable));
  }
  return fmt::format("catalog {} has no task, behavior or situation variable {}{}",
                     quote(catalog.file), quote(name), did_you_mean(nearest(name, known)));
}

/// Adds a pair of one kind, if both catalogs have the names in it; `name_of` names a number.
/// Returns what is wrong, or nothing.
template <typename Number, typename Called, typename NameOf>
std::string add_pair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                     std::string_view old_name, std::string_view new_name, Called called,
                     NameOf name_of, Pairs<Number>& pairs) {
  const std::optional<Number> of_old = called(old_catalog, old_name);
  const std::optional<Number> of_new = called(new_catalog, new_name);
  if (!of_old || !of_new) return {};
  for (const auto& [old_before, new_before] : pairs) {
    const std::string_view from = name_of(old_catalog, old_before);
    const std::string_view to = name_of(new_catalog, new_before);
    const auto refuse = [&](std::string_view name, std::string_view what) {
      return fmt::format("{} {}: {} and {}", quote(name), what, quote(concat(from, "=", to)),
                         quote(concat(old_name, "=", new_name)));
    };
    if (from == old_name) return refuse(old_name, "is renamed twice");
    if (to == new_name) return refuse(new_name, "is the new name of two");
    if (from == new_name) return refuse(new_name, "is both an old and a new name");
    if (to == old_name) return refuse(old_name, "is both an old and a new name");
  }
  pairs.emplace_back(*of_old, *of_new);
  return {};
}

}  // namespace

std::string add_rename(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                       std::string_view old_name, std::string_view new_name, Renames& renames) {
  const std::string old_kinds = kinds_of(old_catalog, old_name);
  const std::string new_kinds = kinds_of(new_catalog, new_name);
  if (old_kinds.empty()) return describe_unknown(old_catalog, old_name);
  if (new_kinds.empty()) return describe_unknown(new_catalog, new_name);
  if (old_name == new_name) {
    return fmt::format("{} has the same name in both catalogs", quote(old_name));
  }
  const std::size_t before =
      renames.tasks.size() + renames.behaviors.size() + renames.variables.size();
  const auto add = [&](auto called, auto name_of, auto& pairs) {
    return add_pair(old_catalog, new_catalog, old_name, new_name, called, name_of, pairs);
  };
  std::string fault = add(
      task_called, [](const CompiledCatalog& in, TaskId task) { return in.name_of_task(task); },
      renames.tasks);
  if (fault.empty()) {
    fault = add(
        behavior_called,
        [](const CompiledCatalog& in, BehaviorId behavior) {
          return in.name_of_behavior(behavior);
        },
        renames.behaviors);
  }
  if (fault.empty()) {
    fault = add(
        variable_called,
        [](const CompiledCatalog& in, std::uint32_t variable) {
          return in.name_of_variable(variable);
        },
        renames.variables);
  }
  if (!fault.empty()) return fault;
  if (renames.tasks.size() + renames.behaviors.size() + renames.variables.size() > before) {
    return {};
  }
  return fmt::format("{} is {} of {}, {} is {} of {}", quote(old_name), old_kinds,
                     quote(old_catalog.file), quote(new_name), new_kinds, quote(new_catalog.file));
}

std::string add_renames(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                        const std::vector<std::string>& entries, Renames& renames) {
  for (const std::string_view entry : entries) {
    const std::size_t equals = entry.find('=');
    std::string fault = add_rename(old_catalog, new_catalog, entry.substr(0, equals),
                                   entry.substr(equals + 1), renames);
    if (!fault.empty()) return fault;
  }
  return {};
}

}  // namespace cbc
