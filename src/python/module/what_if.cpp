#include "python/module/what_if.h"

#include <utility>

namespace cbc::python {
namespace {

/// What may be asked for: any task that can be requested, and behaviors that were made unavailable
/// may come back.
MoveChoice choice_in(const CompiledCatalog& catalog, const State& state,
                     std::span<const std::int32_t> priorities) {
  MoveChoice choice = choice_of(catalog, Script{});
  choice.priorities.assign(priorities.begin(), priorities.end());
  for (std::uint32_t index = 0; index < catalog.behaviors.size(); ++index) {
    if (state.is_denied(catalog.behavior_ids[index])) choice.behaviors.push_back(index);
  }
  return choice;
}

std::shared_ptr<const PastCall> past_call(const Session& session, const Snapshot& before,
                                          const PossibleMove::Event& first) {
  Call call = first.step == nullptr ? clock_call(first.record.time) : Call{*first.step};
  return std::make_shared<const PastCall>(
      PastCall{session.catalog(), session.options(), before, std::move(call)});
}

Option option_of(const Session& session, const Snapshot& before, const PossibleMove& move) {
  const CompiledCatalog& catalog = *session.catalog()->compiled;
  Option option;
  option.effects = effects_of(catalog, move);
  const auto past = past_call(session, before, move.events.front());
  for (const PossibleMove::Event& event : move.events) {
    HandledEvent& handled = option.events.emplace_back(HandledEvent{past, event.record, true});
    handled.record.search = nullptr;
    if (event.search != nullptr) handled.is_proven = is_proven(event.search->result.status);
  }
  const State& after = move.after();
  for (const TaskId task : option.effects.started) {
    option.started.emplace_back(task, after.behavior(task));
  }
  for (const TaskId task : option.effects.changed) {
    option.changed.emplace_back(task, after.behavior(task));
  }
  for (const TaskId task : option.effects.requested) {
    option.requested.emplace_back(task, after.request(task).priority);
  }
  for (const TaskId task : option.effects.queued) {
    option.queued.emplace_back(task, after.queue().due(catalog.tasks[task].catalog_index));
  }
  return option;
}

}  // namespace

std::vector<Option> find_options(const Session& session, std::span<const std::int32_t> priorities,
                                 const IsStopped& is_stopped) {
  const CompiledCatalog& catalog = *session.catalog()->compiled;
  const Snapshot before = session.snapshot();
  const std::vector<Step> steps =
      list_moves(catalog, session.state(), choice_in(catalog, session.state(), priorities));
  std::vector<Option> options;
  const RunResult result = try_moves(
      catalog, to_internal(session.options(), is_stopped), before, steps,
      [&](const PossibleMove& move) { options.push_back(option_of(session, before, move)); });
  if (result.status == Coordinator::Status::too_many_clock_events) {
    throw CallFault("what could happen next takes too many events of the clock");
  }
  return options;
}

}  // namespace cbc::python
