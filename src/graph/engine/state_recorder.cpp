#include "graph/engine/state_recorder.h"

#include <cstdint>
#include <utility>

#include "core/words/words.h"

namespace cbc {
namespace {

std::vector<draw::RunState::RunningTask> running_tasks(const CompiledCatalog& catalog,
                                                       const State& state) {
  std::vector<draw::RunState::RunningTask> running;
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    auto& one = running.emplace_back();
    one.task = index;
    one.behavior = catalog.behaviors[state.behavior(task)].catalog_index;
    if (state.has_request(task)) one.priority = state.request(task).priority;
  }
  return running;
}

}  // namespace

StateRecorder::StateRecorder(const CompiledCatalog& catalog, const Script& script,
                             const WantedState& wanted)
    : catalog_(catalog), wanted_(wanted) {
  moment_.script = script.file;
  has_passed_ = wanted.index == 0;
  State state(catalog);
  state.change_situation(script.situation.availability, script.situation.variables);
  note_behaviors(state);
}

void StateRecorder::note_behaviors(const State& state) {
  state_.unavailable.clear();
  state_.misfits.clear();
  state_.faulty.clear();
  for (std::uint32_t index = 0; index < catalog_.behavior_ids.size(); ++index) {
    const BehaviorId behavior = catalog_.behavior_ids[index];
    if (state.is_denied(behavior)) {
      state_.unavailable.push_back(index);
    } else if (const auto variable = catalog_.find_misfit(behavior, state.variables())) {
      const VariableValue value{*variable, state.value_of(*variable)};
      state_.misfits.push_back({index, describe_value(catalog_, value)});
    }
    if (state.is_faulty(behavior)) state_.faulty.push_back(index);
  }
  moment_.situation.clear();
  for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
    if (variable > 0) moment_.situation += ", ";
    moment_.situation += describe_value(catalog_, {variable, state.value_of(variable)});
  }
}

void StateRecorder::on_event(const ExplainedRecord& record, const Step* /*step*/,
                             const State& state) {
  events_ = record.index;
  has_passed_ |= wanted_.time && record.time > *wanted_.time;
  if (has_passed_) return;
  has_passed_ = record.index == wanted_.index;
  moment_.index = record.index;
  moment_.time = record.time;
  moment_.event = event_and_outcome(catalog_, record, nullptr);
  state_.before = std::exchange(state_.running, running_tasks(catalog_, state));
  state_.finished.reset();
  if (record.verb == Verb::finish && record.outcome == Outcome::accepted) {
    state_.finished = catalog_.behaviors[record.behavior].catalog_index;
  }
  state_.changes.clear();
  for (const Change& change : record.changes) {
    state_.changes.push_back({catalog_.behaviors[change.behavior].catalog_index,
                              change.is_activation, change.success,
                              change.cause == ChangeCause::undone});
  }
  // This takes time in proportion to the catalog, so only for states that may be the selected one.
  if (has_passed_ || wanted_.time) note_behaviors(state);
}

void StateRecorder::on_end(const State& state) {
  if (!has_passed_) note_behaviors(state);
}

}  // namespace cbc
