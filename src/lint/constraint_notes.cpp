#include "lint/constraint_notes.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// The first list that has both tasks.
Range range_of_list(const Catalog& catalog, TaskIndex a, TaskIndex b) {
  for (const ExclusivityList& list : catalog.exclusivity) {
    const auto has = [&list](TaskIndex task) {
      return std::find(list.tasks.begin(), list.tasks.end(), task) != list.tasks.end();
    };
    if (has(a) && has(b)) return list.range;
  }
  return {};
}

Note to_note(const Reason& reason, const Catalog& catalog, const CompiledCatalog& compiled,
             const Reporter& reporter) {
  const TaskIndex task_index = compiled.tasks[reason.task].catalog_index;
  const Task& task = catalog.tasks[task_index];
  if (reason.kind == Reason::Kind::exclusive) {
    const TaskIndex other = compiled.tasks[reason.other_task].catalog_index;
    return reporter.note(range_of_list(catalog, task_index, other),
                         quote(task.name) + " excludes " + quote(catalog.tasks[other].name));
  }
  if (reason.behavior == none) {
    return reporter.note(
        task.minimum_performance_range,
        quote(task.name) + " runs with at least " + format_percent(reason.minimum_performance));
  }
  const Behavior& behavior = catalog.behaviors[compiled.behaviors[reason.behavior].catalog_index];
  const Requirement& requirement = strongest_requirement(behavior, task_index);
  if (reason.kind == Reason::Kind::performance) {
    return reporter.note(requirement.minimum_performance_range,
                         "behavior " + quote(behavior.name) + " requires " + quote(task.name) +
                             " with at least " + format_percent(reason.minimum_performance));
  }
  return reporter.note(requirement.range,
                       "behavior " + quote(behavior.name) + " requires " + quote(task.name));
}

}  // namespace

const Requirement& strongest_requirement(const Behavior& behavior, TaskIndex task) {
  const Requirement* found = nullptr;
  for (const Requirement& requirement : behavior.requirements) {
    if (requirement.task != task) continue;
    if (found == nullptr || requirement.minimum_performance > found->minimum_performance) {
      found = &requirement;
    }
  }
  return *found;  // NOLINT(clang-analyzer-core.uninitialized.UndefReturn): there is one
}

std::vector<Note> constraint_notes(std::span<const Reason> constraints, const Catalog& catalog,
                                   const CompiledCatalog& compiled, const Reporter& reporter) {
  struct Entry {
    bool requires_task = false;
    std::uint32_t level = 0;
    Note note;
  };
  std::vector<Entry> entries;
  for (const Reason& reason : constraints) {
    const std::uint32_t level =
        reason.behavior == none ? 0 : compiled.behaviors[reason.behavior].level;
    entries.push_back({reason.kind == Reason::Kind::requires_task, level,
                       to_note(reason, catalog, compiled, reporter)});
  }
  // Requirements from the top down, then what they lead to; otherwise as in the file.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.requires_task != b.requires_task) return a.requires_task;
    return a.level != b.level ? a.level > b.level : a.note.range < b.note.range;
  });
  std::vector<Note> notes;
  notes.reserve(entries.size());
  for (Entry& entry : entries) notes.push_back(std::move(entry.note));
  return notes;
}

}  // namespace cbc
