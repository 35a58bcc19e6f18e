#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ask/conflict/reasons.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// Minimal conflict sets of events: why there is no answer, or none of a certain kind.

namespace cbc {

/// The effort of all searches about one event: decisions (each search counts as one more), times
/// tasks; some tenths of a second.
inline constexpr std::uint64_t most_effort_of_answer = 50'000'000;

/// Whether a demand says that the task runs.
[[nodiscard]] constexpr bool demands_run(const Demand& demand, TaskId task) {
  return demand.task == task &&
         (demand.kind == Demand::Kind::run || demand.kind == Demand::Kind::has);
}

/// Why a start or stop has no answer: a minimal conflict set, or the priority of the task's own
/// request. Empty where that takes too long (a group with very many constraints, a proof of very
/// many conflicts, or the deadline).
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                                const Circumstances& circumstances);
/// Why an event was rejected; nothing if only a limit ended its search.
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                                const EventRecord& record,
                                                const Circumstances& circumstances);

/// A minimal conflict set of an event that has an answer, together with all of the `ways`, which no
/// answer meets; the event itself is the last reason, if it is one. Empty if a start alone rules
/// them out; nothing where that takes too long.
[[nodiscard]] std::optional<std::vector<Reason>> find_conflict_with(
    const CompiledCatalog& catalog, const Circumstances& circumstances,
    std::span<const Demands> ways);

/// Why a behavior is not available: it does not fit, or a script denied it, or both.
[[nodiscard]] Reason reason_of_unavailability(const CompiledCatalog& catalog, const State& state,
                                              BehaviorId behavior);
/// Why each behavior of a task is not available.
[[nodiscard]] std::vector<Reason> reasons_of_unavailability(const CompiledCatalog& catalog,
                                                            const State& state, TaskId task);

/// What would hinder a task that does not run if it were to start by itself now. Empty: nothing.
[[nodiscard]] std::vector<Reason> hindrances_to_reactive_start(const CompiledCatalog& catalog,
                                                               const State& state, TaskId task);

}  // namespace cbc
