#pragma once

#include <cstdint>
#include <vector>

#include "coverage/engine/goal_watch.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/state.h"
#include "verify/engine/model.h"
#include "verify/engine/stepper.h"

namespace cbc {

/// Makes moves of an exploration once more, on a coordinator that is watched for goals.
class StateReplay final : private EventListener {
 public:
  /// Model and watch must outlive this object.
  StateReplay(const Model& model, GoalWatch& watch);

  /// Takes up the state of the stepper.
  void load(const Stepper& stepper);
  /// Makes a move from the state, which must have it.
  void take(const Move& move);

  /// After the last move.
  [[nodiscard]] const State& state() const { return coordinator_.state(); }
  /// Whether a task that runs after the last move ran before it with the same behavior, which has
  /// not been activated again.
  [[nodiscard]] bool goes_on(TaskId task) const;
  /// The reactive tasks that started by themselves, that gave way in the last move.
  [[nodiscard]] const std::vector<TaskId>& started() const { return started_; }
  [[nodiscard]] const std::vector<TaskId>& gave_way() const { return gave_way_; }

 private:
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override;
  void on_event(const EventRecord& record) override;

  const Model& model_;
  GoalWatch& watch_;
  Coordinator coordinator_;
  Snapshot state_;
  std::vector<TaskId> started_;
  std::vector<TaskId> gave_way_;
};

}  // namespace cbc
