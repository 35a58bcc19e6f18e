#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/script/runner.h"
#include "core/script/script.h"
#include "coverage/engine/constraint_relaxation.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// What an exploration has seen, beside the goals that were met: from this follows why others were
/// not.
struct GoalFacts {
  GoalFacts() = default;
  GoalFacts(const CompiledCatalog& catalog, std::size_t goals);

  std::vector<std::uint8_t> performed;       ///< by value: its task ran with its behavior
  std::vector<std::uint8_t> fitted;          ///< by behavior: it fit some situation
  std::vector<std::uint8_t> misfitted;       ///< by behavior: it did not fit some situation
  std::vector<std::uint8_t> start_accepted;  ///< by task: a start of a script was
  std::vector<std::uint8_t> start_rejected;  ///< the same
  std::vector<std::uint8_t> started_itself;  ///< by task
  std::vector<std::uint8_t> gave_way;        ///< by task
  /// By goal about deciding: some event could have had another answer without the constraint, as
  /// far as one sees without a search.
  std::vector<std::uint8_t> was_asked;
  /// By value: another one that always times out before it, or none.
  std::vector<ValueId> forestalled_by;
};

/// Sees the events of a coordinator, and notes the goals that they meet (docs/coverage.md,
/// "Goals"). Not for use by several threads.
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
  /// The same, without a runner. `state`: after the event.
  void note_event(const EventRecord& record, const State& state);

  /// Where there are no times: any failure may be a timeout.
  void take_failures_for_timeouts() { takes_failures_for_timeouts_ = true; }
  /// Lets only these goals be met again, before each event or path that is to be looked at alone.
  /// Always the same ones, which nothing is asked about.
  void restart(const std::vector<std::uint8_t>& met) {
    apart_ = met;
    met_ = met;
  }
  /// Notes that the reactive task started by itself after it had given way.
  void note_return(TaskId task) { meet(Kind::reactive_returned, task); }
  /// Notes that another value always times out before this one.
  void note_forestalled(ValueId value, ValueId by) { facts_.forestalled_by[value] = by; }
  /// Whether the reactive task has given way since begin().
  [[nodiscard]] bool has_given_way(TaskId task) const { return has_given_way_[task] != 0; }

  /// What was seen since the object was made; of timeouts what was noted.
  [[nodiscard]] const GoalFacts& facts() const { return facts_; }
  /// By goal: whether an event has met it.
  [[nodiscard]] const std::vector<std::uint8_t>& met() const { return met_; }
  /// The problems that were solved beside those of the events.
  [[nodiscard]] std::uint64_t solved() const { return relaxation_.solved(); }

 private:
  using Kind = Goal::Kind;

  void meet(Kind kind, std::uint32_t subject);
  void note_values(const State& before, const Trigger& trigger, const Assignment& solution);
  void note_stop(const Trigger& trigger, const State& before, TaskId task);
  void note_start(const EventRecord& record, const Circumstances& circumstances,
                  const Assignment& solution);
  void note_finish(const EventRecord& record, const State& before);
  void note_timeout(const EventRecord& record, const State& before);
  void ask_for_deciding(const EventRecord& record, const Circumstances& circumstances,
                        const Assignment* solution);
  void note_situation(const State& state);

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  ConstraintRelaxation relaxation_;
  const std::function<bool()> is_stopped_;  ///< may be empty
  /// By kind and its subject: the goal, or none. See subject_of.
  std::array<std::vector<std::uint32_t>, Goal::kinds> places_;
  std::vector<std::vector<std::uint32_t>> deciding_;  ///< by group: goals about deciding
  /// By digest of problems: the goals about deciding that events with them meet.
  std::unordered_map<std::string, std::vector<std::uint32_t>> decided_;
  GoalFacts facts_;
  std::vector<std::uint8_t> met_;
  std::vector<std::uint8_t> apart_;          ///< those of restart(), or empty
  std::vector<std::uint8_t> has_given_way_;  ///< by task, in this mission
  std::vector<BehaviorId> conditional_;      ///< behaviors that name variables
  std::vector<std::uint8_t> fits_;           ///< by place in conditional_
  bool takes_failures_for_timeouts_ = false;
  std::vector<std::uint8_t> was_active_;  ///< by behavior; kept for its memory
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
