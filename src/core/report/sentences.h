#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

namespace cbc {

/// The suitability objective of a state: the product of the suitabilities of all running tasks, as
/// the nearest double (docs/semantics.md, "Objectives").
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state);

/// The same, with another configuration of one group.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state,
                                       std::uint32_t group, const Assignment& places);

/// The same, as an exact decimal number. If a suitability outside the group is 0, only the group
/// counts, since the product could not tell its configurations apart.
[[nodiscard]] std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                                            std::uint32_t group, const Assignment& places);

/// The idle objective: of the supporting tasks, which are those without start_on_request, the share
/// that does not run.
[[nodiscard]] double idle_share(const ObjectiveValues& objective);

[[nodiscard]] double to_seconds(Microseconds time);

/// Seconds with 3 decimals, or 6 if the time is not a whole number of milliseconds.
[[nodiscard]] std::string format_time(Microseconds time);

/// Names in sentences: "task LAND" and "behavior LAND" if the catalog has both, otherwise "LAND".
[[nodiscard]] std::string task_name(const CompiledCatalog& catalog, TaskId task);
[[nodiscard]] std::string behavior_name(const CompiledCatalog& catalog, BehaviorId behavior);

/// "LAND, HOVER or TAKE_OFF"; there is one task at least. `last`: "or" or "and".
[[nodiscard]] std::string list_tasks(const CompiledCatalog& catalog, std::span<const TaskId> tasks,
                                     std::string_view last);

/// What happened: "start HOVER, priority 2". `step` is the scripted one, or null.
[[nodiscard]] std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                                         const Step* step);

/// Why a task stopped, in the words for changes of behaviors where it was not by the finish of its
/// own behavior: "requested" by this event, "displaced" or "released".
[[nodiscard]] std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped);

/// That a behavior, which is active, became faulty only after it was activated.
[[nodiscard]] std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior);

/// What may surprise about an event: a fault of an active behavior, a finish of an inactive one, or
/// a stop of a task that does not run. Empty for most. `state`: after the event.
[[nodiscard]] std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                                        const State& state);

/// " GPS unavailable, RADAR available, TARGET is near"
[[nodiscard]] std::string describe_situation(const CompiledCatalog& catalog,
                                             const Situation& situation);

/// "TARGET is near"
[[nodiscard]] std::string describe_value(const CompiledCatalog& catalog, VariableValue value);

/// The reactive tasks in the queue and those that wait, in catalog order, with their due times;
/// those that only wait have none.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state);

/// "outcome accepted, HOVER runs with HOVER_WITH_MPC, LAND does not run"
[[nodiscard]] std::string describe_expectation(const CompiledCatalog& catalog,
                                               const Expectation& expectation);

/// A reason for a rejection or a choice, in a sentence, with its place in the catalog if it has
/// one.
[[nodiscard]] std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                                          const Reason& reason);

/// A set of reasons for people, one sentence in each line. An exclusion and the protection of the
/// excluding task make one sentence, as do several tasks that nobody requested. What is said of a
/// required task follows the requirement, indented by two blanks. `tasks`: those in question, with
/// which the reasons begin. `it`: the task that the sentences call so, or none.
[[nodiscard]] std::vector<std::string> describe_reasons(const CompiledCatalog& catalog,
                                                        const EventRecord& record,
                                                        std::span<const Reason> reasons,
                                                        std::span<const TaskId> tasks,
                                                        TaskId it = none);

/// The same order for reasons that are told one by one.
[[nodiscard]] std::vector<const Reason*> order_reasons(const CompiledCatalog& catalog,
                                                       std::span<const Reason> reasons,
                                                       std::span<const TaskId> tasks);

/// The tasks that an explanation is about: those of the behavior, or the task.
[[nodiscard]] std::vector<TaskId> tasks_of(const CompiledCatalog& catalog, const Why& why);

/// For places where lines become one text.
[[nodiscard]] std::string_view without_indentation(std::string_view line);

/// Two decimal numbers, shortened as far as one can still see which is the larger one.
[[nodiscard]] std::pair<std::string, std::string> shorten_both(const std::string& a,
                                                               const std::string& b);

/// How many of the supporting tasks run: "4 of 7".
[[nodiscard]] std::string supporting_text(const ObjectiveValues& objective);

/// Why an event was rejected, in one line or more: see describe_reasons.
[[nodiscard]] std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                                          const EventRecord& record);

/// An explanation for people: a sentence, and the sentences that it introduces, if any.
struct Sentences {
  std::string first;
  std::vector<std::string> more;
};

/// Why a requested task no longer runs. Here and below, the state is the one after the event.
[[nodiscard]] Sentences describe_displacement(const CompiledCatalog& catalog,
                                              const EventRecord& record,
                                              const Displacement& displaced, const State& state);

/// Of some tasks those that can start without a request, and run in the alternative of an answer,
/// but not in the answer that the event chose: nothing that runs requires them.
[[nodiscard]] std::vector<TaskId> unneeded_tasks(const CompiledCatalog& catalog,
                                                 const EventRecord& record, const WhyNot& why_not,
                                                 std::span<const TaskId> tasks);

/// Why a task has its value, or why a behavior is active or not.
[[nodiscard]] Sentences describe_why(const CompiledCatalog& catalog, const EventRecord& record,
                                     const Why& why, const State& state);

/// A listed configuration: its objectives, then what runs in it; for all but the first one, only
/// the differences from the first.
[[nodiscard]] std::string describe_alternative(const CompiledCatalog& catalog,
                                               const EventRecord& record, std::size_t place,
                                               const State& state);

}  // namespace cbc
