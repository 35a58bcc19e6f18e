#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cbc/units.h"
#include "core/property/properties.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

// Tasks, behaviors, situations and times in words.

namespace cbc {

[[nodiscard]] double to_seconds(Microseconds time);

/// Seconds with 3 decimals, or 6 if the time is not a whole number of milliseconds.
[[nodiscard]] std::string format_time(Microseconds time);

/// Names in sentences: "task LAND" and "behavior LAND" if the catalog has both, otherwise "LAND".
[[nodiscard]] std::string task_name(const CompiledCatalog& catalog, TaskId task);
[[nodiscard]] std::string behavior_name(const CompiledCatalog& catalog, BehaviorId behavior);
[[nodiscard]] std::vector<std::string> names_in_sentence(const CompiledCatalog& catalog,
                                                         std::span<const TaskId> tasks);

/// Names in lists, printable.
[[nodiscard]] std::vector<std::string> names_of_tasks(const CompiledCatalog& catalog,
                                                      std::span<const TaskId> tasks);
[[nodiscard]] std::vector<std::string> names_of_behaviors(const CompiledCatalog& catalog,
                                                          std::span<const BehaviorId> behaviors);

/// " (robot.yaml:12)"
[[nodiscard]] std::string place_in_catalog(const CompiledCatalog& catalog, std::uint32_t line);

/// "TARGET is near"
[[nodiscard]] std::string describe_value(const CompiledCatalog& catalog, VariableValue value);

/// " GPS unavailable, RADAR available, TARGET is near"
[[nodiscard]] std::string describe_situation(const CompiledCatalog& catalog,
                                             const Situation& situation);

// Properties and assumptions in words.

/// "LAND can always start with priority 3"
[[nodiscard]] std::string describe_property(const CompiledCatalog& catalog,
                                            const Property& property);

/// What may happen, and who says so, on one line: "assumed (default): 2 of 3 tasks are requested
/// (priority 1) and stopped; behaviors succeed and fail; none is faulty; all variables change".
[[nodiscard]] std::string describe_assumptions(const CompiledCatalog& catalog,
                                               const StatedAssumptions& stated);

// Events and expectations in words.

/// What happened: "start HOVER, priority 2". `step` is the scripted one, or null.
[[nodiscard]] std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                                         const Step* step);

/// The same with its outcome, if it has one: "start HOVER, priority 2: accepted".
[[nodiscard]] std::string event_and_outcome(const CompiledCatalog& catalog,
                                            const EventRecord& record, const Step* step);

/// Why a task stopped, in the words for changes of behaviors where it was not by the finish of its
/// own behavior: "requested" by this event, "displaced" or "released".
[[nodiscard]] std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped);

/// That a behavior, which is active, became faulty only after it was activated.
[[nodiscard]] std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior);

/// What may surprise about an event: a fault of an active behavior, a finish of an inactive one, a
/// stop of a task that does not run, or that active behaviors take over tasks. Empty for most.
/// `state`: after the event.
[[nodiscard]] std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                                        const State& state);

/// "outcome accepted, HOVER runs with HOVER_WITH_MPC, LAND does not run"
[[nodiscard]] std::string describe_expectation(const CompiledCatalog& catalog,
                                               const Expectation& expectation);

/// The reactive tasks in the queue and those that wait, in catalog order, with their due times;
/// those that only wait have none.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state);

}  // namespace cbc
