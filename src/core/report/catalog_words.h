#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

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

/// "TARGET is near"
[[nodiscard]] std::string describe_value(const CompiledCatalog& catalog, VariableValue value);

/// "HOVER runs", "HOVER runs with HOVER_WITH_MPC". `behavior`: none: any.
[[nodiscard]] std::string describe_running(const CompiledCatalog& catalog, TaskId task,
                                           BehaviorId behavior);

/// " GPS unavailable, RADAR available, TARGET is near"
[[nodiscard]] std::string describe_situation(const CompiledCatalog& catalog,
                                             const Situation& situation);

}  // namespace cbc
