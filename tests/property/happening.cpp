#include "happening.h"

#include <algorithm>
#include <map>

namespace cbc::plain {

VisibleState visible_part(const CompiledCatalog& catalog, const State& state,
                          std::vector<TaskId> tasks) {
  std::sort(tasks.begin(), tasks.end());
  VisibleState visible;
  std::map<Microseconds, std::vector<TaskId>> sets;
  for (const TaskId task : tasks) {
    if (state.is_running(task)) visible.running.emplace_back(task, state.behavior(task));
    if (state.is_waiting(task)) visible.waiting.push_back(task);
    const std::uint32_t item = catalog.tasks[task].catalog_index;
    if (state.queue().has(item)) sets[state.queue().due(item)].push_back(task);
  }
  for (auto& entry : sets) visible.queue.push_back(std::move(entry.second));
  return visible;
}

Happening happening_of(const CompiledCatalog& catalog, const EventRecord& record,
                       const State& state, const std::vector<TaskId>& tasks) {
  Happening happening;
  happening.verb = record.verb;
  happening.origin = record.origin;
  happening.task = record.task;
  happening.behavior = record.behavior;
  happening.outcome = record.outcome;
  for (const cbc::Change& change : record.changes) {
    happening.changes.push_back({change.behavior, change.is_activation, change.success});
  }
  for (const StoppedTask& stopped : record.stopped_tasks) {
    happening.stopped.emplace_back(stopped.task, stopped.cause);
  }
  std::sort(happening.stopped.begin(), happening.stopped.end());
  happening.after = visible_part(catalog, state, tasks);
  return happening;
}

std::string text_of(const CompiledCatalog& catalog, const Happening& happening) {
  const auto task = [&](TaskId id) { return std::string(catalog.name_of_task(id)); };
  const auto behavior = [&](BehaviorId id) { return std::string(catalog.name_of_behavior(id)); };
  std::string text(name_of(happening.verb));
  text.append(" (").append(name_of(happening.origin)).append(")");
  if (happening.task != none) text += " " + task(happening.task);
  if (happening.behavior != none) text += " " + behavior(happening.behavior);
  text.append(" ").append(name_of(happening.outcome));
  for (const Happening::Change& change : happening.changes) {
    text += (change.is_activation ? " +" : " -") + behavior(change.behavior);
    if (!change.success) text += "!";
  }
  for (const auto& [id, cause] : happening.stopped) {
    text.append("; stopped ").append(task(id)).append(" ").append(name_of(cause));
  }
  text += "; running";
  for (const auto& [id, by] : happening.after.running) text += " " + task(id) + ":" + behavior(by);
  text += "; queue";
  for (const auto& set : happening.after.queue) {
    for (const TaskId id : set) text += " " + task(id);
    text += ",";
  }
  text += "; waiting";
  for (const TaskId id : happening.after.waiting) text += " " + task(id);
  return text + "\n";
}

}  // namespace cbc::plain
