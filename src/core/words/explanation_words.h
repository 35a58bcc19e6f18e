#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/script/runner.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

// Explanations of answers in words: why something runs or does not.

namespace cbc {

/// An explanation for people: a sentence, and the sentences that it introduces, if any.
struct Sentences {
  std::string first;
  std::vector<std::string> more;
};

/// Why a requested task no longer runs. Here and below, the state is the one after the event.
[[nodiscard]] Sentences describe_displacement(const CompiledCatalog& catalog,
                                              const ExplainedRecord& record,
                                              const Displacement& displaced, const State& state);

/// Why a task has its value, or why a behavior is active or not.
[[nodiscard]] Sentences describe_why(const CompiledCatalog& catalog, const ExplainedRecord& record,
                                     const Why& why, const State& state);

/// The tasks that an explanation is about: those of the behavior, or the task.
[[nodiscard]] std::vector<TaskId> tasks_of(const CompiledCatalog& catalog, const Why& why);

/// A listed configuration: its objectives, then what runs in it; for all but the first one, only
/// the differences from the first.
[[nodiscard]] std::string describe_alternative(const CompiledCatalog& catalog,
                                               const ExplainedRecord& record, std::size_t place,
                                               const State& state);

/// The tasks of a group that have different values in two configurations, in catalog order.
[[nodiscard]] std::vector<TaskId> differing_tasks(const CompiledCatalog& catalog, GroupId group,
                                                  const Assignment& one, const Assignment& other);

/// "event 3 at 5.000 s (start HOVER, priority 1)"
[[nodiscard]] std::string place_of(const CompiledCatalog& catalog, const EventRecord& event);

/// Why tasks are not as expected: the event that decided, the objective with both values, and what
/// differs; or what prevents it. `state`: the one in which the expectation does not hold.
[[nodiscard]] Sentences describe_unmet(const CompiledCatalog& catalog,
                                       const UnexpectedTasks& unexpected, const State& state);

/// Why a reactive task does not start by itself. `state`: in which it does not.
[[nodiscard]] std::string describe_blocked(const CompiledCatalog& catalog,
                                           const BlockedStart& start, const State& state);

/// Whether what stood in the way of an event no longer does.
[[nodiscard]] bool is_over(const Reason& reason, const State& state);

/// What else one has to know of tasks that are not as expected: that what prevented it no longer
/// does, and that faults of their behaviors have no effect yet. `state`: as above.
[[nodiscard]] std::vector<std::string> notes_of(const CompiledCatalog& catalog,
                                                const UnexpectedTasks& unexpected,
                                                const State& state);

}  // namespace cbc
