#include "coverage/engine/timeout_race.h"

#include <algorithm>
#include <utility>

#include "runtime/coordinator/state.h"

namespace cbc {

void TimeoutRace::note(const StateReplay& replay, const Move& move) {
  const State& state = replay.state();
  // Of timeouts that are due at the same instant, that of the task first in the catalog comes
  // first.
  const auto timeout = [&](ValueId value) {
    const TaskId task = catalog_.task_of(value);
    return std::pair(timeout_of(catalog_, task, catalog_.values.items[value].behavior),
                     catalog_.tasks[task].catalog_index);
  };
  running_.clear();
  for (TaskId task = catalog_.group_tasks[group_]; task < catalog_.group_tasks[group_ + 1];
       ++task) {
    if (!state.is_running(task)) continue;
    const ValueId value = catalog_.values.begin[task] + state.value_index(task);
    if (timeout(value).first > 0) running_.push_back(value);
  }
  for (const ValueId value : running_) {
    const bool goes_on = replay.goes_on(catalog_.task_of(value));
    const auto [entry, is_new] = sooner_.try_emplace(value);
    std::vector<ValueId>& sooner = entry->second;
    if (is_new) {
      for (const ValueId other : running_) {
        if (timeout(other) < timeout(value)) sooner.push_back(other);
      }
    }
    std::erase_if(sooner, [&](ValueId other) {
      if (!std::binary_search(running_.begin(), running_.end(), other)) return true;
      if (!goes_on) return false;
      const BehaviorId behavior = catalog_.values.items[other].behavior;
      const bool fails = move.kind == Move::Kind::failure &&
                         catalog_.behaviors[behavior].catalog_index == move.subject;
      return fails || !replay.goes_on(catalog_.task_of(other));
    });
  }
}

void TimeoutRace::tell(GoalWatch& watch) const {
  for (const auto& [value, sooner] : sooner_) {
    if (!sooner.empty()) watch.note_forestalled(value, sooner.front());
  }
}

}  // namespace cbc
