#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "coverage/engine/constraint_relaxation.h"
#include "coverage/engine/goal_notes.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// Sees the events of a mission on a coordinator, and notes the goals that they meet
/// (docs/coverage.md, "Goals"): a monitor of runtime verification, which looks on and changes
/// nothing. GoalSystem does the same for the moves of an exploration. Not for use by several
/// threads.
class GoalMonitor final : public RunListener {
 public:
  /// `goals` are those of find_goals. Catalog and goals must outlive this object. Once the options
  /// say that it is stopped, goals about deciding may be missed.
  GoalMonitor(const CompiledCatalog& catalog, std::span<const Goal> goals,
              const CoordinatorOptions& options);

  /// Begins a mission: nothing runs, and the situation is that of the state.
  void begin(const State& state);
  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution) override;
  void on_event(const ExplainedRecord& record, const Step* /*step*/, const State& state) override {
    note_event(record, state);
  }
  /// Takes an event of a coordinator without a runner. `state`: after the event.
  void note_event(const EventRecord& record, const State& state);

  /// What was seen since the object was made; nothing of timeouts.
  [[nodiscard]] const GoalFacts& facts() const { return notes_.facts(); }
  /// By goal: whether an event has met it.
  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return notes_.met(); }

 private:
  using Kind = Goal::Kind;

  void note_answer(const Circumstances& circumstances, const Assignment& solution);
  void note_timeouts(const EventRecord& record, const State& before);
  void ask_for_deciding(const EventRecord& record, const Circumstances& circumstances,
                        const Assignment* solution);
  void note_situation(const State& state);

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  ConstraintRelaxation relaxation_;
  const std::function<bool()> is_stopped_;            ///< may be empty
  std::vector<std::vector<std::uint32_t>> deciding_;  ///< by group: goals about deciding
  GoalNotes notes_;
  std::vector<BehaviorId> conditional_;  ///< behaviors that name variables
  std::vector<std::uint8_t> fits_;       ///< by place in conditional_
  // Of the tasks of a group, before an event; kept for their memory.
  std::vector<BehaviorId> behaviors_;
  std::vector<std::optional<std::int32_t>> requests_;
};

/// A run of a script, and the goals that it met.
struct MonitoredResult {
  RunResult result;
  std::vector<std::uint8_t> met;  ///< by goal
};

/// Runs a script as run_script does, and monitors it. `goals` are those of find_goals.
[[nodiscard]] MonitoredResult run_monitored(const CompiledCatalog& catalog,
                                            std::span<const Goal> goals, const Script& script,
                                            const CoordinatorOptions& options);

}  // namespace cbc
