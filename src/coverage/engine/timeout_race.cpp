#include "coverage/engine/timeout_race.h"

#include <algorithm>
#include <iterator>

namespace cbc {

TimeoutRace::TimeoutRace(const Model& model) : model_(model) {
  const CompiledCatalog& catalog = model.catalog();
  for (std::uint32_t value = 0; value < model.value_count(); ++value) {
    const TaskId task = model.tasks()[model.task_of(value)].id;
    const BehaviorId behavior = model.behaviors()[model.behavior_of(value)].id;
    timeouts_.emplace_back(timeout_of(catalog, task, behavior), catalog.tasks[task].catalog_index);
  }
}

void TimeoutRace::note(const Stepper& stepper, const Move& move, const Changes& changes) {
  running_.clear();
  for (std::uint32_t task = 0; task < model_.tasks().size(); ++task) {
    const std::uint16_t cell = stepper.cells_after()[task];
    const std::uint32_t value = model_.tasks()[task].values.begin + cell - 1U;
    if (cell != 0 && timeouts_[value].first > 0) running_.push_back(value);
  }
  const auto goes_on = [&](std::uint32_t value) {
    return changes.taken[model_.task_of(value)] == 0 &&
           changes.activated[model_.behavior_of(value)] == 0;
  };
  const auto fails = [&](std::uint32_t value) {
    const BehaviorId behavior = model_.behaviors()[model_.behavior_of(value)].id;
    return move.kind == Move::Kind::failure &&
           model_.catalog().behaviors[behavior].catalog_index == move.subject;
  };
  for (const std::uint32_t value : running_) {
    const auto [entry, is_new] = sooner_.try_emplace(value);
    Values& sooner = entry->second;
    if (is_new) {
      for (const std::uint32_t other : running_) {
        if (timeouts_[other] < timeouts_[value]) sooner.push_back(other);
      }
    }
    if (sooner.empty()) continue;
    std::erase_if(sooner, [&](std::uint32_t other) {
      if (!std::binary_search(running_.begin(), running_.end(), other)) return true;
      return goes_on(value) && (fails(other) || !goes_on(other));
    });
  }
}

void TimeoutRace::add(const TimeoutRace& other) {
  for (const auto& [value, sooner] : other.sooner_) {
    const auto [entry, is_new] = sooner_.try_emplace(value, sooner);
    if (is_new) continue;
    Values both;
    std::set_intersection(entry->second.begin(), entry->second.end(), sooner.begin(), sooner.end(),
                          std::back_inserter(both));
    entry->second = std::move(both);
  }
}

void TimeoutRace::tell(GoalFacts& facts) const {
  const CompiledCatalog& catalog = model_.catalog();
  const auto id_of = [&](std::uint32_t value) {
    const Model::Task& task = model_.tasks()[model_.task_of(value)];
    return ValueId(catalog.values.begin[task.id] + (value - task.values.begin));
  };
  for (const auto& [value, sooner] : sooner_) {
    if (!sooner.empty()) facts.forestalled_by[id_of(value)] = id_of(sooner.front());
  }
}

}  // namespace cbc
