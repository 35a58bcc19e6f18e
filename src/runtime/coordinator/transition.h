#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// Applies an answer: brings the active behaviors of a group from one set to another, change by
/// change (docs/semantics.md, "Application"), and records the changes.
class Transition {
 public:
  /// `record` receives the changes of the event.
  Transition(const CompiledCatalog& catalog, State& state, EventRecord& record);

  /// Begins an event. `active_before` must outlive the transition.
  void load(const Trigger& trigger, const std::vector<BehaviorId>& active_before);

  /// Applies a solution to what is active now. `restart`: an active behavior that has to take over
  /// changed parameters, or none. If an activation fails, returns its behavior and makes no further
  /// changes.
  [[nodiscard]] std::optional<BehaviorId> apply(const Assignment& solution, BehaviorId restart,
                                                Microseconds now);

  /// Rolls back to what was active before the event. Returns the behaviors that could not be
  /// activated again, in catalog order; they still count as active.
  [[nodiscard]] const std::vector<BehaviorId>& roll_back(Microseconds now);

  /// Number of behaviors that the solution applied last activates or deactivates, for f4.
  [[nodiscard]] std::uint32_t count_changes() const;

 private:
  void find_wanted(const Assignment& solution);
  void plan();
  [[nodiscard]] bool is_wanted(BehaviorId behavior) const {
    return wanted_[behavior - first_behavior_] != 0;
  }
  [[nodiscard]] bool was_active(BehaviorId behavior) const {
    return was_active_[behavior - first_behavior_] != 0;
  }

  void deactivate(BehaviorId behavior, const Assignment* solution, bool is_restart);
  [[nodiscard]] bool activate(BehaviorId behavior, const Assignment* solution, bool is_restart,
                              Microseconds now);
  [[nodiscard]] BehaviorId behavior_in(const Assignment& solution, TaskId task) const;
  Change& add_change(bool is_activation, BehaviorId behavior);
  void add_task(Change& change, TaskId task);
  void find_tasks_of_activation(Change& change, const Assignment* solution);
  void find_tasks_of_deactivation(Change& change);
  void explain_activation(Change& change) const;
  void explain_deactivation(Change& change, const Assignment& solution) const;
  [[nodiscard]] std::optional<std::int32_t> priority_before(TaskId task) const;
  [[nodiscard]] std::optional<std::int32_t> priority_after(TaskId task) const;

  const CompiledCatalog& catalog_;
  State& state_;
  EventRecord& record_;
  Trigger trigger_;
  TaskId first_task_;
  BehaviorId first_behavior_;
  BehaviorId end_behavior_;
  std::vector<std::uint8_t> was_active_;  ///< by behavior of the group
  std::vector<std::uint8_t> wanted_;      ///< by behavior of the group
  /// By behavior of the group: the place in the record of its last activation that succeeded, or
  /// none.
  std::vector<std::uint32_t> activations_;
  std::vector<BehaviorId> to_deactivate_;
  std::vector<BehaviorId> to_activate_;
  std::vector<BehaviorId> lost_;
};

}  // namespace cbc
