#include "why/moment.h"

#include <string_view>

namespace cbc {
namespace {

/// Only the group counts for the answer, and for the reasons against another one; what runs
/// elsewhere, and was requested, is a part of the objectives that are told.
void save_state(const CompiledCatalog& catalog, const State& state, GroupId group,
                Snapshot& before) {
  before.running.clear();
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    Snapshot::RunningTask& entry = before.running.emplace_back();
    entry.task = task;
    entry.value_index = state.value_index(task);
    if (const Request* const request = state.find_request(task)) {
      entry.request = Request{request->priority, request->event, {}, request->time};
    }
  }
  before.suspended.clear();
  for (TaskId task = catalog.group_tasks[group]; task < catalog.group_tasks[group + 1]; ++task) {
    if (!state.is_suspended(task)) continue;
    const Request& request = *state.find_own_request(task);
    before.suspended.emplace_back(task, Request{request.priority, request.event, {}, request.time});
  }
  before.denied.clear();
  before.faulty.clear();
  before.failed.clear();
  for (BehaviorId behavior = catalog.group_behaviors[group];
       behavior < catalog.group_behaviors[group + 1]; ++behavior) {
    if (state.is_denied(behavior)) before.denied.push_back(behavior);
    if (state.is_faulty(behavior)) before.faulty.push_back(behavior);
    if (state.has_failed(behavior)) before.failed.emplace_back(behavior, state.failed_at(behavior));
  }
  before.variables = state.variables();
}

std::shared_ptr<const State> restored(const CompiledCatalog& catalog, const Snapshot& snapshot) {
  auto state = std::make_shared<State>(catalog);
  state->restore(snapshot);
  return state;
}

}  // namespace

void Moment::keep(const CompiledCatalog& catalog, const EventRecord& record,
                  const Circumstances& circumstances, const Assignment* answer) {
  static_cast<EventRecord&>(event) = record;
  event.conflict.clear();
  event.explanation.clear();
  event.outcome = answer == nullptr ? Outcome::rejected : Outcome::accepted;
  if (record.search != nullptr) {
    search = *record.search;
    event.search = &search;
  }
  trigger = circumstances.trigger;
  trigger.parameters = std::string_view();  // they decide nothing, and do not last
  failed.assign(circumstances.failed.begin(), circumstances.failed.end());
  save_state(catalog, circumstances.state, trigger.group, before);
  solution.clear();
  if (answer != nullptr) solution = *answer;
}

Return::Return(const CompiledCatalog& catalog, const Moment& moment)
    : before_(restored(catalog, moment.before)),
      builder_(catalog, *before_),
      circumstances_{*before_, moment.trigger, moment.search.protection, moment.failed} {
  if (moment.solution.empty()) return;
  builder_.load(moment.trigger, moment.event.index);
  for (const BehaviorId behavior : moment.failed) builder_.exclude(behavior);
  circumstances_.problem = &builder_.build(moment.search.protection);
}

void Journal::note(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) {
  const GroupId group = circumstances.trigger.group;
  if (solution != nullptr) rejected_.erase(group);
  (solution != nullptr ? accepted_ : rejected_)[group].keep(catalog_, record, circumstances,
                                                            solution);
}

}  // namespace cbc
