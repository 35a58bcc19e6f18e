#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/explain/alternatives.h"
#include "runtime/explain/reasons.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// The event to explain.
struct Circumstances {
  const State& state;  ///< before the event
  const Trigger& trigger;
  std::int32_t protection = 0;         ///< the last level that was tried
  std::span<const BehaviorId> failed;  ///< behaviors that failed in this event
  /// When to give up finding reasons.
  std::optional<std::chrono::steady_clock::time_point> deadline = std::nullopt;
};

/// Whether a demand says that the task runs.
[[nodiscard]] constexpr bool demands_run(const Demand& demand, TaskId task) {
  return demand.task == task &&
         (demand.kind == Demand::Kind::run || demand.kind == Demand::Kind::has);
}

/// A minimal conflict set of a start or stop that has no solution. Empty where that takes too long
/// (a group with very many constraints, a proof of very many conflicts, or the deadline).
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                                const Circumstances& circumstances);

/// Why a behavior is not available: it does not fit, or a script denied it, or both.
[[nodiscard]] Reason reason_of_unavailability(const CompiledCatalog& catalog, const State& state,
                                              BehaviorId behavior);
/// The same of all behaviors of a task.
[[nodiscard]] std::vector<Reason> reasons_of_unavailability(const CompiledCatalog& catalog,
                                                            const State& state, TaskId task);

/// What would hinder a task that does not run if it were to start by itself now. Empty: nothing.
[[nodiscard]] std::vector<Reason> hindrances_to_reactive_start(const CompiledCatalog& catalog,
                                                               const State& state, TaskId task);

/// The objectives outside a group, where all requests are satisfied and nothing changes.
[[nodiscard]] ObjectiveValues objectives_elsewhere(const CompiledCatalog& catalog,
                                                   const State& state, GroupId group);

/// Explains accepted answers by a search for the best alternatives. Allocates on every event.
class Explainer {
 public:
  /// `ranks`: those of the solver. Catalog and ranks must outlive the explainer.
  Explainer(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks,
            ExplanationOptions options);

  /// `circumstances`: with the state before the answer. `solution` is proven best.
  void explain(const Circumstances& circumstances, const Problem& problem,
               const Assignment& solution, Explanation& explanation);

  /// Why an answer to a problem, proven best, meets the demands of none of the `ways`. `elsewhere`:
  /// see objectives_elsewhere. `chosen` receives the answer with its objectives.
  [[nodiscard]] WhyNot ask(const Circumstances& circumstances, const ObjectiveValues& elsewhere,
                           const Problem& problem, const Assignment& solution,
                           std::span<const Demands> ways, Configuration& chosen);

  /// Of tasks that do not run, but are in the queue after the event, and of their behaviors:
  /// replaces the explanation by what hinders their start, if anything does. `state`: after the
  /// event.
  void explain_queued(const State& state, Explanation& explanation) const;

 private:
  [[nodiscard]] TaskId queued_task(const State& state, BehaviorId behavior) const;
  [[nodiscard]] bool is_in_group(const Subject& subject, GroupId group) const;
  void explain_displaced(const Circumstances& circumstances, const Problem& problem,
                         Explanation& explanation);
  void explain_task(const Circumstances& circumstances, TaskId task, Explanation& explanation);
  void explain_behavior(const Circumstances& circumstances, BehaviorId behavior,
                        Explanation& explanation);
  void explain_better(const Circumstances& circumstances, TaskId task, std::uint32_t index,
                      const Configuration& chosen, std::vector<BetterBehavior>& better);
  [[nodiscard]] WhyNot why_not(const Circumstances& circumstances, const Configuration& chosen,
                               std::span<const Demands> ways);

  const CompiledCatalog& catalog_;
  const ExplanationOptions options_;
  ConfigurationSearch search_;
};

}  // namespace cbc
